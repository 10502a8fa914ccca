# SPDX-License-Identifier: BSD-3-Clause
"""In pvbatch with any number of processes: what ParaView's readers and other people's sources do
that is not what a process asks for. Together the processes have the mesh that one makes alone."""
import os
import sys

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkRectilinearGrid
from vtkmodules.vtkFiltersCore import vtkPointDataToCellData
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLRectilinearGridWriter

import isodiamonds
from ParallelTestTools import cells, controller, gathered, lexsorted, rank, ranks, run

FOLDER = os.path.join(sys.argv[1], f"upstream{ranks}")
LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())


def wavelet(extent):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*extent)
    source.Update()
    return source.GetOutput()


def leaves(data):
    """The meshes in an output."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    iterator = data.NewIterator()
    found = []
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def corners(meshes):
    """The corners of all cells of some meshes, a row each."""
    found = []
    for mesh in meshes:
        mesh.GetPointData().Initialize()
        found.append(cells(mesh).reshape(-1, 9))
    return numpy.concatenate(found) if found else numpy.zeros((0, 9))


def gathered_corners(data):
    """On the first process, the triangles of all processes."""
    own = numpy_to_vtk(corners(leaves(data)).ravel(), deep=True)
    found = [vtk_to_numpy(array).reshape(-1, 9) for array in gathered(own)]
    return numpy.concatenate(found) if rank == 0 else None


def serial(volumes, isovalue, tolerance=0.0):
    """What one process makes of some volumes."""
    meshes = []
    for volume in volumes:
        contour = isodiamonds.vtkIsodiamondContour()
        contour.SetInputData(volume)
        contour.SetValue(0, isovalue)
        contour.SetErrorTolerance(tolerance)
        contour.Update()
        meshes.append(contour.GetOutput())
    return corners(meshes)


def expect(name, found, expected):
    if rank == 0:
        assert len(expected) > 100, name
        assert found.shape == expected.shape, (name, found.shape, expected.shape)
        assert numpy.array_equal(lexsorted(found), lexsorted(expected)), name
        print(f"{ranks} processes, {name}: {len(found)} triangles", flush=True)


def contour_of(proxy, isovalue, **properties):
    """The mesh of ParaView's filter behind a reader."""
    contour = IsodiamondContour(proxy, Isosurfaces=[isovalue], **properties)
    contour.UpdatePipeline()
    return gathered_corners(contour.GetClientSideObject().GetOutputDataObject(0))


def check_raw():
    """A reader that reads only if all processes do: one that does not would keep others waiting."""
    path = os.path.join(FOLDER, "ball.raw")
    for slices in (8 * ranks + 1, 64, 66, 128):  # where a process may have a slab at hand, or not
        z, y, x = numpy.ogrid[:slices, :20, :20]
        distances = numpy.sqrt((x - 9) ** 2 + (y - 9) ** 2 + (20 / slices * (z - slices / 2)) ** 2)
        values = (200 - 9 * distances).clip(0).astype(numpy.uint8)
        if rank == 0:
            values.tofile(path)
        controller.Barrier()
        image = vtkImageData()
        image.SetDimensions(20, 20, slices)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        expected = serial([image], 120.5)
        for blocks in (0, 1, ranks + 1):
            for is_read_before in (False, True):
                reader = ImageReader(FileNames=[path])
                reader.DataScalarType = "unsigned char"
                reader.FileDimensionality = 3
                reader.DataExtent = [0, 19, 0, 19, 0, slices - 1]
                if is_read_before:
                    reader.UpdatePipeline()
                found = contour_of(reader, 120.5, NumberOfBlocks=blocks)
                expect(f"raw file, {slices} slices, {blocks} blocks, read before: {is_read_before}", found, expected)
        controller.Barrier()


class Blocks(VTKPythonAlgorithmBase):
    """Gives each process blocks of its own, whatever it is asked for; the first one is everywhere,
    and the last process has no other."""

    COUNT = 5

    def __init__(self, kind):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=kind)

    @staticmethod
    def block(i):
        return wavelet((-10, 10, -10, 10, 10 * i - 25, 10 * i - 15))

    def RequestData(self, request, inputs, outputs):
        data = vtkDataObject.GetData(outputs)
        own = [i for i in range(self.COUNT) if i == 0 or i % max(ranks - 1, 1) == rank]
        for place, i in enumerate(own):
            block = vtkImageData()
            block.DeepCopy(self.block(i))
            if data.IsA("vtkMultiBlockDataSet"):
                data.SetBlock(i, block)
            else:
                data.SetPartition(place, block)
        return 1


