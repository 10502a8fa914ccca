# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in pvpython: proxies, defaults, Show and SaveScreenshot."""
import os
import sys

from paraview.simple import *

LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())

# A pipeline in one go: ParaView knows no array of an input that was never updated.
fresh = IsodiamondContour(Input=Wavelet(), Isosurfaces=[157])
fresh.UpdatePipeline()
assert fresh.GetDataInformation().GetNumberOfCells() > 0

wavelet = Wavelet()
wavelet.UpdatePipeline()
middle = sum(wavelet.PointData["RTData"].GetRange()) / 2
extent = wavelet.PointData["RTData"].GetRange()[1] - wavelet.PointData["RTData"].GetRange()[0]

# Contour: defaults that show a surface at once; a slider that goes to 2 % of the diagonal, or with
# the field metric to the array's range; a region of interest that starts as the data's bounds.
contour = IsodiamondContour(wavelet)
assert list(contour.ContourBy) == ["POINTS", "RTData"], contour.ContourBy
assert abs(contour.Isosurfaces[0] - middle) < 1e-3, contour.Isosurfaces
assert contour.ErrorTolerance == 0
assert contour.ErrorMetric == "Distance" and contour.ExactIsovertices and contour.PreserveFeatures
assert contour.PreserveTopology == 1 and contour.MinimumPieceSize == 0
domain = contour.GetProperty("ErrorTolerance").GetDomain("range")
assert domain.GetMinimum(0) == 0 and abs(domain.GetMaximum(0) - 0.02 * 20 * 3**0.5) < 1e-3
assert list(contour.RegionOfInterestPosition) == [-10, -10, -10], contour.RegionOfInterestPosition
assert list(contour.RegionOfInterestSize) == [20, 20, 20], contour.RegionOfInterestSize
assert not contour.UseRegionOfInterest and contour.OutsideErrorTolerance > 1e298
contour.UpdatePipeline()
full = contour.GetDataInformation().GetNumberOfCells()
stock = Contour(wavelet)
stock.UpdatePipeline()
assert full > stock.GetDataInformation().GetNumberOfCells() > 0
contour.ErrorTolerance = 1
contour.UpdatePipeline()
coarse = contour.GetDataInformation().GetNumberOfCells()
assert 0 < coarse < full / 2
contour.ErrorTolerance = 0
contour.UseRegionOfInterest = 1
contour.RegionOfInterestSize = [10, 10, 10]
contour.OutsideErrorTolerance = 1
contour.UpdatePipeline()
assert coarse < contour.GetDataInformation().GetNumberOfCells() < full
contour.UseRegionOfInterest = 0
contour.ErrorMetric = "Field"
contour.ErrorTolerance = 40
contour.UpdatePipeline()
assert 0 < contour.GetDataInformation().GetNumberOfCells() < full / 2
assert abs(domain.GetMaximum(0) - extent) < 1e-3, "the slider adapts to the metric"
larger = Wavelet(WholeExtent=[-20, 20] * 3)
larger.UpdatePipeline()
contour.Input = larger
contour.ErrorMetric = "Distance"
assert abs(domain.GetMaximum(0) - 0.02 * 40 * 3**0.5) < 1e-3, "and to the data"
contour.Input = wavelet


# Removed pieces are counted.
def removed():
    contour.UpdatePipeline()
    contour.UpdatePropertyInformation()
    return contour.GetProperty("NumberOfRemovedPieces")[0]


assert removed() == 0
contour.MinimumPieceSize = 10**6  # more than there are samples
assert removed() > 0
assert contour.GetDataInformation().GetNumberOfCells() == 0
contour.MinimumPieceSize = 0
assert removed() == 0

# Two steps.
hierarchy = IsodiamondHierarchy(wavelet)
assert abs(hierarchy.Isovalue - middle) < 1e-3
assert hierarchy.Model == "Minimal Isodiamonds"
assert hierarchy.PreserveTopology == 1 and hierarchy.MinimumPieceSize == 0
hierarchy.UpdatePipeline()
assert hierarchy.FieldData["NumberOfRemovedPieces"].GetRange() == (0, 0)
extract = IsodiamondExtract(hierarchy)
assert extract.PreserveTopology == 0
domain = extract.GetProperty("ErrorTolerance").GetDomain("range")
assert abs(domain.GetMaximum(0) - extent) < 1e-3, domain.GetMaximum(0)
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == full
points = IsodiamondPoints(hierarchy)
points.UpdatePipeline()
assert sorted(points.PointData.keys()) == ["Class", "Error", "Kind", "Level"]
mesh = DiamondMesh(hierarchy)
mesh.UpdatePipeline()
assert mesh.GetDataInformation().GetNumberOfCells() > 0

