# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in pvpython: proxies, defaults, Show and SaveScreenshot."""
import csv
import os
import sys

from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())

# A pipeline in one go: ParaView knows no arrays of an input that was never updated.
fresh = IsodiamondContour(Input=Wavelet(), Isosurfaces=[157])
fresh.UpdatePipeline()
assert fresh.GetDataInformation().GetNumberOfCells() > 0

# Nor does it know bounds: the region of interest has no size then, of which the filter warns, and
# is not inside out.
assert list(fresh.RegionOfInterestSize) == [0, 0, 0], fresh.RegionOfInterestSize
assert list(fresh.RegionOfInterestPosition) == [0, 0, 0], fresh.RegionOfInterestPosition
assert list(fresh.ViewPosition) == [0, 0, 1], fresh.ViewPosition
never = Wavelet()
assert IsodiamondHierarchy(never).Isovalue == 0
assert list(IsodiamondHierarchy(never).Isorange) == [0, 1]
assert list(IsodiamondIntervalVolume(never).Isorange) == [0, 1]

wavelet = Wavelet()
wavelet.UpdatePipeline()
low, high = wavelet.PointData["RTData"].GetRange()
extent = high - low

# Contour: defaults that show a surface at once; a slider that goes to 2 % of the diagonal, or with
# the field metric to the array's range; a region of interest that starts as the middle half of the
# data's bounds. All are numbers that a person would type.
contour = IsodiamondContour(wavelet)
assert list(contour.ContourBy) == ["POINTS", "RTData"], contour.ContourBy
assert list(contour.Isosurfaces) == [160], contour.Isosurfaces  # the array: 37.4 to 276.8

# What the panel's button for default values does.
contour.SMProxy.GetProperty("ErrorTolerance").ResetToDefault()
assert contour.ErrorTolerance == 0, contour.ErrorTolerance
assert contour.ErrorTolerance == 0 and contour.ToleranceUnit == "World Units"
assert contour.TargetNumberOfTriangles == 0 and contour.ComputeScalars == 1
assert contour.ErrorMetric == "Distance" and contour.ExactIsovertices and contour.PreserveFeatures
assert contour.PreserveTopology == 1 and contour.MinimumPieceSize == 0
domain = contour.GetProperty("ErrorTolerance").GetDomain("range")
assert domain.GetMinimum(0) == 0 and domain.GetMaximum(0) == 0.7, domain.GetMaximum(0)  # 0.693
assert list(contour.RegionOfInterestPosition) == [-5, -5, -5], contour.RegionOfInterestPosition
assert list(contour.RegionOfInterestSize) == [10, 10, 10], contour.RegionOfInterestSize
assert not contour.UseRegionOfInterest and contour.OutsideErrorTolerance == 0
assert list(contour.ViewPosition) == [0, 0, 70], contour.ViewPosition  # as a new view's camera
contour.UpdatePipeline()
full = contour.GetDataInformation().GetNumberOfCells()
assert not any("tolerance" in name for name in contour.FieldData.keys())
stock = Contour(wavelet)
stock.UpdatePipeline()
assert full > stock.GetDataInformation().GetNumberOfCells() > 0
contour.ErrorTolerance = 1
contour.UpdatePipeline()
coarse = contour.GetDataInformation().GetNumberOfCells()
assert 0 < coarse < full / 2
# The Information tab tells how many triangles there would be at other tolerances.
table = {name: contour.FieldData[name].GetRange()[0] for name in contour.FieldData.keys()}
assert table["Triangles at tolerance 0"] == full, table
assert full > table["Triangles at tolerance 0.1"] > table["Triangles at tolerance 0.5"] > coarse


# ParaView's panels have no widget for ids.
for proxy in (contour, IsodiamondIntervalVolume(wavelet), IsodiamondHierarchy(wavelet)):
    properties = proxy.SMProxy.NewPropertyIterator()
    properties.UnRegister(None)
    while not properties.IsAtEnd():
        shown = properties.GetProperty()
        isOfIds = shown.IsA("vtkSMIdTypeVectorProperty") and not shown.GetInformationOnly()
        assert not isOfIds, properties.GetKey()
        properties.Next()


