# SPDX-License-Identifier: BSD-3-Clause
"""What one of several processes needs for its share of a mesh, beside one that makes it all.

    PYTHONPATH=build/lib/python3/dist-packages python3 Benchmarks/shares.py [SIZE]

One process makes the shares of 1, 2, 4 and 8 one after the other, with one thread. For each of
these numbers it prints the time of the slowest share, as the median of interleaved runs, and how
much larger the largest share is than the mean. To measure how much memory the first share takes
beyond the hierarchy, a process of its own makes it (Linux only). All run in Python itself, as
`pvpython` cannot start another one. The field is the gyroid of extraction.py, by the field metric,
at full resolution and at a tolerance that leaves a quarter of the triangles.
"""
import argparse
import statistics
import subprocess
import sys
import time

import numpy
from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from processmemory import forget_peak, memory
from volumes import gyroid, image_of, parser_of_size

RUNS = 5
COUNTS = (1, 2, 4, 8)


def make_extractor(size):
    axis = numpy.linspace(-1, 1, size, dtype=numpy.float32) * numpy.float32(8 * numpy.pi)
    builder = vtkIsodiamondBuilder()
    builder.SetInputData(image_of(gyroid(axis)))
    builder.Update()
    extractor = vtkIsodiamondExtractor()
    extractor.SetInputConnection(builder.GetOutputPort())
    extractor.SetNumberOfThreads(1)
    return extractor


def print_peak(size, tolerance, count):
    """Runs in a process of its own, which has no freed memory that it could use again."""
    extractor = make_extractor(size)
    extractor.SetErrorTolerance(tolerance)
    forget_peak()
    before = memory("VmRSS")
    extractor.UpdatePiece(0, count, 0)
    print(memory("VmHWM") - before)


def peak(size, tolerance, count):
    command = [sys.executable, __file__, str(size), "--peak", str(tolerance), str(count)]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def timed(extractor, share, count):
    """Milliseconds, and cells."""
    extractor.Modified()
    start = time.perf_counter()
    extractor.UpdatePiece(share, count, 0)
    milliseconds = 1000 * (time.perf_counter() - start)
    return milliseconds, extractor.GetOutputDataObject(0).GetNumberOfCells()


def main():
    parser = parser_of_size(__doc__, 256)
    parser.add_argument("--peak", nargs=2, help=argparse.SUPPRESS)  # of a process of its own
    arguments = parser.parse_args()
    size = arguments.size
    if arguments.peak:
        tolerance, count = arguments.peak
        print_peak(size, float(tolerance), int(count))
        return
    extractor = make_extractor(size)
    for tolerance in (0.0, 0.05):
        extractor.SetErrorTolerance(tolerance)
        extractor.Update()
        triangles = extractor.GetOutputDataObject(0).GetNumberOfCells()
        print(f"{size}^3, tolerance {tolerance}: {triangles:,} triangles")
        times = {(share, count): [] for count in COUNTS for share in range(count)}
        cells = {}
        for _ in range(RUNS):
            for (share, count), runs in times.items():
                milliseconds, cells[share, count] = timed(extractor, share, count)
                runs.append(milliseconds)
        one = statistics.median(times[0, 1])
        all_of_it = peak(size, tolerance, 1)
        for count in COUNTS:
            slowest = max(statistics.median(times[share, count]) for share in range(count))
            largest = max(cells[share, count] for share in range(count)) * count / triangles
            mebibytes = peak(size, tolerance, count)
            print(f"  1 of {count}: {slowest:.0f} ms, {slowest / one:.2f} of the whole;"
                  f" {mebibytes:.0f} MiB, {mebibytes / all_of_it:.2f}; the largest {largest:.2f} of the mean")


main()
