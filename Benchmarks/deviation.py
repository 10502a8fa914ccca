# SPDX-License-Identifier: BSD-3-Clause
"""How far simplified isosurfaces are from full resolution, at the same number of triangles.

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/deviation.py [OPTIONS] [RAW ...]

RAW is NAME_XxYxZ_uint8.raw:ISOVALUE; the other volumes are a phantom made here and, where Debian's
mricron-data is installed, an MRI head. A deviation is the distance of a vertex of the
full-resolution surface from the simplified mesh: Isodiamonds' own surface at tolerance 0 for its
two metrics, that of vtkFlyingEdges3D for vtkQuadricDecimation and meshopt_simplify, which start
from it. The distance metric's mesh sets the number of triangles for the others; "-" is what was not
run, as where vtkFlyingEdges3D's surface has no more triangles than that. One thread each.
"""
import argparse
import collections
import ctypes
import math
import os
import re
import statistics
import time

import numpy
from isodiamonds import vtkIsodiamondContour
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkGenericCell, vtkImageData, vtkPolyData
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkQuadricDecimation
from vtkmodules.vtkFiltersGeneral import vtkDistancePolyDataFilter
from vtkmodules.vtkIOImage import vtkNIFTIImageReader

HEAD = "/usr/share/mricron/templates/ch2.nii.gz"
HEAD_ISOVALUE = 40.5  # between air and skin
TOLERANCES = (2, 1, 0.5, 0.25, 0.1)  # voxels
METHODS = ("distance", "field", "vtkQuadricDecimation", "meshopt_simplify")
RUNS = 5
DECIMATION_LIMIT = 1_000_000  # triangles

Result = collections.namedtuple("Result", "triangles deviations beyond milliseconds")


def image_of(field):
    image = vtkImageData()
    image.SetDimensions(field.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(field.ravel(), deep=True))
    return image


def phantom(size):
    """CT of a tilted block with bores, a slot and fins: 100 in 0, edges blurred over two voxels."""
    axis = (numpy.arange(size) - (size - 1) / 2) / size
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    sin, cos = numpy.sin(0.2), numpy.cos(0.2)
    x, y = cos * x - sin * y, sin * x + cos * y
    y, z = cos * y - sin * z, sin * y + cos * z

    def box(half_x, half_y, half_z, center_y=0.0, center_z=0.0):
        """Positive inside."""
        across = numpy.minimum(half_y - abs(y - center_y), half_z - abs(z - center_z))
        return numpy.minimum(half_x - abs(x), across)

    inside = box(0.36, 0.16, 0.26)
    for level in (-0.2, -0.12, -0.04, 0.04, 0.12, 0.2):
        inside = numpy.maximum(inside, box(0.36, 0.24, 0.012, center_z=level))
    for center in (-0.22, 0, 0.22):  # with walls of 0.02 between
        inside = numpy.minimum(inside, numpy.hypot(x - center, y) - 0.1)
    inside = numpy.minimum(inside, numpy.hypot(y, z) - 0.03)
    inside = numpy.minimum(inside, -box(0.3, 0.02, 0.06, center_y=0.13, center_z=0.26))
    noise = numpy.random.default_rng(1).standard_normal(inside.shape)
    logistic = 50 + 50 * numpy.tanh(inside * size / 0.9)
    return image_of((logistic + 2 * noise).astype(numpy.float32))


def head():
    reader = vtkNIFTIImageReader()
    reader.SetFileName(HEAD)
    reader.Update()
    return reader.GetOutput()


def raw_volume(argument):
    """Name, image and isovalue."""
    path, isovalue = argument.rsplit(":", 1)
    match = re.fullmatch(r"(?:.*/)?(.+)_(\d+)x(\d+)x(\d+)_uint8\.raw", path)
    if not match:
        raise ValueError("another kind of name")
    name, *shape = match.groups()
    field = numpy.fromfile(path, dtype=numpy.uint8)
    return name, image_of(field.reshape([int(n) for n in reversed(shape)])), float(isovalue)


def timed(algorithm):
    algorithm.Modified()
    start = time.perf_counter()
    algorithm.Update()
    return 1000 * (time.perf_counter() - start)