# The viewpoint is found for each axis by itself: the same number on two of them changes neither.
long = Wavelet(WholeExtent=[0, 140, -10, 10, -10, 10])
long.UpdatePipeline()
assert list(IsodiamondContour(long).ViewPosition) == [70, 0, 70]

# In blocks: ParaView's sources make no more of the volume than is asked for.
triangles = []
for blocks in (1, 4):
    parts = Wavelet(WholeExtent=[-16, 16] * 3)
    cut = IsodiamondContour(parts, Isosurfaces=[160], ErrorTolerance=0.5, NumberOfBlocks=blocks)
    cut.UpdatePipeline()
    triangles.append(cut.GetDataInformation().GetNumberOfCells())
    made = parts.GetClientSideObject().GetOutputDataObject(0).GetExtent()
    assert made[5] - made[4] == (32 if blocks == 1 else 16), made  # a quarter of 33 slices, plus 8
assert triangles[0] == triangles[1] > 0, triangles

# Tolerances in voxels of half a unit; the slider is in voxels, too.
source = vtkRTAnalyticSource()
source.SetWholeExtent(-10, 10, -10, 10, -10, 10)
source.Update()
source.GetOutput().SetSpacing(0.5, 0.5, 0.5)
writer = vtkXMLImageDataWriter()
writer.SetInputData(source.GetOutput())
writer.SetDataModeToBinary()
writer.SetFileName(os.path.join(sys.argv[1], "halves.vti"))
writer.Write()
voxels = OpenDataFile(writer.GetFileName())
voxels.UpdatePipeline()
scaled = IsodiamondContour(voxels, Isosurfaces=[160], ToleranceUnit="Voxels", ErrorTolerance=1)
assert scaled.GetProperty("ErrorTolerance").GetDomain("range").GetMaximum(0) == 0.7
scaled.UpdatePipeline()
assert scaled.GetDataInformation().GetNumberOfCells() == coarse
assert scaled.FieldData["Triangles at tolerance 0.5"].GetRange() == (
    table["Triangles at tolerance 0.5"],
) * 2
scaled.ToleranceUnit = "World Units"
scaled.ErrorTolerance = 0.5
scaled.UpdatePipeline()
assert scaled.GetDataInformation().GetNumberOfCells() == coarse

# A number of triangles instead of a tolerance.
target = (full + coarse) // 3
contour.TargetNumberOfTriangles = target
contour.UpdatePipeline()
assert 0.95 * target < contour.GetDataInformation().GetNumberOfCells() <= target
achieved = contour.FieldData["AchievedTolerance"].GetRange()[0]
assert 0 < achieved < 1, achieved
contour.UpdatePropertyInformation()
assert contour.GetProperty("AchievedTolerance")[0] == achieved
contour.TargetNumberOfTriangles = 0
contour.ErrorTolerance = achieved
contour.UpdatePipeline()
assert 0.95 * target < contour.GetDataInformation().GetNumberOfCells() <= target
contour.ErrorTolerance = 0
contour.UseRegionOfInterest = 1
contour.RegionOfInterestSize = [10, 10, 10]
contour.UpdatePipeline()
chosen = contour.GetDataInformation().GetNumberOfCells()
assert coarse < chosen < full
contour.OutsideErrorTolerance = 1  # a voxel, as the default chose
contour.UpdatePipeline()
assert contour.GetDataInformation().GetNumberOfCells() == chosen
contour.UseRegionOfInterest = 0
contour.ErrorMetric = "Field"
contour.ErrorTolerance = 40
contour.UpdatePipeline()
assert 0 < contour.GetDataInformation().GetNumberOfCells() < full / 2
assert domain.GetMaximum(0) == 240, "the slider adapts to the metric"
larger = Wavelet(WholeExtent=[-20, 20] * 3)
larger.UpdatePipeline()
contour.Input = larger
contour.ErrorMetric = "Distance"
assert domain.GetMaximum(0) == 1.4, "and to the data"
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

# Data that are all the same, and data with an infinite value, have usable defaults, too.
odd = vtkImageData()
odd.SetDimensions(3, 3, 3)
for name, values in (("constant", [3] * 27), ("spike", [float("inf")] + list(range(1, 27)))):
    array = vtkFloatArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    odd.GetPointData().AddArray(array)
