# SPDX-License-Identifier: BSD-3-Clause
"""What a user of the one-step filter waits for, against ParaView's Contour (vtkContourFilter).

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/first_apply.py [OPTIONS] [RAW ...]

For each volume: the first Apply at full resolution; then the first tolerance, half a voxel, which
measures errors; then another one, a voxel; with a new filter, a first Apply that starts at half a
voxel; and the same with OneTolerance. All run as the panel starts them, but without normals and
scalars, which vtkContourFilter does not make here, either. Full resolution is also measured with
both, against vtkContourFilter with both; and each again, with new filters one after the other, in
memory that the process has had before. Last come Contour and Decimate (vtkDecimatePro), run once,
for as many triangles as there are at half a voxel. All other figures are medians of several runs,
ours each with a new filter. Figures are multiples of the time of vtkContourFilter, which has one
thread, as has vtkDecimatePro. RAW is NAME_XxYxZ_uint8.raw:ISOVALUE; the other volumes are synthetic
and, where Debian's mricron-data is installed, an MRI head.
"""
import argparse
import os
import statistics

import numpy
from isodiamonds import vtkIsodiamondContour
from simplifiers import timed
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkDecimatePro
from volumes import HEAD, HEAD_ISOVALUE, gyroid, head, image_of, phantom, raw_volume


def configured(contour, image, isovalue, shaded=False):
    contour.SetInputData(image)
    contour.SetValue(0, isovalue)
    contour.SetComputeNormals(shaded)
    contour.SetComputeScalars(shaded)
    return contour


def at(contour, tolerance):
    contour.SetErrorTolerance(tolerance)
    return timed(contour)


def waits(image, isovalue, threads):
    """Milliseconds: a first Apply at full resolution, and with normals and scalars; the first
    tolerance, and the next; a first Apply at a tolerance, and with OneTolerance."""
    voxel = min(image.GetSpacing())
    first, second, only = (configured(vtkIsodiamondContour(), image, isovalue) for _ in range(3))
    shaded = configured(vtkIsodiamondContour(), image, isovalue, shaded=True)
    for contour in (first, shaded, second, only):
        contour.SetNumberOfThreads(threads)
    only.OneToleranceOn()
    times = [at(first, 0), at(shaded, 0), at(first, voxel / 2), at(first, voxel)]
    return times + [at(second, voxel / 2), at(only, voxel / 2)]


def again(image, isovalue, threads, runs, shaded):
    """Milliseconds: full resolution in memory that the process has had before."""
    times = []
    for _ in range(runs + 1):
        contour = configured(vtkIsodiamondContour(), image, isovalue, shaded)
        contour.SetNumberOfThreads(threads)
        times.append(at(contour, 0))
        del contour  # its memory is the next one's
    return statistics.median(times[1:])


def contour_and_decimate(contour, image, isovalue):
    """Milliseconds of both filters, for as many triangles as ours has at half a voxel."""
    ours = configured(vtkIsodiamondContour(), image, isovalue)
    at(ours, min(image.GetSpacing()) / 2)
    triangles = ours.GetOutput().GetNumberOfPolys()
    decimate = vtkDecimatePro()
    decimate.SetInputConnection(contour.GetOutputPort())
    decimate.SetTargetReduction(1 - triangles / contour.GetOutput().GetNumberOfPolys())
    contour.Modified()
    return timed(decimate)


def ball(axis):
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    return numpy.float32(0.6) - numpy.sqrt(x * x + y * y + z * z)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--size", type=int, default=128, help="of the synthetic volumes, in samples")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("raw", nargs="*", type=raw_volume, help="NAME_XxYxZ_uint8.raw:ISOVALUE")
    arguments = parser.parse_args()
    size = arguments.size
    axis = numpy.linspace(-1, 1, size, dtype=numpy.float32)
    volumes = [
        ("ball", image_of(ball(axis)), 0),
        ("gyroid", image_of(gyroid(axis * numpy.float32(8 * numpy.pi))), 0),
        ("CT phantom", phantom(size), 50),
    ]
    if os.path.exists(HEAD):
        volumes.append(("MRI head", head(), HEAD_ISOVALUE))
    volumes.extend(arguments.raw)
    print("| volume | threads | vtkContourFilter, ms | full resolution | with normals "
          "| again | again, with normals | first tolerance | next | half a voxel at once | OneTolerance "
          "| Contour + Decimate |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    for name, image, isovalue in volumes:
        reference = configured(vtkContourFilter(), image, isovalue)
        unit = statistics.median(timed(reference) for _ in range(arguments.runs))
        shaded = configured(vtkContourFilter(), image, isovalue, shaded=True)
        unit_shaded = statistics.median(timed(shaded) for _ in range(arguments.runs))
        decimated = contour_and_decimate(reference, image, isovalue)
        for threads in (1, 2):
            runs = [waits(image, isovalue, threads) for _ in range(arguments.runs)]
            times = [statistics.median(column) for column in zip(*runs)] + [decimated]
            times[2:2] = [
                again(image, isovalue, threads, arguments.runs, with_normals)
                for with_normals in (False, True)
            ]
            units = [unit, unit_shaded] * 2 + [unit] * (len(times) - 4)
            ratios = [f"{time / of:.2f}" for time, of in zip(times, units)]
            print("|", " | ".join([name, str(threads), f"{unit:.0f}", *ratios]), "|", flush=True)


main()
