# SPDX-License-Identifier: BSD-3-Clause
"""A pipeline of all filters comes back from a .pvsm file, from a Python state, and from the trace of
a session. Argument: a folder for files."""
import os
import sys

from paraview import smstate, smtrace
from paraview.simple import *

LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())


names = ("contour", "region", "hierarchy", "extract", "points", "mesh")


def session():
    """What a user does, with hardly a property at its default; sources are known by name. A trace
    has the properties that a filter is made with, and those that the window's Apply changes."""
    wavelet = Wavelet(registrationName="volume", WholeExtent=[-20, 20] * 3)
    wavelet.UpdatePipeline()
    IsodiamondContour(
        wavelet,
        registrationName="contour",
        Isosurfaces=[140, 170],
        ErrorTolerance=0.3,
        UseRegionOfInterest=1,
        RegionOfInterestPosition=[-20, -20, -20],
        RegionOfInterestSize=[20, 40, 40],
        OutsideErrorTolerance=1,
        ComputeGradients=1,
        CloseBoundary=1,
        OutputPointsPrecision="Double",
    )
    IsodiamondIntervalVolume(
        wavelet,
        registrationName="region",
        Isorange=[150, 250],
        ErrorMetric="Field",
        ErrorTolerance=20,
        UseInteriorTolerance=1,
        InteriorTolerance=15,
        PreserveTopology=0,
        MinimumPieceSize=20,
    )
    hierarchy = IsodiamondHierarchy(
        wavelet,
        registrationName="hierarchy",
        Isovalue=150,
        ErrorMetric="Distance",
        Model="Relevant Isodiamonds",
        ComputeNormals=1,
    )
    hierarchy.UpdatePipeline()
    IsodiamondExtract(
        hierarchy,
        registrationName="extract",
        ViewDependent=1,
        ViewPosition=[0, 0, 100],
        PixelTolerance=3,
    )
    IsodiamondPoints(hierarchy, registrationName="points")
    DiamondMesh(hierarchy, registrationName="mesh", ErrorTolerance=1)
    view = GetActiveViewOrCreate("RenderView")
    for name in names:
        Show(FindSource(name), view)
    Render(view)


def counts():
    result = {}
    for name in names:
        source = FindSource(name)
        assert source, name
        source.UpdatePipeline()
        information = source.GetDataInformation()
        result[name] = (information.GetNumberOfCells(), information.GetNumberOfPoints())
        assert result[name][0] > 0, name
    return result


def forget():
    for source in list(GetSources().values()):
        Delete(source)
    for view in GetRenderViews():
        Delete(view)
    assert FindSource("contour") is None


smtrace.start_trace()
session()
trace = smtrace.stop_trace()
expected = counts()
state = os.path.join(sys.argv[1], "isodiamonds.pvsm")
SaveState(state)
script = smstate.get_state()

forget()
LoadState(state)
assert counts() == expected, (counts(), expected)
assert list(FindSource("contour").Isosurfaces) == [140, 170]
assert FindSource("extract").PixelTolerance == 3
assert FindSource("region").PreserveTopology == 0 and FindSource("region").MinimumPieceSize == 20

forget()
exec(script, dict(globals()))
assert counts() == expected, (counts(), expected)

forget()
exec(trace, dict(globals()))
assert counts() == expected, (counts(), expected)
