# SPDX-License-Identifier: BSD-3-Clause
"""Runs in ParaView's window: shows one of the plugin's filters, by the name in $ISODIAMONDS_PANEL, on
the data named in $ISODIAMONDS_DATA. docs/panels.sh starts it and takes the picture."""
import math
import os

from paraview.simple import *
from vtkmodules.vtkImagingCore import vtkImageShiftScale, vtkRTAnalyticSource
from vtkmodules.vtkIOImage import vtkNIFTIImageReader
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())
LoadPalette("WhiteBackground")


def wavelet():
    return Wavelet(WholeExtent=[-16, 16] * 3)


def image(data, name):
    """A VTK image as a source, through a file: what a user opens."""
    path = os.path.join(os.path.dirname(os.environ["ISODIAMONDS_READY"]), name + ".vti")
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(data)
    writer.SetDataModeToBinary()
    writer.SetFileName(path)
    writer.Write()
    return OpenDataFile(path)


def head():
    reader = vtkNIFTIImageReader()
    reader.SetFileName(os.environ["ISODIAMONDS_HEAD"])
    reader.Update()
    return image(reader.GetOutput(), "head")


def bytes_volume():
    """An unsigned char volume."""
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-16, 16, -16, 16, -16, 16)
    cast = vtkImageShiftScale()
    cast.SetInputConnection(source.GetOutputPort())
    cast.SetShift(-37)
    cast.SetOutputScalarTypeToUnsignedChar()
    cast.ClampOverflowOn()
    cast.Update()
    return image(cast.GetOutput(), "bytes")


volume = {"wavelet": wavelet, "head": head, "bytes": bytes_volume}[
    os.environ.get("ISODIAMONDS_DATA", "wavelet")
]()
volume.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")


def show(filter, representation="Surface With Edges"):
    display = Show(filter, view)
    display.SetRepresentationType(representation)
    SetActiveSource(filter)
    return display


def contour():
    """As it comes."""
    show(IsodiamondContour(volume), "Surface")


def contour_tolerance():
    surface = IsodiamondContour(volume)
    surface.ErrorTolerance = surface.GetProperty("ErrorTolerance").GetDomain("range").GetMaximum(0) / 3
    show(surface)


def contour_region():
    surface = IsodiamondContour(volume)
    bounds = volume.GetDataInformation().GetBounds()
    surface.UseRegionOfInterest = 1
    surface.RegionOfInterestPosition = [bounds[0], bounds[2], (bounds[4] + bounds[5]) / 2]
    surface.RegionOfInterestSize = [(bounds[1] - bounds[0]) / 2, bounds[3] - bounds[2],
                                    (bounds[5] - bounds[4]) / 2]
    show(surface)


def interval_volume():
    region = IsodiamondIntervalVolume(volume)
    highest = volume.PointData[0].GetRange()[1]
    region.Isorange = [region.Isorange[0], math.ceil(highest / 10) * 10]  # all above the lower value
    region.ErrorTolerance = 0.5
    show(region)


def built(**properties):
    """A hierarchy that has been applied: what follows adapts to it."""
    made = IsodiamondHierarchy(volume, **properties)
    made.UpdatePipeline()
    return made


def hierarchy():
    show(built(), "Wireframe")


def extract():
    extracted = IsodiamondExtract(built(ComputeNormals=1))
    largest = extracted.GetProperty("ErrorTolerance").GetDomain("range").GetMaximum(0)
    extracted.ErrorTolerance = float(f"{largest / 5:.1g}")
    show(extracted)


def points():
    shown = IsodiamondPoints(built(Model="Relevant Isodiamonds"))
    display = show(shown, "Points")
    display.PointSize = 4
    ColorBy(display, ("POINTS", "Kind"))


def diamond_mesh():
    mesh = DiamondMesh(built())
    mesh.ErrorTolerance = 1
    show(mesh)


globals()[os.environ["ISODIAMONDS_PANEL"]]()
view.CameraPosition = [120, -100, 80]
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
Render(view)
open(os.environ["ISODIAMONDS_READY"], "w").close()
