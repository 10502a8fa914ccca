# SPDX-License-Identifier: BSD-3-Clause
"""The ways to fewer triangles that deviation.py compares, on one volume. One thread each."""
import ctypes
import statistics
import sys
import time

import numpy
from isodiamonds import vtkIsodiamondContour
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkQuadricDecimation

RUNS = 5
TOPOLOGIES = {None: "distance", 0: "distance, any topology", 1: "distance, topology preserved"}


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
    if isinstance(contour, vtkIsodiamondContour):
        contour.SetErrorTolerance(sys.float_info.min)  # at 0 no errors are measured
    return timed(contour)


def extract(contour, tolerance):
    """Mesh and milliseconds, as all methods return them."""
    contour.SetErrorTolerance(tolerance)
    milliseconds = statistics.median(timed(contour) for _ in range(RUNS))
    mesh = vtkPolyData()
    mesh.ShallowCopy(contour.GetOutput())  # the filter goes on to other tolerances
    return mesh, milliseconds


def matching_tolerance(contour, triangles):
    """The largest tolerance that leaves at least so many triangles."""
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


def mesh_of(points, ids):
    """A mesh of triangles, each of three successive ids."""
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(ids.astype(numpy.int64), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    return mesh


def simplify(meshopt_simplify, surface, triangles):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(numpy.float32)
    ids = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).astype(numpy.uint32)
    result = numpy.empty_like(ids)
    source = (ids.ctypes.data, ids.size, points.ctypes.data, len(points), points.strides[0])
    goal = (3 * triangles, 1e10, 0, None)  # whatever the error, no options
    start = time.perf_counter()
    count = meshopt_simplify(result.ctypes.data, *source, *goal)
    milliseconds = 1000 * (time.perf_counter() - start)
    return mesh_of(surface.GetPoints(), result[:count]), milliseconds


def load_openvdb():
    try:
        import pyopenvdb
    except ImportError:
        print("No OpenVDB: it is in Debian's package python3-openvdb\n")
        return None
    return pyopenvdb


class OpenVDB:
    """Its adaptive mesher, volumeToMesh, which starts from the volume."""

    def __init__(self, module, image, isovalue):
        values = vtk_to_numpy(image.GetPointData().GetScalars()).astype(numpy.float32)
        # Values outside are less than all inside: the surface is closed at the boundary.
        self.grid = module.FloatGrid(float(values.min()) - 1)
        values = values.reshape(image.GetDimensions(), order="F")
        self.grid.copyFromArray(numpy.ascontiguousarray(values))
        self.isovalue = isovalue
        self.origin = numpy.array(image.GetOrigin())
        self.spacing = numpy.array(image.GetSpacing())

    def mesh(self, adaptivity):
        """Points, triangles, and milliseconds."""
        start = time.perf_counter()
        points, triangles, quads = self.grid.convertToPolygons(self.isovalue, adaptivity)
        milliseconds = 1000 * (time.perf_counter() - start)
        halves = [quads[:, (0, 1, 2)], quads[:, (0, 2, 3)]] if len(quads) else []
        both = numpy.concatenate([part for part in (triangles, *halves) if len(part)])
        return points, both, milliseconds

    def with_triangles(self, most):
        """The mesh of the least adaptivity that leaves no more triangles, and milliseconds; None if
        all leave more."""
        low, high = 0.0, 1.0
        if len(self.mesh(high)[1]) > most:
            return None
        for _ in range(16):
            middle = (low + high) / 2
            low, high = (low, middle) if len(self.mesh(middle)[1]) <= most else (middle, high)
        points, triangles, milliseconds = self.mesh(high)
        placed = vtkPoints()
        placed.SetData(numpy_to_vtk(self.origin + self.spacing * points, deep=True))
        return mesh_of(placed, triangles[:, ::-1].ravel()), milliseconds  # faces outward


def isodiamonds(topology, by_field=False):
    """A contour that preserves the topology of full resolution, or not; None for its default."""
    contour = vtkIsodiamondContour()
    contour.SetNumberOfThreads(1)
    if by_field:
        contour.SetErrorMetricToField()
    if topology is not None:
        contour.SetPreserveTopology(topology)
    return contour


class Contest:
    """The methods on one volume. The first sets the number of triangles that "field" and those of
    others have to match.

    topologies are values of PreserveTopology, each for a mesh of the distance metric, or None to
    leave it as it is. If simplifies is true, a simplified mesh comes first. Surfaces of more
    triangles than the limit are not decimated.
    """

    def __init__(self, image, isovalue, topologies, limit, simplifies=False):
        self.voxel = min(image.GetSpacing())
        self.limit = limit
        contour = vtkFlyingEdges3D()
        self.their_milliseconds = first_run(contour, image, isovalue)
        self.theirs = contour.GetOutput()
        self.by_distance = [isodiamonds(topology) for topology in topologies]
        self.ours = [*(TOPOLOGIES[topology] for topology in topologies), "field"]
        if simplifies:
            self.by_distance.insert(0, isodiamonds(topologies[0]))
            self.by_distance[0].SimplifyOn()
            self.ours.insert(0, "Simplify")
        self.by_field = isodiamonds(topologies[0], by_field=True)
        contours = (*self.by_distance, self.by_field)
        runs = [first_run(c, image, isovalue) for c in contours]
        fulls = [extract(c, 0) for c in contours]
        self.full, self.milliseconds = fulls[0]
        self.builds = [run - full[1] for run, full in zip(runs, fulls)]
        self.methods = (*self.ours, "vtkQuadricDecimation", "meshopt_simplify", "OpenVDB")
        self.meshopt_simplify = load_meshoptimizer()
        openvdb = load_openvdb()
        self.openvdb = openvdb and OpenVDB(openvdb, image, isovalue)

    def level(self, tolerance):
        """Mesh and milliseconds of each method at a tolerance in voxels; None if it was not run."""
        by_distance = [extract(c, tolerance * self.voxel) for c in self.by_distance]
        triangles = by_distance[0][0].GetNumberOfCells()
        by_field = extract(self.by_field, matching_tolerance(self.by_field, triangles))
        theirs = self.theirs.GetNumberOfCells()
        quadric = triangles < theirs <= self.limit and decimate(self.theirs, triangles)
        meshopt = self.meshopt_simplify if triangles < theirs else None
        meshopt = meshopt and simplify(meshopt, self.theirs, triangles)
        adaptive = self.openvdb and self.openvdb.with_triangles(triangles)
        return [*by_distance, by_field, quadric or None, meshopt, adaptive]
