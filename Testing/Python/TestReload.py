# SPDX-License-Identifier: BSD-3-Clause
"""A hierarchy in a file: a process that never saw the volume extracts the same meshes."""
import os
import subprocess
import sys
import zlib

import isodiamonds
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def describe(hierarchy_port):
    """The meshes extracted at some tolerances, as text."""
    lines = []
    for tolerance in [0.0, 3.0, 20.0]:
        extractor = isodiamonds.vtkIsodiamondExtractor()
        extractor.SetInputConnection(hierarchy_port)
        extractor.SetErrorTolerance(tolerance)
        extractor.Update()
        grid = extractor.GetOutput()
        checksum = 0
        for array in [grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray(),
                      grid.GetCellData().GetArray("Level")]:
            checksum = zlib.crc32(memoryview(array).tobytes(), checksum)
        lines.append(f"{tolerance} {grid.GetNumberOfPoints()} {grid.GetNumberOfCells()} {checksum}")
    return "\n".join(lines)


if len(sys.argv) == 3:  # the other process
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(sys.argv[2])
    print(describe(reader.GetOutputPort()))
    sys.exit(0)

path = os.path.join(sys.argv[1], "reload.vtp")
source = vtkRTAnalyticSource()
source.SetWholeExtent(-14, 16, -10, 11, -16, 16)
for model in [0, 1, 2]:
    builder = isodiamonds.vtkIsodiamondBuilder()
    builder.SetInputConnection(source.GetOutputPort())
    builder.SetModel(model)
    builder.SetIsovalue(150.0)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(builder.GetOutputPort())
    writer.SetFileName(path)
    writer.SetDataModeToBinary()  # see README.md on files
    assert writer.Write() == 1
    expected = describe(builder.GetOutputPort())
    output = subprocess.check_output(
        [os.environ["ISODIAMONDS_PYTHON"], sys.argv[0], sys.argv[1], path], text=True)
    found = "\n".join(output.splitlines()[-3:])  # MPI may print something before
    assert found == expected, f"{found}\n{expected}"
    print(found)
