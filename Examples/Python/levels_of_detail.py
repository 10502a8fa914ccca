# SPDX-License-Identifier: BSD-3-Clause
"""Levels of detail with VTK alone: python3 levels_of_detail.py [HIERARCHY.vtp]

PYTHONPATH must name the folder that has the package isodiamonds. Builds the hierarchy of an
isosurface once, extracts it at several error tolerances and with a region of interest, and writes
the hierarchy to a file if one is given.
"""
import sys

from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

volume = vtkRTAnalyticSource()
volume.SetWholeExtent(-40, 40, -40, 40, -40, 40)

builder = vtkIsodiamondBuilder()
builder.SetInputConnection(volume.GetOutputPort())
builder.SetIsovalue(157)
builder.SetErrorMetricToDistance()
builder.PreserveTopologyOn()

extractor = vtkIsodiamondExtractor()
extractor.SetInputConnection(builder.GetOutputPort())
for tolerance in (0, 0.25, 0.5, 1):
    extractor.SetErrorTolerance(tolerance)
    extractor.Update()
    print(f"tolerance {tolerance}: {extractor.GetOutput().GetNumberOfCells()} triangles")

extractor.SetErrorTolerance(0)
extractor.UseRegionOfInterestOn()
extractor.SetRegionOfInterest(-40, 0, -40, 0, -40, 0)
extractor.SetOutsideErrorTolerance(1)
extractor.Update()
print(f"0 in a box, 1 outside: {extractor.GetOutput().GetNumberOfCells()} triangles")

if len(sys.argv) > 1:
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(builder.GetOutputPort())
    writer.SetFileName(sys.argv[1])
    writer.SetDataModeToBinary()  # see README.md on files
    writer.Write()
