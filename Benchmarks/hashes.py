# SPDX-License-Identifier: BSD-3-Clause
"""Hashes of hierarchies and of meshes from them: the same on every system, and before and after a
change that should change no result.

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/hashes.py [FILE:ISOVALUE ...]

FILE is NAME_XxYxZ_TYPE.raw or a NIfTI file, of which the surface and what lies above the value are
hashed; the default is Debian's MRI head if it is installed. First come volumes made here: the same
integers as 16-bit integers and as floats, with uneven spacing. There is a line for each hierarchy:
volume, shape, model, metric, the hash of its arrays, and a hash for each mesh.
"""
import hashlib
import itertools
import math
import os
import re
import sys

from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkShortArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkImageReader2, vtkNIFTIImageReader

HEAD = "/usr/share/mricron/templates/ch2.nii.gz:40.5"
SIZE = (45, 38, 41)
SPACING = (1.0, 0.75, 1.5)
TOLERANCES = (0, 0.5, 2)  # times the smallest spacing, or 2 % of the range of values
RAW_TYPES = {"uint8": "UnsignedChar", "uint16": "UnsignedShort", "int16": "Short", "float32": "Float"}


def made_volume(array):
    """Bumps and some noise, without any function whose last bit depends on a library."""
    for z, y, x in itertools.product(*(range(size) for size in reversed(SIZE))):
        squares = (x - 20) ** 2 + (y - 17) ** 2 + (z - 22) ** 2
        array.InsertNextValue(squares + (x * y * z) % 97 + 40 * ((x // 7 + y // 5 + z // 6) % 3))
    array.SetName("values")
    image = vtkImageData()
    image.SetDimensions(SIZE)
    image.SetSpacing(SPACING)
    image.GetPointData().SetScalars(array)
    return image


def read_volume(path):
    raw = re.search(r"_(\d+)x(\d+)x(\d+)_(\w+)\.raw$", path)
    if raw:
        reader = vtkImageReader2()
        reader.SetFileDimensionality(3)
        reader.SetDataExtent(*(n for size in raw.groups()[:3] for n in (0, int(size) - 1)))
        getattr(reader, "SetDataScalarTypeTo" + RAW_TYPES[raw.group(4)])()
        reader.SetDataByteOrderToLittleEndian()
    else:
        reader = vtkNIFTIImageReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def hash_of(arrays):
    total = hashlib.sha256()
    for array in arrays:
        if array and array.GetNumberOfValues() > 0:
            total.update((array.GetName() or "").encode())
            total.update(memoryview(array))
    return total.hexdigest()[:12]


def hash_of_hierarchy(hierarchy):
    data = hierarchy.GetFieldData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return hash_of(sorted(filter(None, arrays), key=lambda array: array.GetName()))


def hash_of_mesh(mesh):
    cells = mesh.GetCells() if hasattr(mesh, "GetCells") else mesh.GetPolys()
    arrays = [mesh.GetPoints().GetData(), cells.GetOffsetsArray(), cells.GetConnectivityArray()]
    for data in (mesh.GetPointData(), mesh.GetCellData()):
        arrays += [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return hash_of(arrays)


def print_hashes(name, image, isovalue):
    spacing = min(image.GetSpacing())
    low, high = image.GetScalarRange()
    bounds = image.GetBounds()
    for shape, model, metric in itertools.product(
        ("Isosurface", "IntervalVolume"),
        ("HierarchyOfDiamonds", "Relevant", "Minimal"),
        ("Field", "Distance"),
    ):
        if model == "HierarchyOfDiamonds" and metric == "Distance":
            continue
        builder = vtkIsodiamondBuilder()
        builder.SetInputData(image)
        getattr(builder, "SetShapeTo" + shape)()
        getattr(builder, "SetModelTo" + model)()
        getattr(builder, "SetErrorMetricTo" + metric)()
        builder.SetIsovalue(isovalue)
        builder.SetIsorange(isovalue, math.inf)
        if model == "Minimal":
            builder.ComputeNormalsOn()
        builder.Update()
        hashes = [hash_of_hierarchy(builder.GetOutput())]
        unit = spacing if metric == "Distance" else 0.02 * (high - low)
        extractor = vtkIsodiamondExtractor()
        extractor.SetInputConnection(builder.GetOutputPort())
        if model == "HierarchyOfDiamonds":
            getattr(extractor, "SetShapeTo" + shape)()
            if shape == "Isosurface":
                extractor.SetIsovalue(isovalue)
            else:
                extractor.SetIsorange(isovalue, math.inf)
        extractor.SetRegionOfInterest(
            *(bounds[2 * axis] + (bounds[2 * axis + 1] - bounds[2 * axis]) * part
              for axis in range(3) for part in (0.3, 0.6))
        )
        for tolerance in TOLERANCES:
            extractor.SetErrorTolerance(tolerance * unit)
            extractor.Update()
            hashes.append(hash_of_mesh(extractor.GetOutput()))
        extractor.SetErrorTolerance(0)
        extractor.UseRegionOfInterestOn()
        extractor.Update()
        hashes.append(hash_of_mesh(extractor.GetOutput()))
        print(f"{name} {shape} {model} {metric}:", *hashes, flush=True)


def main():
    print_hashes("made, 16 bits", made_volume(vtkShortArray()), 500)
    print_hashes("made, floats", made_volume(vtkFloatArray()), 500.3)
    head, _ = HEAD.rsplit(":", 1)
    for argument in sys.argv[1:] or ([HEAD] if os.path.exists(head) else []):
        path, isovalue = argument.rsplit(":", 1)
        print_hashes(os.path.basename(path), read_volume(path), float(isovalue))


main()
