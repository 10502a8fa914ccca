#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds and extracts a surface of a volume that comes in slabs, and prints how much memory and time
that takes: 2048 x 2048 x 1024 floats by default, 16 GiB, of which no more than a slab is anywhere.

Usage: larger_than_memory.py [--size X Y Z] [--blocks N] [--threads N]
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


class Ball(VTKPythonAlgorithmBase):
    """A bumpy ellipsoid, in just the part of the image that is asked for."""

    def __init__(self, size):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.size = size
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
        rows = axes[0][None, :] ** 2 + axes[1][:, None] ** 2
        bumps = 0.02 * np.sin(20 * axes[0])[None, :] * np.sin(20 * axes[1])[:, None]
        for slab, z in zip(values, axes[2]):
            np.add(rows, z * z, out=slab)
            np.sqrt(slab, out=slab)
            slab -= bumps * np.sin(20 * z)
        image = dataset_adapter.WrapDataObject(vtkImageData.GetData(outputs))
        image.VTKObject.SetExtent(extent)
        image.PointData.append(values.ravel(), "radius")
        image.PointData.SetActiveScalars("radius")
        self.voxels += values.size
        self.seconds += time.time() - start
        return 1


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--size", type=int, nargs=3, default=[2048, 2048, 1024])
    parser.add_argument("--blocks", type=int, default=32)
    parser.add_argument("--threads", type=int, default=0)
    arguments = parser.parse_args()
    source = Ball(arguments.size)
    contour = vtkIsodiamondContour()
    contour.SetInputConnection(source.GetOutputPort())
    contour.SetValue(0, 0.6)
    contour.SetNumberOfBlocks(arguments.blocks)
    contour.SetNumberOfThreads(arguments.threads)
    samples = arguments.size[0] * arguments.size[1] * arguments.size[2]
    print(f"{samples / 2**28:.2f} GiB of floats; {memory():.2f} GiB before anything")
    for tolerance in (1.0, 0.5):
        contour.SetErrorTolerance(tolerance)
        source.voxels, source.seconds = 0, 0.0
        start = time.time()
        contour.Update()
        seconds = time.time() - start
        print(
            f"tolerance {tolerance}: {contour.GetOutput().GetNumberOfPolys()} triangles in {seconds:.1f} s, of"
            f" which the source {source.seconds:.1f} s for {source.voxels / samples:.2f} times the volume;"
            f" {memory():.2f} GiB",
            flush=True)


main()
