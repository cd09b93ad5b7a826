"""Opens a .vtm file of Quadrille in ParaView 5.11 as four linked views: the picture as patches, the
cross field with its singularities, the lengths of the lattice's edges, and the error of the patches.

    pvbatch open_vtm.py picture.vtm --screenshot views.png    # also pvpython
    pvbatch open_vtm.py picture.vtm --state picture.pvsm      # then: paraview --state=picture.pvsm

In ParaView itself: open the file, press Apply, then Tools > Python Shell > Run Script.
Views whose layers the file lacks (written by `quadrille export`, which knows no fields) are left out.
"""
import argparse
import os
import sys
import xml.etree.ElementTree as ElementTree

from paraview.simple import (ColorBy, CreateLayout, CreateRenderView, ExtractBlock, GetActiveSource, GetColorTransferFunction,
                             GetScalarBar, Glyph, OpenDataFile, ResetCamera, SaveScreenshot, SaveState, Show,
                             Text)


class Scene:
    """The layers of a .vtm file by group and name."""

    def __init__(self, path, reader=None):
        root = ElementTree.parse(path).getroot()
        self.layers = {group.get('name'): [layer.get('name') for layer in group.iter('DataSet')] for group in root.iter('Block')}
        self.reader = reader or OpenDataFile(path)

    def has(self, group, layer):
        return layer in self.layers.get(group, [])

    def layer(self, group, layer):
        selector = '/Root/%s/%s' % (group, layer)
        block = ExtractBlock(registrationName=layer, Input=self.reader, Assembly='Hierarchy',
                             Selectors=[selector.replace('-', '')])  # ParaView leaves hyphens out of its paths
        block.UpdatePipeline()
        return block


def style(source):
    """The keys of a layer's "style": ink, width, marker, radius, arm_length, colors."""
    from paraview import servermanager
    data = servermanager.Fetch(source)
    while data and data.IsA('vtkCompositeDataSet'):
        iterator = data.NewIterator()
        iterator.InitTraversal()
        data = iterator.GetCurrentDataObject()
    text = data.GetFieldData().GetAbstractArray('style').GetValue(0)
    return dict(line.split(' ', 1) for line in text.splitlines())


def show(source, view, depth=0, **properties):
    """Shows a source without lighting; `depth` lifts it above what lies below."""
    display = Show(source, view)
    display.Representation = 'Surface'
    display.Ambient, display.Diffuse, display.Specular = 1, 0, 0
    display.Position = [0, 0, depth]
    for name, value in properties.items():
        setattr(display, name, value)
    return display


def show_colors(source, view, association, array, depth=0, **properties):
    """Shows bytes as the colours that they are."""
    display = show(source, view, depth, **properties)
    ColorBy(display, (association, array))
    display.MapScalars = 0
    return display


def show_ink(source, view, color, depth=0, **properties):
    display = show(source, view, depth, AmbientColor=color, DiffuseColor=color, **properties)
    display.ColorArrayName = ['POINTS', '']


def show_numbers(source, view, array, title, preset, depth=0):
    display = show(source, view, depth)
    ColorBy(display, ('CELLS', array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    display.RescaleTransferFunctionToDataRange(False, True)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ''
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    display.SetScalarBarVisibility(view, True)


def show_crosses(source, view, depth, color):
    keys = style(source)
    for axis in ('axis_u', 'axis_v'):
        glyph = Glyph(registrationName=axis, Input=source, GlyphType='Line', OrientationArray=['POINTS', axis],
                      ScaleArray=['POINTS', axis], ScaleFactor=2 * float(keys['arm_length']), GlyphMode='All Points')
        show_ink(glyph, view, color, depth, LineWidth=float(keys['width']))


def show_patches(scene, view):
    patches = scene.layer('picture', 'patches')
    exact = patches.PointData.GetArray('color')  # None with transparency: then straight bytes, a little less exact
    show_colors(patches, view, 'POINTS', 'color' if exact else 'rgba', NonlinearSubdivisionLevel=2)


def show_cross_field(scene, view):
    if scene.has('picture', 'picture'):
        show_colors(scene.layer('picture', 'picture'), view, 'CELLS', 'rgb', Opacity=0.45)
    show_crosses(scene.layer('cross-field', 'cross-field'), view, 0.2, [0.16, 0.16, 0.19])
    show_colors(scene.layer('cross-field', 'singularities'), view, 'POINTS', 'rgb', 0.4, PointSize=9, RenderPointsAsSpheres=1)


def show_scale(scene, view):
    show_numbers(scene.layer('scale', 'edge-length'), view, 'length', 'edge length, pixels', 'Viridis (matplotlib)')
    show_crosses(scene.layer('scale', 'edge-crosses'), view, 0.2, [1, 1, 1])


def show_error(scene, view):
    show_numbers(scene.layer('picture', 'error'), view, 'error', 'error, 0 to 255', 'Inferno (matplotlib)')
    show_ink(scene.layer('picture', 'patch-edges'), view, [1, 1, 1], 0.2, LineWidth=1, Opacity=0.35)
    tears = scene.layer('picture', 'tears')
    if tears.GetDataInformation().GetNumberOfCells() > 0:
        show_ink(tears, view, [0.3, 0.9, 1], 0.4, LineWidth=2)


VIEWS = [
    ('patches', 'The patches', ('picture', 'patches'), show_patches),
    ('cross field', 'Cross field, singularities +1/4 red, -1/4 blue', ('cross-field', 'cross-field'), show_cross_field),
    ('edge length', 'Edge lengths of the lattice', ('scale', 'edge-length'), show_scale),
    ('error', 'Error of the patches, tears', ('picture', 'error'), show_error),
]


def make_view(scene, name, caption, fill):
    view = CreateRenderView(registrationName=name)
    view.InteractionMode = '2D'
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    fill(scene, view)
    text = Show(Text(registrationName=name + ' caption', Text=caption), view)
    text.Color, text.FontSize, text.WindowLocation = [0, 0, 0], 12, 'Upper Left Corner'
    view.CameraParallelProjection = 1
    ResetCamera(view)
    view.CameraParallelScale *= 0.8
    return view


def open_scene(path, reader=None):
    """Opens the file; returns the layout of its views."""
    scene = Scene(path, reader)
    views = [make_view(scene, name, caption, fill) for name, caption, needed, fill in VIEWS if scene.has(*needed)]
    layout = CreateLayout(os.path.basename(path))
    cells = [0]
    while len(cells) < len(views):
        cell = cells.pop(0)
        split = layout.SplitHorizontal if len(cells) == 0 and cell == 0 else layout.SplitVertical
        first = split(cell, 0.5)
        cells += [first, first + 1]
    for view, cell in zip(views, sorted(cells)):
        layout.AssignView(cell, view)
    return layout


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('file', nargs='?', help='.vtm file; the active source when absent')
    parser.add_argument('--screenshot', help='PNG file to draw the views into')
    parser.add_argument('--size', default='1600x1200', help='of the screenshot')
    parser.add_argument('--state', help='.pvsm file to save the views in')
    options = parser.parse_args(arguments)
    reader = None if options.file else GetActiveSource()
    if not options.file and reader is None:
        parser.error('name a .vtm file, or open one first')
    layout = open_scene(options.file or reader.FileName[0], reader)
    if options.screenshot:
        width, height = map(int, options.size.split('x'))
        layout.SetSize(width, height)
        SaveScreenshot(options.screenshot, layout, ImageResolution=[width, height])
    if options.state:
        SaveState(options.state)


main(sys.argv[1:])
