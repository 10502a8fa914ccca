# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of algorithm.md: pvpython figures.py OUTPUT-FOLDER, with PYTHONPATH on the package
isodiamonds. docs/figures.sh does it all."""
import itertools
import math
import os
import sys

import vtkmodules.vtkRenderingFreeType  # noqa: F401: renders text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: renders
from isodiamonds import (
    vtkDiamondMesh,
    vtkIsodiamondBuilder,
    vtkIsodiamondExtractor,
    vtkIsodiamondHierarchy,
    vtkIsodiamondIntervalVolume,
    vtkIsodiamondPoints,
)
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkThreshold, vtkTubeFilter
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeneral import vtkShrinkFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkDataSetMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

FOLDER = sys.argv[1]
KEPT = []  # filters: an output port alone does not keep its filter alive
RED, BLUE, GREEN, GREY = (0.8, 0.15, 0.1), (0.15, 0.35, 0.8), (0.1, 0.6, 0.2), (0.35, 0.35, 0.35)


class Figure:
    """Views side by side, each with a caption."""

    def __init__(self, name, captions, size=420):
        self.name = name
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(4)
        self.window.SetSize(size * len(captions), size + 30)
        self.views = []
        for i, caption in enumerate(captions):
            view = vtkRenderer()
            view.SetViewport(i / len(captions), 0, (i + 1) / len(captions), 1)
            view.SetBackground(1, 1, 1)
            text = vtkTextActor()
            text.SetInput(caption)
            text.GetTextProperty().SetColor(0, 0, 0)
            text.GetTextProperty().SetFontSize(18)
            text.SetPosition(12, 8)
            view.AddViewProp(text)
            self.window.AddRenderer(view)
            self.views.append(view)

    def save(self, direction=(1.2, -2, 1.1), zoom=1.25):
        for view in self.views:
            camera = view.GetActiveCamera()
            camera.SetPosition(*direction)
            camera.SetFocalPoint(0, 0, 0)
            camera.SetViewUp(0, 0, 1)
            view.ResetCamera()
            camera.Zoom(zoom)
        self.window.Render()
        image = vtkWindowToImageFilter()
        image.SetInput(self.window)
        image.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetInputConnection(image.GetOutputPort())
        writer.SetFileName(os.path.join(FOLDER, self.name + ".png"))
        writer.Write()


def add(view, filter, colour=(0.75, 0.8, 0.85), edges=False):
    mapper = vtkDataSetMapper()
    mapper.SetInputConnection(filter.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetEdgeVisibility(edges)
    view.AddActor(actor)
    return actor


def colour_by(actor, array, colours, cells):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(len(colours))
    table.SetTableRange(-0.5, len(colours) - 0.5)
    for i, colour in enumerate(colours):
        table.SetTableValue(i, *colour, 1)
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    mapper.SelectColorArray(array)
    if cells:
        mapper.SetScalarModeToUseCellFieldData()
    else:
        mapper.SetScalarModeToUsePointFieldData()


LEVELS = [(0.3, 0.3, 0.7), (0.25, 0.5, 0.8), (0.3, 0.7, 0.7), (0.45, 0.75, 0.4), (0.9, 0.8, 0.3),
          (0.9, 0.55, 0.25), (0.8, 0.3, 0.2)]
KINDS = [BLUE, GREEN, RED]


def segments(view, ends, colour, radius):
    points, lines = vtkPoints(), vtkCellArray()
    for pair in ends:
        lines.InsertNextCell(2)
        for end in pair:
            lines.InsertCellPoint(points.InsertNextPoint(*end))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    tubes = vtkTubeFilter()
    tubes.SetInputData(data)
    tubes.SetRadius(radius)
    tubes.SetNumberOfSides(12)
    add(view, tubes, colour)


def ball(view, centre, colour, radius):
    sphere = vtkSphereSource()
    sphere.SetCenter(*centre)
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(24)
    add(view, sphere, colour)


def diamond_classes():
    """Each diamond by its rules: around the centre, vertices at -1, 0 and 1 on the axes."""
    cube = list(itertools.product((-1, 1), repeat=3))
    ring = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if (x, y) != (0, 0)]
    ring.sort(key=lambda v: math.atan2(v[1], v[0]))
    shapes = [
        # spine, ring around it in order
        (((-1, -1, -1), (1, 1, 1)),
         [(1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, 1, 1), (-1, -1, 1), (1, -1, 1)]),
        (((-1, -1, 0), (1, 1, 0)), [(1, -1, 0), (0, 0, 1), (-1, 1, 0), (0, 0, -1)]),
        (((0, 0, -1), (0, 0, 1)), [(x, y, 0) for x, y in ring]),
    ]
    figure = Figure("diamond-classes", ["class 0: a cube's diagonal, 6 tetrahedra",
                                        "class 1: a face's diagonal, 4", "class 2: an edge, 8"])
    for view, (spine, around) in zip(figure.views, shapes):
        outer = list(zip(around, around[1:] + around[:1]))
        outer += [(end, v) for end in spine for v in around]
        segments(view, outer, GREY, 0.02)
        segments(view, [spine], RED, 0.035)
        segments(view, [((0, 0, 0), v) for v in around], BLUE, 0.015)
        ball(view, (0, 0, 0), RED, 0.09)
        for vertex in [*spine, *around]:
            ball(view, vertex, GREY, 0.05)
        assert {*spine, *around} <= {*cube, *itertools.product((-1, 0, 1), repeat=3)}
    figure.save(direction=(1.6, -2.3, 1.3), zoom=0.95)


def volume():
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-16, 16, -16, 16, -16, 16)
    return source


def builder(model, isovalue=190):
    made = vtkIsodiamondBuilder()
    KEPT.append(volume())
    made.SetInputConnection(KEPT[-1].GetOutputPort())
    made.SetModel(model)
    made.SetIsovalue(isovalue)
    return made


def half(filter):
    plane = vtkPlane()
    plane.SetOrigin(0, 0, 0)
    plane.SetNormal(0, -1, 0)
    cut = vtkExtractGeometry()
    cut.SetInputConnection(filter.GetOutputPort())
    cut.SetImplicitFunction(plane)
    KEPT.append(filter)
    return cut


def kinds():
    """The paper's figures 8 and 11."""
    figure = Figure("isodiamond-kinds", ["RI: active, creation, relevant", "MI: active, creation"])
    models = (vtkIsodiamondHierarchy.RELEVANT, vtkIsodiamondHierarchy.MINIMAL)
    for view, model in zip(figure.views, models):
        hierarchy = builder(model)
        surface = vtkIsodiamondExtractor()
        surface.SetInputConnection(hierarchy.GetOutputPort())
        add(view, half(surface))
        points = vtkIsodiamondPoints()
        points.SetInputConnection(hierarchy.GetOutputPort())
        for kind, size in ((2, 4), (0, 3), (1, 9)):
            chosen = vtkThreshold()
            cut = half(points)
            chosen.SetInputConnection(cut.GetOutputPort())
            chosen.SetInputArrayToProcess(0, 0, 0, 0, "Kind")
            chosen.SetLowerThreshold(kind)
            chosen.SetUpperThreshold(kind)
            actor = add(view, chosen, KINDS[kind])
            actor.GetProperty().SetPointSize(size)
            actor.GetProperty().SetRepresentationToPoints()
    figure.save()


