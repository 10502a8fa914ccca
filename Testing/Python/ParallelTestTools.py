# SPDX-License-Identifier: BSD-3-Clause
"""What tests in pvbatch share, with any number of processes: a source of an image, the meshes of
all processes on the first one, as rows of numbers, and an end for all of them if one fails."""
import os
import sys
import traceback

import numpy
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController

controller = vtkMultiProcessController.GetGlobalController()
rank = controller.GetLocalProcessId()
ranks = controller.GetNumberOfProcesses()

SIZE = (35, 30, 75)  # of Source's image


def gathered(mesh):
    """On the first process, the meshes of all processes; elsewhere, nothing."""
    if rank > 0:
        controller.Send(mesh, 0, 7)
        return []
    received = [mesh]
    for process in range(1, ranks):
        other = mesh.NewInstance()
        controller.Receive(other, process, 7)
        received.append(other)
    return received


def cells(mesh, by_name=False):
    """The mesh's cells, one row each: corners with their point data, in the order of the arrays or
    of their names."""
    size = mesh.GetCell(0).GetNumberOfPoints() if mesh.GetNumberOfCells() > 0 else 1
    array = mesh.GetCells() if mesh.IsA("vtkUnstructuredGrid") else None
    if array is None:
        array = mesh.GetPolys() if mesh.GetNumberOfPolys() > 0 else mesh.GetVerts()
    corners = vtk_to_numpy(array.GetConnectivityArray()).reshape(-1, size)
    if not len(corners):
        return numpy.zeros((0, 0))
    arrays = [mesh.GetPointData().GetArray(i) for i in range(mesh.GetPointData().GetNumberOfArrays())]
    if by_name:
        arrays.sort(key=lambda array: array.GetName())
    columns = [vtk_to_numpy(array).astype(float) for array in [mesh.GetPoints().GetData(), *arrays]]
    return numpy.column_stack(columns)[corners].reshape(len(corners), -1)


def own_cells(mesh):
    """The cells that are a process's own: behind a file reader, ParaView asks for ghosts, too."""
    marks = mesh.GetCellData().GetArray("vtkGhostType")
    mesh.GetPointData().RemoveArray("vtkGhostType")
    rows = cells(mesh)
    return rows if marks is None else rows[vtk_to_numpy(marks) == 0]


def lexsorted(rows):
    return rows[numpy.lexsort(rows.T[::-1])]


def rows(mesh):
    return cells(mesh, by_name=True)


def together(filter):
    """On the first process, the cells that a filter has in all of them."""
    filter.UpdatePiece(rank, ranks, 0)
    pieces = [rows(mesh) for mesh in gathered(filter.GetOutputDataObject(0))]
    return numpy.concatenate([piece for piece in pieces if len(piece)]) if rank == 0 else None


def new(filter, source, **properties):
    """Puts a filter behind a source, with properties by VTK's names, and returns it."""
    filter.SetInputConnection(source.GetOutputPort())
    for name, value in properties.items():
        getattr(filter, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    return filter


def abort_at(filter, phase):
    """Stops a filter in one of its phases."""
    filter.AddObserver(
        "ProgressEvent", lambda *_: filter.SetAbortExecute(1) if filter.GetProgressText() == phase else None)


class Source(VTKPythonAlgorithmBase):
    """Makes the part of an image that it is asked for, and notes which slices; or always gives the
    same part, whatever it is asked for: see have()."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.slices = []
        self.fails_at = None
        self.has_nan = False
        self.part = None
        self.sign = 1
        self.blanks = False
        self.origin = (0, 0, 0)

    def have(self, part, ghosts=0):
        """Always give this extent, with layers of ghost cells around it as far as the image goes.
        None: give what is asked for."""
        self.part, self.ghosts = part, ghosts

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        whole = [bound for length in SIZE for bound in (0, length - 1)]
        info.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), whole, 6)
        if not self.part:
            info.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
        return 1

    def RequestData(self, request, inputs, outputs):
        extent = [0] * 6
        outputs.GetInformationObject(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_EXTENT(), extent)
        self.slices.append((extent[4], extent[5]))
        if len(self.slices) == self.fails_at:
            return 0
        if self.part:
            extent = [min(max(bound + self.ghosts * (2 * (i % 2) - 1), 0), SIZE[i // 2] - 1)
                      for i, bound in enumerate(self.part)]
        x, y, z = (numpy.arange(extent[2 * i], extent[2 * i + 1] + 1, dtype=float) for i in range(3))
        x, y, z = x[None, None, :], y[None, :, None], z[:, None, None]
        values = 13 - numpy.sqrt((x - 17) ** 2 + (y - 15) ** 2 + (0.4 * (z - 37)) ** 2)
        values = values + numpy.sin(0.9 * x) * numpy.cos(0.7 * y) * numpy.sin(0.5 * z)
        values *= self.sign
        if self.has_nan:
            values[numpy.broadcast_to((x == 20) & (y == 3 + z % 20), values.shape)] = numpy.nan
        image = dataset_adapter.WrapDataObject(vtkImageData.GetData(outputs))
        image.VTKObject.SetExtent(extent)
        image.VTKObject.SetOrigin(self.origin)
        image.PointData.append(values.ravel(), "values")
        image.PointData.append((3 * x + 5 * y + 7 * z).ravel(), "other")
        image.PointData.SetActiveScalars("values")
        self.mark(image, extent)
        return 1

    def mark(self, image, extent):
        """Marks blanked cells and those of other processes, and spoils the values there: nobody may
        use them."""
        x, y, z = (numpy.arange(extent[2 * i], extent[2 * i + 1]) for i in range(3))
        x, y, z = x[None, None, :], y[None, :, None], z[:, None, None]
        marks = numpy.zeros((len(z), y.size, x.size), numpy.uint8)
        if self.blanks:
            marks |= numpy.where((x - 17) ** 2 + (y - 8) ** 2 + (z - 30) ** 2 < 30, 32, 0).astype(numpy.uint8)
        if self.part and self.ghosts:
            own = [(low <= at) & (at < high) for at, low, high in zip((x, y, z), self.part[::2], self.part[1::2])]
            is_own = own[0] & own[1] & own[2]
            marks |= numpy.where(is_own, 0, 1).astype(numpy.uint8)
            values = image.PointData["values"].reshape(len(z) + 1, y.size + 1, x.size + 1)
            inside = tuple(slice(low - first, high - first + 1) for low, high, first in
                           zip(self.part[4::-2], self.part[5::-2], extent[4::-2]))
            trusted = values[inside].copy()
            values[...] = -1e9
            values[inside] = trusted
        if marks.any():
            image.CellData.append(marks.ravel(), "vtkGhostType")


def run(main):
    """Runs a test. A process in which it fails exits, so that mpiexec ends the others: they would
    wait for it."""
    try:
        main()
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
