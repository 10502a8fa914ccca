# SPDX-License-Identifier: BSD-3-Clause
"""The measures of deviation.py on shapes whose figures are known.

    pvpython test_meshmeasures.py [IsodiamondCGALIntersections]

Exits with 77 without scipy.
"""
import sys

import numpy

try:
    import meshmeasures
    from meshmeasures import Mesh, NearestTriangle, Topology, deviation_of_mesh
    from meshmeasures import deviation_of_points, intersections, slivers, topology
except ModuleNotFoundError as error:
    print(error)
    sys.exit(77)

SQUARE = numpy.array([[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]])


def mesh_of(*corners):
    """A mesh of triangles that share no points, like those of an STL file."""
    corners = numpy.concatenate(corners).astype(float)
    return Mesh(corners.reshape(-1, 3), numpy.arange(3 * len(corners)).reshape(-1, 3))


def cube(side):
    """Triangles, anticlockwise as seen from outside."""
    faces = []
    for axis in range(3):
        face = numpy.roll(side * SQUARE, axis, axis=2)  # its normal is along axis - 1
        away = numpy.roll([0, 0, side], axis)
        faces += [face + away, face[:, ::-1]]
    return numpy.concatenate(faces)


def near(found, expected, relative=1e-9):
    assert numpy.allclose(found, expected, relative, 1e-7), (found, expected)


def test_topology():
    near(mesh_of(cube(4)).areas.sum(), 96)
    assert len(mesh_of(cube(4)).points) == 8
    assert topology(mesh_of(cube(4))) == Topology(1, 2, 0, 0)
    assert topology(mesh_of(cube(4)[1:])) == Topology(1, 1, 1, 0)
    assert topology(mesh_of(cube(4), cube(4) + [9, 0, 0])) == Topology(2, 4, 0, 0)
    # 14 points, 35 edges, 24 triangles.
    assert topology(mesh_of(cube(4), cube(4) + [4, 4, 0])) == Topology(1, 3, 0, 1)
    fins = [[(0, 0, 0), (0, 0, 1), (x, y, 0)] for x, y in ((1, 0), (0, 1), (-1, 0))]
    assert topology(mesh_of(fins)) == Topology(1, 1, 1, 1)
    # Without two opposite faces: a tube.
    tube = [t for t in cube(4) if numpy.ptp(t[:, 2])]
    assert topology(mesh_of(tube)) == Topology(1, 0, 2, 0)
    # A triangle with two corners at one place does not count.
    assert len(mesh_of(SQUARE, [[(0, 0, 0), (0, 0, 0), (1, 0, 0)]]).triangles) == 2


def test_slivers():
    flat = [[(0, 0, 0), (10, 0, 0), (5, 0.5, 0)]]  # 5.7 degrees
    less_flat = [[(0, 0, 0), (10, 0, 0), (5, 1, 0)]]  # 11.3
    near(slivers(mesh_of(SQUARE, less_flat)), 0)
    near(slivers(mesh_of(SQUARE, flat)), 1 / 3)


def test_intersections():
    program = sys.argv[1] if len(sys.argv) > 1 else ""
    if not program:
        print("not built: IsodiamondCGALIntersections")
        return
    assert intersections(mesh_of(cube(4)), program) == 0
    assert intersections(mesh_of(cube(4), cube(4) + [9, 0, 0]), program) == 0
    # Through both triangles of a square; with a corner in the middle, on their edge; beside them.
    through = numpy.array([[(0.3, 0.2, -1), (0.6, 0.7, 1), (0.7, 0.6, 1)]])
    touching = numpy.array([[(0.5, 0.5, 0), (0, 0, 1), (1, 0, 1)]])
    assert intersections(mesh_of(SQUARE, through), program) == 2
    assert intersections(mesh_of(SQUARE, touching), program) == 2
    assert intersections(mesh_of(SQUARE, touching + [0, 0, 1e-12]), program) == 0
    # With a common corner, and with a common edge: through the square, away from it, and folded.
    corner = numpy.array([[(0, 0, 0), (0.9, 0.2, -1), (0.9, 0.2, 1)]])
    edge = numpy.array([[(0, 0, 0), (1, 0, 0), (0.6, 0.4, 0)]])
    assert intersections(mesh_of(SQUARE, corner), program) == 1
    assert intersections(mesh_of(SQUARE, -corner), program) == 0
    assert intersections(mesh_of(SQUARE[:1], edge), program) == 1
    assert intersections(mesh_of(SQUARE[:1], edge * [1, -1, 1]), program) == 0