producer = TrivialProducer()
producer.GetClientSideObject().SetOutput(odd)
producer.UpdatePipeline()
constant = IsodiamondIntervalVolume(producer, InputScalars=["POINTS", "constant"])
assert list(constant.Isorange) == [3, 6], constant.Isorange
constant.UpdatePipeline()
assert constant.GetDataInformation().GetNumberOfCells() > 0
spike = IsodiamondContour(producer, ContourBy=["POINTS", "spike"])
assert list(spike.Isosurfaces) == [14], spike.Isosurfaces  # finite values: 1 to 26
spike.UpdatePipeline()
assert spike.GetDataInformation().GetNumberOfCells() > 0

# What a constructor is given stays, whatever it is.
given = IsodiamondHierarchy(wavelet, Isovalue=0)
assert given.Isovalue == 0, given.Isovalue
given = IsodiamondHierarchy(wavelet, Shape="Interval Volume", Isorange=[0, 1])
assert list(given.Isorange) == [0, 1], given.Isorange
given = IsodiamondContour(
    wavelet,
    Isosurfaces=[0],
    RegionOfInterestPosition=[0, 0, 0],
    RegionOfInterestSize=[1, 1, 1],
    ViewPosition=[0, 0, 1],
)
assert list(given.Isosurfaces) == [0], given.Isosurfaces
assert list(given.RegionOfInterestPosition) == [0, 0, 0], given.RegionOfInterestPosition
assert list(given.ViewPosition) == [0, 0, 1], given.ViewPosition
given = IsodiamondIntervalVolume(wavelet, Isorange=[0, 1])
assert list(given.Isorange) == [0, 1], given.Isorange

# Two steps.
hierarchy = IsodiamondHierarchy(wavelet)
assert hierarchy.Isovalue == 160 and hierarchy.ErrorMetric == "Automatic"
assert hierarchy.Model == "Minimal Isodiamonds"
assert hierarchy.PreserveTopology == 1 and hierarchy.MinimumPieceSize == 0
hierarchy.UpdatePipeline()
assert hierarchy.FieldData["NumberOfRemovedPieces"].GetRange() == (0, 0)
zero = IsodiamondExtract(hierarchy, UseIsovalue=1, Isovalue=0)
assert zero.Isovalue == 0, zero.Isovalue
extract = IsodiamondExtract(hierarchy)
assert extract.PreserveTopology == 0 and extract.Isovalue == 160
domain = extract.GetProperty("ErrorTolerance").GetDomain("range")
assert domain.GetMaximum(0) == 0.7, domain.GetMaximum(0)  # by distance
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == full
assert extract.GetDataInformation().GetDataSetTypeAsString() == "vtkUnstructuredGrid"
display = Show(extract)
assert display.ColorArrayName[1] in ("", None), "in no colour of the isovalue"
Hide(extract)
# As poly data it suits filters that take surfaces.
extract.OutputType = "Poly Data"
decimated = Decimate(extract, TargetReduction=0.5)
decimated.UpdatePipeline()
assert extract.GetDataInformation().GetDataSetTypeAsString() == "vtkPolyData"
assert extract.GetDataInformation().GetNumberOfCells() == full
assert 0 < decimated.GetDataInformation().GetNumberOfCells() < 0.6 * full
extract.TargetNumberOfTriangles = target
extract.UpdatePipeline()
assert 0.95 * target < extract.GetDataInformation().GetNumberOfCells() <= target
points = IsodiamondPoints(hierarchy)
points.UpdatePipeline()
assert sorted(points.PointData.keys()) == ["Class", "Error", "Kind", "Level"]
mesh = DiamondMesh(hierarchy)
mesh.UpdatePipeline()
assert mesh.GetDataInformation().GetNumberOfCells() > 0

# All point arrays: the one that the hierarchy is built from is passed over.
carrying = IsodiamondHierarchy(wavelet, PointArrays=["RTData"])
carrying.UpdatePipeline()
assert carrying.FieldData["Isovalue"].GetRange() == (160, 160)