def first_run(contour, image, isovalue):
    contour.SetInputData(image)
    contour.SetValue(0, isovalue)
    contour.ComputeNormalsOff()
    contour.ComputeScalarsOff()
    return timed(contour)


def extract(contour, tolerance):
    """Mesh and milliseconds, as all methods return them."""
    contour.SetErrorTolerance(tolerance)
    milliseconds = statistics.median(timed(contour) for _ in range(RUNS))
    mesh = vtkPolyData()
    mesh.ShallowCopy(contour.GetOutput())  # the filter goes on to other tolerances
    return mesh, milliseconds


def matching_tolerance(contour, triangles):
    """The largest that leaves at least so many triangles."""
    low, high = 0.0, contour.GetErrorToleranceRange()[1]
    for _ in range(40):
        middle = (low + high) / 2
        contour.SetErrorTolerance(middle)
        contour.Update()
        enough = contour.GetOutput().GetNumberOfCells() >= triangles
        low, high = (middle, high) if enough else (low, middle)
    return low


def decimate(surface, triangles):
    decimation = vtkQuadricDecimation()
    decimation.SetInputData(surface)
    decimation.SetTargetReduction(1 - triangles / surface.GetNumberOfCells())
    decimation.VolumePreservationOff()
    decimation.AttributeErrorMetricOff()
    milliseconds = timed(decimation)
    return decimation.GetOutput(), milliseconds


def load_meshoptimizer():
    try:
        function = ctypes.CDLL("libmeshoptimizer.so").meshopt_simplify
    except OSError:
        print("No meshopt_simplify: it is in Debian's package libmeshoptimizer-dev\n")
        return None
    size, pointer = ctypes.c_size_t, ctypes.c_void_p
    function.restype = size
    function.argtypes = [pointer, pointer, size, pointer, size, size, size]
    function.argtypes += [ctypes.c_float, ctypes.c_uint, pointer]
    return function