def test_shifted_cube():
    """By a quarter along x: the corners at x = 0 are that far off, the others are on its sides."""
    full, shifted = mesh_of(cube(4)), mesh_of(cube(4) + [0.25, 0, 0])
    near(deviation_of_points(full.points, shifted)[0], (0.25 / 2**0.5, 0.25))
    # Of an area of 96, the 16 outside are 1/4 off, and four strips of 4 x 1/4 from 0 to 1/4. The 16
    # inside are 1/4 off except in a margin, where another side is nearer.
    margin = 4 * (3.5 * 0.25**3 / 3 + 0.25**4 / 6)
    squares = 16 / 16 + 4 * 4 / 4 / 48 + 3.5**2 / 16 + margin
    back, angle, folded = deviation_of_mesh(shifted, NearestTriangle(full))
    near(back.rms, (squares / 96) ** 0.5, 0.01)
    near(back.maximum, 0.25)
    assert folded == 0, folded
    # The nearest sides to the margin are across: 16 - 3.5^2 of 96 are off by 90 degrees.
    near(angle, 90 * 3.75 / 96, 0.05)


def test_squares():
    full = NearestTriangle(mesh_of(4 * SQUARE))
    above = mesh_of(2 * SQUARE + [1, 1, 0.3])
    near(deviation_of_points(full.mesh.points, above)[0], [(1 + 1 + 0.3**2) ** 0.5] * 2)
    back, angle, folded = deviation_of_mesh(above, full)
    near((*back, angle, folded), (0.3, 0.3, 0, 0))
    # Half of it folded back, above itself.
    fold = (SQUARE * [1, 2, 1])[:, ::-1] + [2, 1, 0.4]
    back, angle, folded = deviation_of_mesh(mesh_of(above.corners, fold), full)
    near((*back, angle, folded), (((4 * 0.09 + 2 * 0.16) / 6) ** 0.5, 0.4, 180 / 3, 1 / 3))
    # Tilted by 3 in 4: heights from 0 to 1.5.
    tilted = mesh_of(2 * SQUARE @ [[1, 0, 0.75], [0, 1, 0], [0, 0, 1]] + [1, 1, 0])
    back, angle, folded = deviation_of_mesh(tilted, full)
    near(back.rms, 1.5 / 3**0.5, 0.01)
    near((back.maximum, angle, folded), (1.5, numpy.degrees(numpy.arctan(0.75)), 0))


def test_far_and_many():
    """Triangles of all sizes, points near and far: deviation_of_points checks with VTK's locator.
    If a mesh has many samples, means are close, but the maximum is over all, and may be inside."""
    random = numpy.random.default_rng(1)
    places = random.uniform(-9, 9, (400, 1, 3))
    spread = random.uniform(0.01, 1, (400, 1, 1)) ** 3
    some = mesh_of(places + 9 * spread * random.standard_normal((400, 3, 3)))
    points = numpy.concatenate([scale * random.standard_normal((2000, 3)) for scale in (5, 200)])
    deviation_of_points(points, some)
    nearest = NearestTriangle(mesh_of(9 * cube(1)))
    all_samples = deviation_of_mesh(some, nearest)
    known = meshmeasures.MEAN_SAMPLES
    meshmeasures.MEAN_SAMPLES = len(some.parts[0]) // 3
    some_samples = deviation_of_mesh(some, nearest)
    meshmeasures.MEAN_SAMPLES = known
    inside = mesh_of(9 * SQUARE @ [[1, 0, 0], [0, 1, 1], [0, 0, 0]])
    meshmeasures.MEAN_SAMPLES = 40
    maximum = deviation_of_mesh(inside, nearest)[0].maximum
    meshmeasures.MEAN_SAMPLES = known
    near(maximum, deviation_of_mesh(inside, nearest)[0].maximum)
    near(maximum, 4.5, 0.1)
    near(some_samples[0].maximum, all_samples[0].maximum)
    near(some_samples[0].rms, all_samples[0].rms, 0.05)
    assert some_samples[0].rms != all_samples[0].rms


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print(name)
