"""Reads a .vtm file with VTK's own reader and prints its blocks as one JSON object.

{"group/layer": {"class", "points", "cells", "bounds", "point_arrays", "cell_arrays", "field_arrays", "meanings"}}
"""
import json
import sys

from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader


def arrays(data):
    return [data.GetAbstractArray(i).GetName() for i in range(data.GetNumberOfArrays())]


def meanings(data):
    found = {}
    for part in (data.GetPointData(), data.GetCellData()):
        for i in range(part.GetNumberOfArrays()):
            array = part.GetArray(i)
            information = array.GetInformation()
            key = vtkDataArray.UNITS_LABEL()
            found[array.GetName()] = information.Get(key) if information.Has(key) else None
    return found


def leaves(block, name):
    for i in range(block.GetNumberOfBlocks()):
        child = block.GetBlock(i)
        path = name + [block.GetMetaData(i).Get(vtkCompositeDataSet.NAME())]
        if isinstance(child, vtkMultiBlockDataSet):
            yield from leaves(child, path)
        else:
            yield '/'.join(path), child


errors = []
reader = vtkXMLMultiBlockDataReader()
reader.AddObserver('ErrorEvent', lambda *_: errors.append('VTK reports an error'))
reader.SetFileName(sys.argv[1])
reader.Update()
if errors:
    sys.exit('%s: %s' % (sys.argv[1], errors))
print(json.dumps({name: {
    'class': data.GetClassName(),
    'points': data.GetNumberOfPoints(),
    'cells': data.GetNumberOfCells(),
    'bounds': list(data.GetBounds()),
    'point_arrays': arrays(data.GetPointData()),
    'cell_arrays': arrays(data.GetCellData()),
    'field_arrays': arrays(data.GetFieldData()),
    'meanings': meanings(data),
} for name, data in leaves(reader.GetOutput(), [])}))
