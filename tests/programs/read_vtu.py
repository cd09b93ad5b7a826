"""Reads a .vtu file with VTK's own reader and prints its content as one JSON object.

Besides points, cells and arrays it prints what VTK interpolates inside each cell ("samples"): the
position and the values of every float point array at a few parameters.
"""
import json
import sys

from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

PARAMETERS = [(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (0.125, 0.75), (1.0, 0.375)]


def tuples(array):
    return [list(array.GetTuple(i)) for i in range(array.GetNumberOfTuples())]


def arrays(data):
    found = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        numeric = data.GetArray(i) is not None
        values = tuples(array) if numeric else [array.GetValue(k) for k in range(array.GetNumberOfValues())]
        found[array.GetName()] = {
            'type': array.GetDataTypeAsString(),
            'components': array.GetNumberOfComponents(),
            'values': values,
        }
    return found


def sample(grid, index):
    cell = grid.GetCell(index)
    floats = [a for a in (grid.GetPointData().GetArray(i) for i in range(grid.GetPointData().GetNumberOfArrays()))
              if a.GetDataTypeAsString() == 'float']
    result = []
    for r, s in PARAMETERS:
        position, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
        cell.EvaluateLocation(mutable(0), [r, s, 0.0], position, weights)
        values = {}
        for array in floats:
            corners = [array.GetTuple(cell.GetPointId(k)) for k in range(cell.GetNumberOfPoints())]
            values[array.GetName()] = [sum(w * c[k] for w, c in zip(weights, corners))
                                       for k in range(array.GetNumberOfComponents())]
        result.append({'r': r, 's': s, 'position': list(position), 'values': values})
    return result


def main(path):
    errors = []
    reader = vtkXMLUnstructuredGridReader()
    reader.AddObserver('ErrorEvent', lambda *_: errors.append('VTK reports an error'))
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    if errors or grid.GetNumberOfCells() == 0:
        sys.exit('%s: %s' % (path, errors or 'no cells'))
    cells = range(grid.GetNumberOfCells())
    scalars = grid.GetPointData().GetScalars()
    print(json.dumps({
        'points': [list(grid.GetPoint(i)) for i in range(grid.GetNumberOfPoints())],
        'point_type': grid.GetPoints().GetData().GetDataTypeAsString(),
        'types': sorted({grid.GetCellType(c) for c in cells}),
        'cells': [[grid.GetCell(c).GetPointId(k) for k in range(grid.GetCell(c).GetNumberOfPoints())] for c in cells],
        'point_arrays': arrays(grid.GetPointData()),
        'cell_arrays': arrays(grid.GetCellData()),
        'field_arrays': arrays(grid.GetFieldData()),
        'active_scalars': scalars.GetName() if scalars else None,
        'samples': [sample(grid, c) for c in cells],
    }))


main(sys.argv[1])
