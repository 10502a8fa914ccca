# SPDX-License-Identifier: BSD-3-Clause
"""What tests in pvbatch with any number of processes share: meshes of all of them on the first one, as
rows of numbers, and an end for all if one fails."""
import os
import sys
import traceback

import numpy
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController

controller = vtkMultiProcessController.GetGlobalController()
rank = controller.GetLocalProcessId()
ranks = controller.GetNumberOfProcesses()


def gathered(mesh):
    """What each process has, on the first process; nothing elsewhere."""
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
    """The mesh's cells: corners with their point data, in the order of the arrays or of their names,
    one row for each cell."""
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


def lexsorted(rows):
    return rows[numpy.lexsort(rows.T[::-1])]


def run(main):
    """The others wait for a process that fails: without it mpiexec ends them."""
    try:
        main()
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
