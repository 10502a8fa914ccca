#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds and extracts a surface of a volume that comes in slabs, and prints how much memory and time
that takes: by default 2048 x 2048 x 1024 floats, 16 GiB, never more than a slab of it at a time.

Usage: larger_than_memory.py [--size X Y Z] [--blocks N] [--threads N] [--gyroid]
or, with several processes that share the volume:
  mpiexec -n N pvbatch --symmetric larger_than_memory.py ...
"""
import argparse
import resource
import time

import numpy as np
from isodiamonds import vtkIsodiamondContour
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController


class Source(VTKPythonAlgorithmBase):
    """A bumpy ellipsoid or a gyroid, in just the part of the image that is asked for."""

    def __init__(self, size, is_gyroid):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.size = size
        self.is_gyroid = is_gyroid
        self.voxels = 0
        self.seconds = 0.0

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        whole = [bound for length in self.size for bound in (0, length - 1)]
        info.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), whole, 6)
        info.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
        return 1

    def RequestData(self, request, inputs, outputs):
        start = time.time()
        extent = [0] * 6
        outputs.GetInformationObject(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_EXTENT(), extent)
        axes = [
            np.linspace(-1.0, 1.0, length, dtype=np.float32)[extent[2 * i]:extent[2 * i + 1] + 1]
            for i, length in enumerate(self.size)
        ]
        values = np.empty([len(axis) for axis in reversed(axes)], np.float32)
        self.fill(values, axes)
        image = dataset_adapter.WrapDataObject(vtkImageData.GetData(outputs))
        image.VTKObject.SetExtent(extent)
        image.PointData.append(values.ravel(), "radius")
        image.PointData.SetActiveScalars("radius")
        self.voxels += values.size
        self.seconds += time.time() - start
        return 1

    def fill(self, values, axes):
        if self.is_gyroid:
            # A period of 24 samples: dense.
            x, y, z = (axis * length * np.pi / 24 for axis, length in zip(axes, self.size))
            for slab, angle in zip(values, z):
                slab[:] = np.sin(x)[None, :] * np.cos(y)[:, None] + 0.6
                slab += np.sin(y)[:, None] * np.cos(angle) + np.sin(angle) * np.cos(x)[None, :]
            return
        rows = axes[0][None, :] ** 2 + axes[1][:, None] ** 2
        bumps = 0.02 * np.sin(20 * axes[0])[None, :] * np.sin(20 * axes[1])[:, None]
        for slab, z in zip(values, axes[2]):
            np.add(rows, z * z, out=slab)
            np.sqrt(slab, out=slab)
            slab -= bumps * np.sin(20 * z)


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--size", type=int, nargs=3, default=[2048, 2048, 1024])
    parser.add_argument("--blocks", type=int, default=32)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--gyroid", action="store_true")
    arguments = parser.parse_args()
    controller = vtkMultiProcessController.GetGlobalController()
    rank = controller.GetLocalProcessId() if controller else 0
    ranks = controller.GetNumberOfProcesses() if controller else 1
    source = Source(arguments.size, arguments.gyroid)
    contour = vtkIsodiamondContour()
    contour.SetInputConnection(source.GetOutputPort())
    contour.SetValue(0, 0.6)
    contour.SetNumberOfBlocks(arguments.blocks)
    contour.ComputeNormalsOff()
    contour.SetNumberOfThreads(arguments.threads)
    samples = arguments.size[0] * arguments.size[1] * arguments.size[2]
    print(f"{rank}: {samples / 2**28:.2f} GiB of floats; {memory():.3f} GiB before anything")
    for tolerance in (1.0, 0.5):
        contour.SetErrorTolerance(tolerance)
        source.voxels, source.seconds = 0, 0.0
        start = time.time()
        contour.UpdatePiece(rank, ranks, 0)
        seconds = time.time() - start
        print(
            f"{rank}: tolerance {tolerance}: {contour.GetOutput().GetNumberOfPolys()} triangles in {seconds:.1f} s, of"
            f" which the source {source.seconds:.1f} s for {source.voxels / samples:.2f} times the volume;"
            f" {memory():.3f} GiB",
            flush=True)


main()
