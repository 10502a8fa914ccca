# SPDX-License-Identifier: BSD-3-Clause
"""The wrapped classes in Python: names, properties, a pipeline."""
import isodiamonds
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

source = vtkRTAnalyticSource()
source.SetWholeExtent(-16, 16, -16, 16, -16, 16)

builder = isodiamonds.vtkIsodiamondBuilder()
builder.SetInputConnection(source.GetOutputPort())
builder.SetModelToMinimal()
builder.SetIsovalue(150.0)
extractor = isodiamonds.vtkIsodiamondExtractor()
extractor.SetInputConnection(builder.GetOutputPort())

triangles = []
for tolerance in [0.0, 2.0, 10.0, 50.0]:
    extractor.SetErrorTolerance(tolerance)
    extractor.Update()
    triangles.append(extractor.GetOutput().GetNumberOfCells())
assert triangles == sorted(triangles, reverse=True) and triangles[0] > 2 * triangles[2], triangles

hierarchy = builder.GetHierarchy()
assert isinstance(hierarchy, isodiamonds.vtkIsodiamondHierarchy)
assert hierarchy.GetModel() == hierarchy.MINIMAL
assert hierarchy.GetNumberOfActiveIsodiamonds() > 0
assert not builder.GetPreserveTopology() and not hierarchy.GetPreservesTopology()
assert not hierarchy.GetTwoSidedDistances()  # with the field metric
assert builder.GetMinimumPieceSize() == hierarchy.GetMinimumPieceSize() == 0
assert hierarchy.GetNumberOfRemovedPieces() == 0
output = extractor.GetOutput()
assert output.GetPointData().GetArray("RTData").GetRange() == (150.0, 150.0)

contour = isodiamonds.vtkIsodiamondContour()
contour.SetInputConnection(source.GetOutputPort())
contour.SetValue(0, 150.0)
assert contour.GetPreserveTopology() and contour.GetMinimumPieceSize() == 0
contour.Update()
assert contour.GetNumberOfRemovedPieces() == 0
assert contour.GetOutput().GetNumberOfCells() == triangles[0]

points = isodiamonds.vtkIsodiamondPoints()
points.SetInputConnection(builder.GetOutputPort())
points.Update()
assert points.GetOutput().GetNumberOfPoints() == (
    hierarchy.GetNumberOfActiveIsodiamonds() + hierarchy.GetNumberOfCreationIsodiamonds())

mesh = isodiamonds.vtkDiamondMesh()
mesh.SetInputConnection(builder.GetOutputPort())
mesh.Update()
assert mesh.GetOutput().GetNumberOfCells() > 0
print("triangles", triangles)
