#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds and extracts a surface of a 1024^3 volume of bytes, and prints how much memory that took."""
import resource
import time

import numpy as np
from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from volumes import parser_of_size

parser = parser_of_size(__doc__, 1024)
parser.add_argument("metric", nargs="?", choices=["field", "distance"], default="field")
arguments = parser.parse_args()
size, metric = arguments.size, arguments.metric


def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


# A bumpy ball: its surface touches about one sample in three hundred.
axis = np.linspace(-1.0, 1.0, size, dtype=np.float32)
volume = np.empty((size, size, size), np.uint8)
for k, z in enumerate(axis):
    radius = np.sqrt(axis[None, :] ** 2 + axis[:, None] ** 2 + z * z)
    bumps = np.sin(20 * axis[None, :]) * np.sin(20 * axis[:, None]) * np.sin(20 * z)
    volume[k] = np.clip(255 * (1 - radius) + 12 * bumps, 0, 255)

image = vtkImageData()
image.SetDimensions(size, size, size)
image.GetPointData().SetScalars(numpy_to_vtk(volume.ravel()))  # shares the memory
print(f"the volume alone: {peak():.2f} GiB")

builder = vtkIsodiamondBuilder()
builder.SetInputData(image)
builder.SetIsovalue(100)
if metric == "distance":
    builder.SetErrorMetricToDistance()
else:
    builder.SetErrorMetricToField()
start = time.time()
builder.Update()
print(f"built by {metric} in {time.time() - start:.1f} s: {peak():.2f} GiB")
for tolerance in (0.0, 1.0):
    extractor = vtkIsodiamondExtractor()
    extractor.SetInputConnection(builder.GetOutputPort())
    extractor.SetErrorTolerance(tolerance)
    start = time.time()
    extractor.Update()
    triangles = extractor.GetOutput().GetNumberOfCells()
    print(
        f"tolerance {tolerance}: {triangles} triangles in {time.time() - start:.2f} s:"
        f" {peak():.2f} GiB"
    )
