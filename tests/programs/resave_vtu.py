"""Stores a .vtu file again with VTK's own reader and writer, as other programs do.

resave_vtu.py IN OUT ascii|binary|appended|plain [MOVE]: MOVE is added to the first point's x.
"""
import sys

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

source, target, mode = sys.argv[1:4]
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(source)
reader.Update()
grid = reader.GetOutput()
if len(sys.argv) > 4:
    x, y, z = grid.GetPoint(0)
    grid.GetPoints().SetPoint(0, x + float(sys.argv[4]), y, z)
writer = vtkXMLUnstructuredGridWriter()
writer.SetFileName(target)
writer.SetInputData(grid)
writer.EncodeAppendedDataOff()  # as ParaView does
if mode == 'plain':
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt32()
    mode = 'appended'
{'ascii': writer.SetDataModeToAscii, 'binary': writer.SetDataModeToBinary, 'appended': writer.SetDataModeToAppended}[mode]()
sys.exit(0 if writer.Write() == 1 else 1)
