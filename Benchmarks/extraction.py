# SPDX-License-Identifier: BSD-3-Clause
"""Build and extraction times against vtkFlyingEdges3D on synthetic volumes, one thread each.

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/extraction.py [SIZE]

Prints medians of interleaved runs and their ratios; only the ratios can be compared between
machines. Fields: a smooth ball, a ball with noise, and a gyroid that fills the volume.
"""
import statistics
import time

import numpy
from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from volumes import gyroid, image_of, parser_of_size

RUNS = 7


def fields(size):
    axis = numpy.linspace(-1, 1, size, dtype=numpy.float32)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    ball = 0.6 - numpy.sqrt(x * x + y * y + z * z)
    yield "ball", ball
    noise = numpy.random.default_rng(1).standard_normal(ball.shape, dtype=numpy.float32)
    yield "noisy ball", ball + noise * numpy.float32(2 / size)
    yield "gyroid", gyroid(axis * numpy.float32(8 * numpy.pi))


def make_builder(image):
    builder = vtkIsodiamondBuilder()
    builder.SetInputData(image)
    builder.SetIsovalue(0)
    builder.SetNumberOfThreads(1)
    return builder


def timed(algorithm):
    algorithm.Modified()
    start = time.perf_counter()
    algorithm.Update()
    return 1000 * (time.perf_counter() - start)


def main():
    size = parser_of_size(__doc__, 256).parse_args().size
    print(f"{size}^3, medians of {RUNS}, milliseconds; ratios to vtkFlyingEdges3D")
    for name, field in fields(size):
        image = image_of(field)
        contour = vtkFlyingEdges3D()
        contour.SetInputData(image)
        contour.SetValue(0, 0)
        contour.ComputeNormalsOff()
        contour.ComputeScalarsOff()
        # The second builder's output stays, so that extraction finds it checked.
        builder, unchanged = make_builder(image), make_builder(image)
        by_distance = make_builder(image)
        by_distance.SetErrorMetricToDistance()
        extractor = vtkIsodiamondExtractor()
        extractor.SetInputConnection(unchanged.GetOutputPort())
        extractor.SetNumberOfThreads(1)
        extractor.Update()
        theirs, builds, distance_builds, extractions = [], [], [], []
        for _ in range(RUNS):
            theirs.append(timed(contour))
            builds.append(timed(builder))
            if len(distance_builds) < 3:
                distance_builds.append(timed(by_distance))
            extractions.append(timed(extractor))
        reference = statistics.median(theirs)
        build = statistics.median(builds)
        distance_build = statistics.median(distance_builds)
        extraction = statistics.median(extractions)
        print(
            f"{name:>12}: flying edges {reference:.0f}"
            f" ({contour.GetOutput().GetNumberOfCells():,} triangles),"
            f" build {build:.0f} ({build / reference:.1f} x),"
            f" by distance {distance_build:.0f} ({distance_build / reference:.1f} x),"
            f" extraction {extraction:.0f} ({extraction / reference:.2f} x,"
            f" {extractor.GetOutput().GetNumberOfCells():,} triangles)"
        )


main()
