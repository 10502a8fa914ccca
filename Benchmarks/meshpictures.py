# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes side by side, close up: deviation.py --pictures. Needs a screen, or xvfb-run.

Outer sides are grey, inner sides are red: a red speck on a closed wall is a flipped or folded
triangle, or an inner side that is seen through a hole.
"""
import collections
import os

from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkProperty
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkTextActor
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
import vtkmodules.vtkRenderingFreeType  # text
import vtkmodules.vtkRenderingOpenGL2

SIDE = 640  # pixels of a mesh's picture

# In the world: the point to look at, the way from there to the camera, the direction upwards, and
# how much is seen from top to bottom. Nothing behind the camera is seen: a near one looks inside.
View = collections.namedtuple("View", "focus way up height")


def surface_actor(mesh):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    front, back = actor.GetProperty(), vtkProperty()
    for face, color in ((front, (0.82, 0.82, 0.8)), (back, (0.85, 0.1, 0.05))):
        face.SetInterpolationToFlat()
        face.SetColor(*color)
        face.SetAmbient(0.15)
        face.SetDiffuse(0.85)
    actor.SetBackfaceProperty(back)
    return actor


def label(text):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(10, 10)
    style = actor.GetTextProperty()
    style.SetFontSize(20)
    style.SetColor(0, 0, 0)
    style.SetBackgroundColor(1, 1, 1)
    style.SetBackgroundOpacity(0.8)
    return actor


def renderer_of(name, mesh, view):
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(surface_actor(mesh))
    renderer.AddActor2D(label(f"{name}\n{mesh.GetNumberOfCells():,} triangles"))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(view.focus)
    camera.SetPosition([f + d for f, d in zip(view.focus, view.way)])
    camera.SetViewUp(view.up)
    camera.SetParallelScale(view.height / 2)
    renderer.ResetCameraClippingRange()
    for position, intensity in (((0.5, 0.7, 1), 0.8), ((-1, -0.3, 0.7), 0.4)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(position)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
    return renderer


def save_picture(path, meshes, view):
    """Draws meshes, given as pairs of a name and a mesh, from left to right."""
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(8)
    window.SetSize(SIDE * len(meshes), SIDE)
    for i, (name, mesh) in enumerate(meshes):
        renderer = renderer_of(name, mesh, view)
        renderer.SetViewport(i / len(meshes), 0, (i + 1) / len(meshes), 1)
        window.AddRenderer(renderer)
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()
    print(os.path.abspath(path))
