# SPDX-License-Identifier: BSD-3-Clause
"""An interval volume of a synthetic field by Isodiamonds and by ParaView's vtkIsoVolume.

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/interval_volume.py [SIZE]

One thread each, each in a process of its own, build (by the field metric) included; medians of the
seconds, and of the peak memory above what the input took. vtkIsoVolume returns cells of several
kinds, Isodiamonds only tetrahedra.
"""
import argparse
import json
import statistics
import subprocess
import time

import numpy
from isodiamonds import vtkIsodiamondIntervalVolume
from paraview.modules.vtkPVVTKExtensionsFiltersGeneral import vtkIsoVolume
from processmemory import forget_peak, memory
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from volumes import gyroid, parser_of_size

RUNS = 3


def shell(size):
    """A bumpy shell between two spheres."""
    axis = numpy.linspace(-1, 1, size, dtype=numpy.float32)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    bumps = numpy.sin(12 * x) * numpy.sin(11 * y) * numpy.cos(10 * z)
    return numpy.sqrt(x * x + y * y + z * z) + numpy.float32(0.05) * bumps, (0.5, 0.7)


def sheets(size):
    """Sheets all over the volume."""
    return gyroid(numpy.linspace(0, 6 * numpy.pi, size, dtype=numpy.float32)), (-0.3, 0.3)


FIELDS = {"shell": shell, "gyroid": sheets}


def measure(kind, name, size):
    """Seconds, MiB above the input and number of cells of one run."""
    field, isorange = FIELDS[name](size)
    image = vtkImageData()
    image.SetDimensions(size, size, size)
    scalars = numpy_to_vtk(field.ravel(), deep=True)
    scalars.SetName("F")
    image.GetPointData().SetScalars(scalars)
    if kind == "vtkIsoVolume":
        volume = vtkIsoVolume()
        volume.ThresholdBetween(*isorange)
        volume.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "F")
    else:
        volume = vtkIsodiamondIntervalVolume()
        volume.SetIsorange(isorange)
        volume.SetErrorMetricToField()
        volume.SetNumberOfThreads(1)
    volume.SetInputData(image)
    forget_peak()
    before = memory("VmRSS")
    start = time.perf_counter()
    volume.Update()
    seconds = time.perf_counter() - start
    return seconds, memory("VmHWM") - before, volume.GetOutput().GetNumberOfCells()


def main():
    parser = parser_of_size(__doc__, 128)
    parser.add_argument("--run", nargs=2, help=argparse.SUPPRESS)  # of a process of its own
    arguments = parser.parse_args()
    size = arguments.size
    if arguments.run:
        print(json.dumps(measure(*arguments.run, size)))
        return
    print(f"{size}^3 floats, medians of {RUNS}")
    for name in FIELDS:
        results = {"Isodiamonds": [], "vtkIsoVolume": []}
        for _ in range(RUNS):
            for kind, rows in results.items():
                command = ["pvpython", __file__, str(size), "--run", kind, name]
                output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
                rows.append(json.loads(output.splitlines()[-1]))
        seconds = {k: statistics.median(r[0] for r in rows) for k, rows in results.items()}
        peaks = {k: statistics.median(r[1] for r in rows) for k, rows in results.items()}
        for kind, rows in results.items():
            print(
                f"{name:>8} {kind:>14}: {seconds[kind]:.3f} s, {peaks[kind]:.0f} MiB,"
                f" {rows[0][2]:,} cells"
            )
        print(
            f"{name:>8} ratios: time {seconds['Isodiamonds'] / seconds['vtkIsoVolume']:.2f},"
            f" memory {peaks['Isodiamonds'] / peaks['vtkIsoVolume']:.2f}"
        )


main()
