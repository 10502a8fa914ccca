# SPDX-License-Identifier: BSD-3-Clause
"""What deviation.py measures of triangle meshes: deviations, angles, topology; lengths in voxels.

Distances from points to triangles are exact. To sample a mesh, its triangles are cut into equal
parts; samples are the parts' centres, those of neighbours at most half a voxel apart. Each centre
stands for the area of its part.

Needs scipy, Debian's python3-scipy; to count intersections, IsodiamondCGALIntersections, which is
built if CGAL is found (Debian's libcgal-dev).
"""
import collections
import concurrent.futures
import functools
import os
import subprocess
import tempfile

import numpy
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkGenericCell, vtkPolyData
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator

# The longest edge of a part: centres on both sides of an edge are 2/3 of a median apart, and no
# median is longer than the longest edge.
PART = 0.75
MEAN_SAMPLES = 1_000_000  # if a mesh has more, means are over about so many, drawn at random
EQUALLY_NEAR = 1e-6  # distances that differ by no more count as equal
SLIVER = 10  # degrees
FIRST_CANDIDATES = 24
BATCH = 1 << 16  # points

Deviation = collections.namedtuple("Deviation", "rms maximum")
Topology = collections.namedtuple("Topology", "pieces euler loops branching")


class Mesh:
    """Triangles as arrays. Points at the same place are merged; triangles with fewer than three
    points are left out, as are points without triangles."""

    def __init__(self, points, triangles):
        order = numpy.lexsort(points.T)
        new = numpy.any(numpy.diff(points[order], axis=0) != 0, axis=1)
        merged = numpy.empty(len(points), dtype=numpy.int64)
        merged[order] = numpy.concatenate(([0], numpy.cumsum(new)))
        first = order[numpy.concatenate(([True], new))]
        triangles = merged[triangles]
        a, b, c = triangles.T
        triangles = triangles[(a != b) & (b != c) & (c != a)]
        used, triangles = numpy.unique(triangles, return_inverse=True)
        self.points = points[first[used]]
        self.triangles = triangles.reshape(-1, 3)
        self.corners = self.points[self.triangles]
        a, b, c = self.corners.transpose(1, 0, 2)
        normals = numpy.cross(b - a, c - a)
        lengths = numpy.linalg.norm(normals, axis=1)
        self.areas = lengths / 2
        self.normals = normals / numpy.where(lengths > 0, lengths, 1)[:, None]

    @classmethod
    def of(cls, polydata, voxel):
        """The mesh of a vtkPolyData of triangles."""
        points = vtk_to_numpy(polydata.GetPoints().GetData()).astype(float) / voxel
        return cls(points, vtk_to_numpy(polydata.GetPolys().GetConnectivityArray()).reshape(-1, 3))

    def polydata(self):
        points, cells, polydata = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(self.points, deep=True))
        ids = self.triangles.ravel().astype(numpy.int64)
        cells.SetData(3, numpy_to_vtkIdTypeArray(ids, deep=True))
        polydata.SetPoints(points)
        polydata.SetPolys(cells)
        return polydata

    @functools.cached_property
    def parts(self):
        """The parts of all triangles: the number of each part's triangle, centres, areas."""
        edges = numpy.linalg.norm(self.corners - numpy.roll(self.corners, 1, axis=1), axis=2)
        cuts = numpy.ceil(edges.max(axis=1) / PART).astype(int)
        owners, centers = [], []
        for n in numpy.unique(cuts):
            some = numpy.flatnonzero(cuts == n)
            owners.append(numpy.repeat(some, n * n))
            centers.append((centers_of_parts(n) @ self.corners[some]).reshape(-1, 3))
        owners = numpy.concatenate(owners)
        return owners, numpy.concatenate(centers), (self.areas / cuts**2)[owners]


def centers_of_parts(n):
    """Barycentric coordinates of the parts' centres if each edge of a triangle is cut into n."""
    i, j = numpy.indices((n, n)).reshape(2, -1)
    upright, inverted = i + j < n, i + j < n - 1
    second = numpy.concatenate((i[upright] + 1 / 3, i[inverted] + 2 / 3)) / n
    third = numpy.concatenate((j[upright] + 1 / 3, j[inverted] + 2 / 3)) / n
    return numpy.column_stack((1 - second - third, second, third))


def dot(a, b):
    return numpy.einsum("ij,ij->i", a, b)


