# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView puts in front of the filters: cell data, composite data, time, other grids."""
import os

from paraview.modules.vtkRemotingServerManager import vtkSMInputArrayDomain
from paraview.simple import *

import isodiamonds  # so that objects have their own classes

LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())


def cells(filter):
    filter.UpdatePipeline()
    return filter.GetDataInformation().GetNumberOfCells()


def builds(filter):
    return filter.GetClientSideObject().GetNumberOfBuilds()


wavelet = Wavelet()
wavelet.UpdatePipeline()
expected = cells(IsodiamondContour(wavelet, Isosurfaces=[150]))
assert expected > 0

# Cell data, converted by ParaView, where that is an option: the same as by hand.
of_cells = PointDatatoCellData(wavelet)
by_hand = CellDatatoPointData(of_cells)
by_hand.UpdatePipeline()
vtkSMInputArrayDomain.SetAutomaticPropertyConversion(True)
converted = IsodiamondContour(of_cells, Isosurfaces=[150])
assert cells(converted) == cells(IsodiamondContour(by_hand, Isosurfaces=[150])) > 0
region = IsodiamondIntervalVolume(of_cells, Isorange=[150, 300])
assert cells(region) == cells(IsodiamondIntervalVolume(by_hand, Isorange=[150, 300])) > 0
vtkSMInputArrayDomain.SetAutomaticPropertyConversion(False)

# Composite data sets, block by block; a new tolerance builds nothing.
small = Wavelet(WholeExtent=[-5, 5] * 3)
group = GroupDatasets(Input=[wavelet, small])
group.UpdatePipeline()
blocks = IsodiamondContour(group, Isosurfaces=[150])
assert cells(blocks) == expected + cells(IsodiamondContour(small, Isosurfaces=[150]))
assert blocks.GetDataInformation().GetCompositeDataClassName() == "vtkMultiBlockDataSet"
assert builds(blocks) == 2
blocks.ErrorTolerance = 0.5
assert 0 < cells(blocks) < expected
assert builds(blocks) == 2
domain = blocks.GetProperty("ErrorTolerance").GetDomain("range")
assert domain.GetMaximum(0) == 0.7, domain.GetMaximum(0)  # 2 % of the diagonal, rounded up

# Time: a field that moves. Every step has its surface; a second round builds nothing.
steps = ProgrammableSource(OutputDataSetType="vtkImageData")
steps.ScriptRequestInformation = """
executive = self.GetExecutive()
info = executive.GetOutputInformation(0)
info.Set(executive.WHOLE_EXTENT(), 0, 20, 0, 20, 0, 20)
info.Set(executive.TIME_STEPS(), [0.0, 1.0, 2.0, 3.0], 4)
info.Set(executive.TIME_RANGE(), [0.0, 3.0], 2)
"""
steps.Script = """
import numpy
executive = self.GetExecutive()
time = executive.GetOutputInformation(0).Get(executive.UPDATE_TIME_STEP())
output.SetDimensions(21, 21, 21)
z, y, x = numpy.mgrid[0:21, 0:21, 0:21]
field = 6.0 + time - numpy.sqrt((x - 10.0) ** 2 + (y - 10.0) ** 2 + (z - 10.0) ** 2)
output.PointData.append(field.ravel(), "distance")
"""
steps.UpdatePipeline(0.0)
moving = IsodiamondContour(steps, Isosurfaces=[0.0])
areas = []
for time in [0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]:
    moving.UpdatePipeline(time)
    bounds = moving.GetDataInformation().GetBounds()
    areas.append(bounds[1] - bounds[0])
for step in range(4):
    assert abs(areas[step] - 2 * (6 + step)) < 0.2, areas
assert areas[4:] == areas[:4]
assert builds(moving) == 4, builds(moving)

# Rectilinear and structured grids.
rectilinear = ProgrammableFilter(wavelet, OutputDataSetType="vtkRectilinearGrid")
rectilinear.Script = """
from paraview import vtk
image = inputs[0].VTKObject
grid = self.GetOutput()
grid.SetDimensions(image.GetDimensions())
for axis, name in enumerate("XYZ"):
    coordinates = vtk.vtkDoubleArray()
    for i in range(image.GetDimensions()[axis]):
        coordinates.InsertNextValue(i + 0.01 * i * i)
    getattr(grid, "Set" + name + "Coordinates")(coordinates)
grid.GetPointData().ShallowCopy(image.GetPointData())
"""
uneven = IsodiamondContour(rectilinear, Isosurfaces=[150])
assert cells(uneven) == expected
uneven.ErrorTolerance = 0.5
assert 0 < cells(uneven) < expected
uneven.ErrorMetric = "Field"
uneven.ErrorTolerance = 20
assert 0 < cells(uneven) < expected
shifts = Calculator(wavelet, ResultArrayName="shift", Function="iHat*0.1*coordsY")
shifts.UpdatePipeline()
warped = WarpByVector(shifts, Vectors=["POINTS", "shift"])
warped.UpdatePipeline()
assert warped.GetDataInformation().GetDataSetTypeAsString() == "vtkStructuredGrid"
bent = IsodiamondContour(warped, ContourBy=["POINTS", "RTData"], Isosurfaces=[150])
assert cells(bent) == expected

# A viewpoint from a render view.
from isodiamonds import view as viewpoint

window = CreateView("RenderView")
window.ViewSize = [300, 200]
surface = IsodiamondContour(wavelet, Isosurfaces=[150])
Show(surface, window)
window.CameraPosition = [0, 0, 100]
Render(window)
following = viewpoint.follow(surface, window)
assert surface.ViewDependent and surface.ViewHeight == 200
assert list(surface.ViewPosition) == list(window.CameraPosition)
near = cells(surface)
window.CameraPosition = [0, 0, 1000]
window.GetInteractor().InvokeEvent("EndInteractionEvent")
assert list(surface.ViewPosition) == [0, 0, 1000]
assert 0 < cells(surface) < near < expected
following.stop()
window.CameraPosition = [0, 0, 100]
window.GetInteractor().InvokeEvent("EndInteractionEvent")
assert list(surface.ViewPosition) == [0, 0, 1000]
window.CameraParallelProjection = 1
try:
    viewpoint.use(surface, window)
    assert False, "a parallel projection has no viewpoint"
except ValueError:
    pass