# Interval volumes: defaults from the array's range, tolerances that can be set.
volume = IsodiamondIntervalVolume(wavelet)
assert volume.PreserveTopology == 1 and volume.MinimumPieceSize == 0
assert list(volume.Isorange) == [120, 200], volume.Isorange  # about the middle third
assert volume.UseInteriorTolerance == 0 and volume.InteriorTolerance == 1
volume.Isorange = [120, 180]
volume.UpdatePipeline()
tetrahedra = volume.GetDataInformation().GetNumberOfCells()
assert tetrahedra > 0
assert sorted(volume.PointData.keys()) == ["RTData", "Surface"]
# Numbers in CSV files, not characters.
table = os.path.join(sys.argv[1], "volume.csv")
for association, name, lowest in (("Point Data", "Surface", -1), ("Cell Data", "Level", 0)):
    SaveData(table, volume, FieldAssociation=association)
    with open(table, encoding="ascii") as lines:
        numbers = {int(row[name]) for row in csv.DictReader(lines)}
    assert len(numbers) > 1 and lowest <= min(numbers) and max(numbers) < 30, numbers
points_table = os.path.join(sys.argv[1], "points.csv")
SaveData(points_table, points)
with open(points_table, encoding="ascii") as lines:
    assert all(int(row[name]) >= 0 for row in csv.DictReader(lines) for name in ("Class", "Level"))
volume.ErrorTolerance = 1
volume.UpdatePipeline()
coarse = volume.GetDataInformation().GetNumberOfCells()
assert 0 < coarse < tetrahedra
assert volume.FieldData["Tetrahedra at tolerance 0"].GetRange()[0] == tetrahedra
volume.InteriorTolerance = 5
volume.UseInteriorTolerance = 1
volume.ComputeGradients = 1
volume.UpdatePipeline()
assert volume.GetDataInformation().GetNumberOfCells() > coarse
assert volume.PointData["Gradient"].GetNumberOfComponents() == 3
fresh = IsodiamondIntervalVolume(Input=Wavelet(), Isorange=[120, 180])
fresh.UpdatePipeline()
assert fresh.GetDataInformation().GetNumberOfCells() == tetrahedra
tetrahedra_builder = IsodiamondHierarchy(wavelet, Shape="Interval Volume", Isorange=[120, 180])
extract = IsodiamondExtract(tetrahedra_builder)
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == tetrahedra

# The extractor's slider and box follow the hierarchy's metric and bounds.
distances = IsodiamondHierarchy(wavelet, ErrorMetric="Distance")
distances.UpdatePipeline()
extract = IsodiamondExtract(distances)
domain = extract.GetProperty("ErrorTolerance").GetDomain("range")
assert domain.GetMaximum(0) == 0.7, domain.GetMaximum(0)
assert list(extract.RegionOfInterestPosition) == [-5, -5, -5]
assert list(extract.RegionOfInterestSize) == [10, 10, 10]
assert list(extract.ViewPosition) == [0, 0, 70]
extract.ErrorTolerance = 1
extract.UpdatePipeline()
assert 0 < extract.GetDataInformation().GetNumberOfCells() < full / 2
mesh = DiamondMesh(distances, ErrorTolerance=1, UseRegionOfInterest=1)
assert mesh.PreserveTopology == 0
mesh.RegionOfInterestSize = [3, 3, 3]
mesh.UpdatePipeline()
assert mesh.GetDataInformation().GetNumberOfCells() > 0

# From a hierarchy of diamonds, an extractor uses its own values only when told to.
diamonds = IsodiamondHierarchy(wavelet, Model="Hierarchy of Diamonds (any isovalue)")
extract = IsodiamondExtract(diamonds)
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == full
extract = IsodiamondExtract(diamonds)  # the hierarchy's values are known now
assert extract.Isovalue == 160 and list(extract.Isorange) == [120, 200]
for name in ("Isovalue", "Isorange"):  # sliders over the range of the samples
    domain = extract.GetProperty(name).GetDomain("own")
    assert (domain.GetMinimum(0), domain.GetMaximum(0)) == wavelet.PointData[0].GetRange(0), name
extract.UseIsovalue = 1
extract.UpdatePipeline()
assert extract.GetDataInformation().GetNumberOfCells() == full
extract.UseIsovalue = 0
minimal = IsodiamondHierarchy(diamonds)
assert minimal.Isovalue == 160 and list(minimal.Isorange) == [120, 200]
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