# Interval volumes: defaults of the array's range, tolerances that can be set.
volume = IsodiamondIntervalVolume(wavelet)
assert volume.PreserveTopology == 1 and volume.MinimumPieceSize == 0
data_range = wavelet.PointData["RTData"].GetRange()
assert all(abs(a - b) < 1e-3 for a, b in zip(volume.Isorange, data_range)), volume.Isorange
assert volume.InteriorTolerance > 1e298, volume.InteriorTolerance  # off, whatever the array
volume.Isorange = [120, 180]
volume.UpdatePipeline()
tetrahedra = volume.GetDataInformation().GetNumberOfCells()
assert tetrahedra > 0
assert sorted(volume.PointData.keys()) == ["RTData", "Surface"]
volume.ErrorTolerance = 1
volume.UpdatePipeline()
coarse = volume.GetDataInformation().GetNumberOfCells()
assert 0 < coarse < tetrahedra
volume.InteriorTolerance = 5
volume.UpdatePipeline()
assert volume.GetDataInformation().GetNumberOfCells() > coarse
fresh = IsodiamondIntervalVolume(Input=Wavelet(), Isorange=[120, 180])
fresh.UpdatePipeline()
assert fresh.GetDataInformation().GetNumberOfCells() == tetrahedra
tetrahedra_builder = IsodiamondHierarchy(wavelet, Shape="Interval Volume", Isorange=[120, 180])
extract = IsodiamondExtract(tetrahedra_builder)
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == tetrahedra

# The extractor's range and box follow the hierarchy's metric and bounds.
distances = IsodiamondHierarchy(wavelet, ErrorMetric="Distance")
distances.UpdatePipeline()
extract = IsodiamondExtract(distances)
domain = extract.GetProperty("ErrorTolerance").GetDomain("range")
assert abs(domain.GetMaximum(0) - 0.02 * 20 * 3**0.5) < 1e-3, domain.GetMaximum(0)
assert list(extract.RegionOfInterestPosition) == [-10, -10, -10]
assert list(extract.RegionOfInterestSize) == [20, 20, 20]
extract.ErrorTolerance = 1
extract.UpdatePipeline()
assert 0 < extract.GetDataInformation().GetNumberOfCells() < full / 2
mesh = DiamondMesh(distances, ErrorTolerance=1, UseRegionOfInterest=1)
assert mesh.PreserveTopology == 0
mesh.RegionOfInterestSize = [3, 3, 3]
mesh.UpdatePipeline()
assert mesh.GetDataInformation().GetNumberOfCells() > 0

# A hierarchy of diamonds uses the extractor's values only when it is told to.
diamonds = IsodiamondHierarchy(wavelet, Model="Hierarchy of Diamonds (any isovalue)")
extract = IsodiamondExtract(diamonds)
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == full
extract.Isovalue = 200
extract.Shape = "Interval Volume"
extract.Isorange = [120, 180]
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() != tetrahedra
extract.UseIsorange = 1
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == tetrahedra

# Saved and opened again.
path = os.path.join(sys.argv[1], "plugin.vtp")
SaveData(path, proxy=hierarchy, DataMode="Binary")  # see README.md on files
reopened = IsodiamondExtract(OpenDataFile(path))
reopened.UpdatePipeline()
assert reopened.GetDataInformation().GetNumberOfCells() == full

# Shown.
contour.ErrorMetric = "Distance"
contour.ErrorTolerance = 0.5
view = CreateRenderView(ViewSize=[400, 300])
display = Show(contour, view)
display.Representation = "Surface With Edges"
ResetCamera(view)
picture = os.path.join(sys.argv[1], "plugin.png")
SaveScreenshot(picture, view)
assert os.path.getsize(picture) > 5000
print(full, "triangles,", os.path.getsize(picture), "bytes of picture")