def diamond_meshes():
    """The paper's figure 14."""
    figure = Figure("diamond-meshes", ["the mesh", "under the front, HD and RI", "MI"])
    models = (vtkIsodiamondHierarchy.HIERARCHY_OF_DIAMONDS, vtkIsodiamondHierarchy.MINIMAL)
    tolerance = 40
    surface = vtkIsodiamondExtractor()
    hierarchies = [builder(model) for model in models]
    surface.SetInputConnection(hierarchies[1].GetOutputPort())
    surface.SetErrorTolerance(tolerance)
    actor = add(figure.views[0], surface, edges=True)
    colour_by(actor, "Level", LEVELS, True)
    for view, hierarchy in zip(figure.views[1:], hierarchies):
        mesh = vtkDiamondMesh()
        mesh.SetInputConnection(hierarchy.GetOutputPort())
        mesh.SetErrorTolerance(tolerance)
        actor = add(view, half(mesh), edges=True)
        colour_by(actor, "Level", LEVELS, True)
    figure.save()


def interval_volume():
    """The paper's figure 16: points of full resolution, and tetrahedra of variable resolution."""
    figure = Figure("interval-volume", ["active and creation isodiamonds of [190, 300]",
                                        "full resolution in a box, coarse outside; shrunken"], 520)
    hierarchy = builder(vtkIsodiamondHierarchy.MINIMAL)
    hierarchy.SetShapeToIntervalVolume()
    hierarchy.SetIsorange(190, 300)
    points = vtkIsodiamondPoints()
    points.SetInputConnection(hierarchy.GetOutputPort())
    for kind, size in ((0, 3), (1, 9)):
        chosen = vtkThreshold()
        chosen.SetInputConnection(points.GetOutputPort())
        chosen.SetInputArrayToProcess(0, 0, 0, 0, "Kind")
        chosen.SetLowerThreshold(kind)
        chosen.SetUpperThreshold(kind)
        actor = add(figure.views[0], chosen, KINDS[kind])
        actor.GetProperty().SetPointSize(size)
        actor.GetProperty().SetRepresentationToPoints()
    region = vtkIsodiamondIntervalVolume()
    source = volume()
    region.SetInputConnection(source.GetOutputPort())
    region.SetIsorange(190, 300)
    region.SetErrorTolerance(0)
    region.UseRegionOfInterestOn()
    region.SetRegionOfInterest(0, 16, -16, 0, 0, 16)
    region.SetOutsideErrorTolerance(6)
    shrunken = vtkShrinkFilter()
    shrunken.SetInputConnection(region.GetOutputPort())
    shrunken.SetShrinkFactor(0.8)
    actor = add(figure.views[1], shrunken)
    colour_by(actor, "Level", LEVELS, True)
    figure.save()


diamond_classes()
kinds()
diamond_meshes()
interval_volume()