class NearestTriangle:
    """Finds the triangle of a mesh that is nearest to a point.

    Candidates come from a k-d tree of the parts' centres. All other triangles are no nearer than
    the last candidate's centre less the largest radius of a part: the tree is asked for more until
    that is beyond the nearest triangle.
    """

    def __init__(self, mesh):
        self.mesh = mesh
        self.owners, centers, _ = mesh.parts
        self.tree = cKDTree(centers, balanced_tree=False)
        cuts = numpy.sqrt(numpy.bincount(self.owners, minlength=len(mesh.triangles)))
        # A part is its triangle, reduced by the number of cuts.
        spokes = mesh.corners - mesh.corners.mean(axis=1, keepdims=True)
        self.radii = numpy.linalg.norm(spokes, axis=2).max(axis=1) / cuts
        a, b, c = mesh.corners.transpose(1, 0, 2)
        u, v = b - a, c - a
        self.rows = numpy.column_stack((a, u, v, dot(u, u), dot(u, v), dot(v, v)))

    def find(self, points, directions=None):
        """Distances, and the nearest triangles; of equally near ones, as on both sides of an edge,
        the one with the smallest angle between its normal and the point's direction."""
        if directions is None:
            directions = numpy.zeros_like(points)
        distances, nearest = numpy.empty(len(points)), numpy.empty(len(points), dtype=int)

        def find_batch(start):
            batch = slice(start, start + BATCH)
            found = self._find_batch(points[batch], directions[batch])
            distances[batch], nearest[batch] = found

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(find_batch, range(0, len(points), BATCH)))
        return distances, nearest

    def largest_distance(self, points, known=0.0):
        """The largest distance of points, or a known one if that is larger. The nearest triangle
        is searched only for points farther than that from the triangle with the nearest centre."""
        bounds = numpy.empty(len(points))
        for start in range(0, len(points), BATCH):
            batch = slice(start, start + BATCH)
            parts = self.tree.query(points[batch], workers=-1)[1]
            bounds[batch] = self._distances(points[batch], self.owners[parts])
        order = numpy.argsort(-bounds)
        start, end = 0, 1000
        while start < len(order) and bounds[order[start]] > known:
            known = max(known, self.find(points[order[start:end]])[0].max())
            start, end = end, 2 * end
        return known

    def check(self, points, found):
        """Checks the 1000 largest distances and 1000 others against VTK's locator."""
        some = numpy.linspace(0, len(found) - 1, 1000).astype(int)
        cell, squared = vtkGenericCell(), reference(0.0)
        cell_id, sub_id = reference(0), reference(0)
        for i in (*numpy.argsort(found)[-1000:], *some):
            closest = [0, 0, 0]
            self._locator.FindClosestPoint(points[i], closest, cell, cell_id, sub_id, squared)
            assert abs(found[i] - squared.get() ** 0.5) < 2 * EQUALLY_NEAR, (i, found[i])

    @functools.cached_property
    def _locator(self):
        locator = vtkStaticCellLocator()
        locator.SetDataSet(self.mesh.polydata())
        locator.BuildLocator()
        return locator

    def _find_batch(self, points, directions):
        distances, cosines = numpy.full(len(points), numpy.inf), numpy.full(len(points), -2.0)
        nearest = numpy.zeros(len(points), dtype=int)
        largest_radius = self.radii.max()
        left, first, last = numpy.arange(len(points)), 0, min(FIRST_CANDIDATES, len(self.owners))
        while left.size:
            beyond = []
            # Points far away have many candidates, and are taken in smaller groups.
            for some in numpy.array_split(left, 1 + left.size * last // (FIRST_CANDIDATES * BATCH)):
                order = numpy.arange(first + 1, last + 1)
                reach, parts = self.tree.query(points[some], k=order)
                triangles = self.owners[parts]
                bounds = reach - self.radii[triangles]
                for bound, triangle in zip(bounds.T, triangles.T):
                    near = bound <= distances[some] + EQUALLY_NEAR
                    ids, candidates = some[near], triangle[near]
                    found = self._distances(points[ids], candidates)
                    cosine = dot(directions[ids], self.mesh.normals[candidates])
                    change = found - distances[ids]
                    better = change < -EQUALLY_NEAR
                    better |= (change <= EQUALLY_NEAR) & (cosine > cosines[ids])
                    ids = ids[better]
                    distances[ids], cosines[ids] = found[better], cosine[better]
                    nearest[ids] = candidates[better]
                beyond.append(distances[some] + EQUALLY_NEAR < reach[:, -1] - largest_radius)
            if last == len(self.owners):
                break
            left = left[~numpy.concatenate(beyond)]
            first, last = last, min(2 * last, len(self.owners))
        return distances, nearest

    def _distances(self, points, triangles):
        """Of each point from one triangle: from its plane or, if beside it, from an edge."""
        rows = self.rows[triangles]
        w = points - rows[:, :3]
        uw, vw, ww = dot(rows[:, 3:6], w), dot(rows[:, 6:9], w), dot(w, w)
        uu, uv, vv = rows[:, 9:].T

        def squared(s, t):  # from the point a + s u + t v
            return ww + s * (s * uu + 2 * t * uv - 2 * uw) + t * (t * vv - 2 * vw)

        on_u = (uw / uu).clip(0, 1)
        on_v = (vw / vv).clip(0, 1)
        between = ((vw - uw - uv + uu) / (uu - 2 * uv + vv)).clip(0, 1)
        best = numpy.minimum(squared(on_u, 0), squared(0, on_v))
        best = numpy.minimum(best, squared(1 - between, between))
        with numpy.errstate(divide="ignore", invalid="ignore"):  # no area: nothing is inside
            determinant = uu * vv - uv * uv
            s, t = (vv * uw - uv * vw) / determinant, (uu * vw - uv * uw) / determinant
            inside = (s >= 0) & (t >= 0) & (s + t <= 1)
            best = numpy.where(inside, squared(s, t), best)
        return numpy.sqrt(best.clip(0))


def deviation_of_points(points, mesh):
    """The deviation of points from a mesh, and the distances."""
    nearest = NearestTriangle(mesh)
    found, _ = nearest.find(points)
    nearest.check(points, found)
    return Deviation((found**2).mean() ** 0.5, found.max()), found


def deviation_of_mesh(mesh, nearest):
    """The deviation of a mesh from the triangles that are searched; of the angles between its
    normals and those of the nearest triangles, the mean, in degrees, and the share of the area with
    more than 90."""
    owners, centers, areas = mesh.parts
    some = slice(None)
    if len(owners) > MEAN_SAMPLES:
        chance = numpy.random.default_rng(1).random(len(owners))
        some = numpy.flatnonzero(chance < MEAN_SAMPLES / len(owners))
    normals, samples, areas = mesh.normals[owners[some]], centers[some], areas[some]
    found, triangles = nearest.find(samples, normals)
    nearest.check(samples, found)
    rms = numpy.average(found**2, weights=areas) ** 0.5
    maximum = nearest.largest_distance(mesh.points, found.max())
    maximum = nearest.largest_distance(centers, maximum)
    cosines = dot(normals, nearest.mesh.normals[triangles])
    angles = numpy.degrees(numpy.arccos(cosines.clip(-1, 1)))
    angle, folded = (numpy.average(x, weights=areas) for x in (angles, angles > 90))
    return Deviation(rms, maximum), angle, folded


def slivers(mesh):
    """The share of triangles with an angle below 10 degrees."""
    smallest = numpy.full(len(mesh.triangles), 180.0)
    for i in range(3):
        a, b, c = (mesh.corners[:, (i + k) % 3] for k in range(3))
        angles = numpy.degrees(numpy.arctan2(2 * mesh.areas, dot(b - a, c - a)))
        smallest = numpy.minimum(smallest, angles)
    return (smallest < SLIVER).mean()


def intersections(mesh, program):
    """How many pairs of triangles have more in common than corners and an edge, by CGAL's exact
    predicates. None if the program that counts them is not there."""
    if not os.path.exists(program):
        return None
    with tempfile.NamedTemporaryFile() as file:
        numpy.array([len(mesh.points), len(mesh.triangles)], dtype=numpy.int64).tofile(file)
        mesh.points.astype(numpy.float64).tofile(file)
        mesh.triangles.astype(numpy.int64).tofile(file)
        file.flush()
        command = [program, file.name]
        return int(subprocess.run(command, check=True, capture_output=True).stdout)


def count_pieces(first, second):
    """The pieces of a graph that is given by its edges; all nodes have one."""
    nodes, ids = numpy.unique(numpy.concatenate((first, second)), return_inverse=True)
    first, second = ids.reshape(2, -1)
    graph = coo_matrix((numpy.ones(len(first), bool), (first, second)), (len(nodes), len(nodes)))
    return connected_components(graph, directed=False)[0]


def topology(mesh):
    """Pieces, each connected by points; Euler number, points - edges + triangles; loops, the
    connected sets of edges with one triangle; the number of edges with more than two."""
    a, b, c = mesh.triangles.T
    ends = numpy.sort(numpy.concatenate(((a, b), (b, c), (c, a)), axis=1), axis=0)
    keys, triangles = numpy.unique(ends[0] * len(mesh.points) + ends[1], return_counts=True)
    first, second = numpy.divmod(keys, len(mesh.points))
    return Topology(
        count_pieces(first, second),
        len(mesh.points) - len(keys) + len(mesh.triangles),
        count_pieces(first[triangles == 1], second[triangles == 1]),
        numpy.count_nonzero(triangles > 2),
    )