def check_blocks():
    for kind in ("vtkMultiBlockDataSet", "vtkPartitionedDataSet"):
        for tolerance in (0.0, 1.0):
            source = Blocks(kind)
            contour = isodiamonds.vtkIsodiamondContour()
            contour.SetInputConnection(source.GetOutputPort())
            contour.SetValue(0, 157.0)
            contour.SetErrorTolerance(tolerance)
            expected = serial([Blocks.block(i) for i in range(Blocks.COUNT)], 157.0, tolerance)
            for again in range(2):
                contour.UpdatePiece(rank, ranks, 0)
                expect(f"{kind}, {tolerance}, {again}", gathered_corners(contour.GetOutputDataObject(0)), expected)
        builder = isodiamonds.vtkIsodiamondBuilder()
        builder.SetInputConnection(source.GetOutputPort())
        builder.SetIsovalue(157.0)
        extractor = isodiamonds.vtkIsodiamondExtractor()
        extractor.SetInputConnection(builder.GetOutputPort())
        extractor.SetOutputTypeToPolyData()
        extractor.UpdatePiece(rank, ranks, 0)
        expected = serial([Blocks.block(i) for i in range(Blocks.COUNT)], 157.0)
        expect(f"{kind}, hierarchies", gathered_corners(extractor.GetOutputDataObject(0)), expected)


def rectilinear(image):
    grid = vtkRectilinearGrid()
    extent = image.GetExtent()
    grid.SetExtent(extent)
    for axis, place in enumerate((grid.SetXCoordinates, grid.SetYCoordinates, grid.SetZCoordinates)):
        place(numpy_to_vtk(numpy.arange(extent[2 * axis], extent[2 * axis + 1] + 1.0), deep=True))
    grid.GetPointData().ShallowCopy(image.GetPointData())
    return grid


def check_time_steps():
    """Upstream says that all steps have the first one's extent."""
    last = 16 * max(ranks, 3)
    for ending, writer, grid in (
        ("vti", vtkXMLImageDataWriter, lambda image: image),
        ("vtr", vtkXMLRectilinearGridWriter, rectilinear),
    ):
        for ends in ((last - 16, last), (last, last - 16)):
            steps = [wavelet((-10, 10, -10, 10, -20, end - 20)) for end in ends]
            path = os.path.join(FOLDER, f"steps{ends[0]}{ending}.pvd")
            if rank == 0:
                for i, step in enumerate(steps):
                    output = writer()
                    output.SetDataModeToBinary()  # see README.md on files
                    output.SetInputData(grid(step))
                    output.SetFileName(os.path.join(FOLDER, f"step{ends[0]}{i}.{ending}"))
                    output.Write()
                files = "".join(f'<DataSet timestep="{i}" file="step{ends[0]}{i}.{ending}"/>' for i in range(2))
                with open(path, "w", encoding="utf-8") as file:
                    file.write(f'<VTKFile type="Collection" version="0.1"><Collection>{files}</Collection></VTKFile>')
            controller.Barrier()
            for blocks in (0, 3):
                contour = IsodiamondContour(PVDReader(FileName=path), Isosurfaces=[157.0], NumberOfBlocks=blocks)
                contour.ContourBy = ["POINTS", "RTData"]
                for time in (0, 1, 0):
                    contour.UpdatePipeline(time)
                    found = gathered_corners(contour.GetClientSideObject().GetOutputDataObject(0))
                    expect(f"{ending}, ends {ends}, step {time}, {blocks} blocks", found, serial([steps[time]], 157.0))


def check_cells():
    """ParaView can make point data of cell data, part by part: those at ends of parts are wrong."""
    path = os.path.join(FOLDER, "cells.vti")
    if rank == 0:
        output = vtkXMLImageDataWriter()
        output.SetDataModeToBinary()
        converter = vtkPointDataToCellData()
        converter.SetInputData(wavelet((-10, 10, -10, 10, 0, 8 * max(ranks, 3))))
        output.SetInputConnection(converter.GetOutputPort())
        output.SetFileName(path)
        output.Write()
    controller.Barrier()
    settings = GetSettingsProxy("GeneralSettings")
    settings.AutoConvertProperties = 1
    meshes = []
    for blocks in (1, 0, 3):
        for is_read_before in (False, True):
            reader = XMLImageDataReader(FileName=[path])
            if is_read_before:
                reader.UpdatePipeline()
            contour = IsodiamondContour(reader, Isosurfaces=[157.0], NumberOfBlocks=blocks)
            contour.ContourBy = ["POINTS", "RTData"]
            contour.UpdatePipeline()
            meshes.append(gathered_corners(contour.GetClientSideObject().GetOutputDataObject(0)))
            expect(f"cell data, {blocks} blocks, read before: {is_read_before}", meshes[-1], meshes[0])
    settings.AutoConvertProperties = 0


def main():
    os.makedirs(FOLDER, exist_ok=True)
    check_raw()
    check_blocks()
    check_time_steps()
    check_cells()


run(main)