def simplify(meshopt_simplify, surface, triangles):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(numpy.float32)
    ids = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).astype(numpy.uint32)
    result = numpy.empty_like(ids)
    source = (ids.ctypes.data, ids.size, points.ctypes.data, len(points), points.strides[0])
    goal = (3 * triangles, 1e10, 0, None)  # whatever the error, no options
    start = time.perf_counter()
    count = meshopt_simplify(result.ctypes.data, *source, *goal)
    milliseconds = 1000 * (time.perf_counter() - start)
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(result[:count].astype(numpy.int64), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(surface.GetPoints())
    mesh.SetPolys(cells)
    return mesh, milliseconds


def distances(surface, mesh):
    """Of all vertices of a surface from a mesh."""
    measure = vtkDistancePolyDataFilter()
    measure.SetInputData(0, surface)
    measure.SetInputData(1, mesh)
    measure.SignedDistanceOff()
    measure.ComputeSecondDistanceOff()
    measure.ComputeCellCenterDistanceOff()
    measure.Update()
    return vtk_to_numpy(measure.GetOutput().GetPointData().GetArray("Distance"))


def check(surface, mesh, found):
    """The 1000 largest distances and 1000 others, against another locator."""
    locator = vtkStaticCellLocator()
    locator.SetDataSet(mesh)
    locator.BuildLocator()
    some = numpy.linspace(0, len(found) - 1, 1000).astype(int)
    cell, cell_id, sub_id, squared = vtkGenericCell(), reference(0), reference(0), reference(0.0)
    for i in (*numpy.argsort(found)[-1000:], *some):
        point = surface.GetPoint(i)
        locator.FindClosestPoint(point, [0, 0, 0], cell, cell_id, sub_id, squared)
        assert abs(found[i] - squared.get() ** 0.5) < 1e-9 * surface.GetLength(), (i, found[i])


def assess(surface, mesh, milliseconds, tolerance, voxel):
    found = distances(surface, mesh)
    check(surface, mesh, found)
    deviations = [d / voxel for d in (found.mean(), (found**2).mean() ** 0.5, found.max())]
    beyond = numpy.count_nonzero(found > tolerance)
    return Result(mesh.GetNumberOfCells(), deviations, beyond, milliseconds)


def print_table(title, columns, rows):
    print(f"{title}:\n\n| tolerance | {' | '.join(columns)} |\n{'|---' * (len(columns) + 1)}|")
    for tolerance, row in zip(TOLERANCES, rows):
        print(f"| {tolerance} | {' | '.join(row)} |")
    print(flush=True)


def print_tables(results, builds):
    def cells(text):
        return [[text(result) if result else "-" for result in row] for row in results]

    triangles = cells(lambda r: f"{r.triangles:,}")
    deviations = cells(lambda r: " / ".join(f"{d:.3f}" for d in r.deviations))
    rows = [[t[0], *d] for t, d in zip(triangles, deviations)]
    print_table("Deviation in voxels, mean / rms / max", ("triangles", *METHODS), rows)
    print_table("Triangles", METHODS, triangles)
    print_table("Vertices beyond the tolerance", METHODS, cells(lambda r: f"{r.beyond:,}"))
    rows = []
    for ours, *others in results:
        unit = ours.milliseconds
        ratios = [f"{r.milliseconds / unit:.2f}" if r else "-" for r in others]
        rows.append([f"{unit:.1f}", *(f"{build / unit:.1f}" for build in builds), *ratios])
    columns = ("distance, ms", "its build", "field's build", *METHODS[1:])
    print_table("Time, in ratios to extraction by distance", columns, rows)


def print_surface(name, surface, milliseconds):
    triangles, points = surface.GetNumberOfCells(), surface.GetNumberOfPoints()
    print(f"- {name}: {triangles:,} triangles, {points:,} points, {milliseconds:.1f} ms")


def compare(name, image, isovalue, meshopt_simplify, limit):
    size = " x ".join(map(str, image.GetDimensions()))
    print(f"## {name}, {size}, isovalue {isovalue:g}\n\nFull resolution:\n")
    contour, by_distance, by_field = vtkFlyingEdges3D(), *(vtkIsodiamondContour() for _ in range(2))
    by_field.SetErrorMetricToField()
    for ours in (by_distance, by_field):
        ours.SetNumberOfThreads(1)
    runs = [first_run(c, image, isovalue) for c in (contour, by_distance, by_field)]
    theirs = contour.GetOutput()
    print_surface("vtkFlyingEdges3D", theirs, runs[0])
    full, milliseconds = extract(by_distance, 0)
    print_surface("Isodiamonds", full, milliseconds)
    builds = (runs[1] - milliseconds, runs[2] - extract(by_field, 0)[1])
    print("- builds by distance and by field: {:.0f} and {:.0f} ms\n".format(*builds), flush=True)

    voxel = min(image.GetSpacing())
    results = []
    for tolerance in TOLERANCES:
        ours = extract(by_distance, tolerance * voxel)
        triangles = ours[0].GetNumberOfCells()
        fewer = triangles < theirs.GetNumberOfCells()
        quadric = fewer and theirs.GetNumberOfCells() <= limit
        runs = (
            (full, ours),
            (full, extract(by_field, matching_tolerance(by_field, triangles))),
            (theirs, quadric and decimate(theirs, triangles)),
            (theirs, fewer and meshopt_simplify and simplify(meshopt_simplify, theirs, triangles)),
        )
        results.append([run and assess(s, *run, tolerance * voxel, voxel) for s, run in runs])
    print_tables(results, builds)


def main():
    parser = argparse.ArgumentParser(prog="deviation.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--size", type=int, default=128, help="of the phantom, in samples")
    parser.add_argument("--all", action="store_true", help="decimate large surfaces too (slow)")
    parser.add_argument("raw", nargs="*", type=raw_volume, help="NAME_XxYxZ_uint8.raw:ISOVALUE")
    arguments = parser.parse_args()
    volumes = [("CT phantom", phantom(arguments.size), 50)]
    if os.path.exists(HEAD):
        volumes.append(("MRI head", head(), HEAD_ISOVALUE))
    meshopt_simplify = load_meshoptimizer()
    for volume in volumes + arguments.raw:
        compare(*volume, meshopt_simplify, math.inf if arguments.all else DECIMATION_LIMIT)


main()
