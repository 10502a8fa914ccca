# SPDX-License-Identifier: BSD-3-Clause
"""In pvbatch with any number of processes: their shares together are the mesh that one process
makes, with each cell once and no crack.

Every process runs this script (pvbatch --symmetric), and with it the filters of ParaView's pipeline
for its own share; the first one collects the meshes and compares them."""
import os
import sys

import numpy
from paraview.simple import *
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import isodiamonds
from ParallelTestTools import cells, controller, gathered, lexsorted, own_cells, rank, ranks, run

FOLDER = sys.argv[1]
EXTENT = [-8, 8, -7, 9, -6, 26]  # 8 slices for each of four processes: they share the volume
LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())


def faces_of_one(rows, size):
    """The sides (edges of triangles, faces of tetrahedra) that only one cell has, told apart by
    exact positions of their corners; no side may have more than two cells."""
    width = rows.shape[1] // size
    positions = rows.reshape(-1, width)[:, :3]
    points, ids = numpy.unique(positions, axis=0, return_inverse=True)
    corners = ids.reshape(-1, size)
    sides = numpy.concatenate([numpy.delete(corners, i, axis=1) for i in range(size)])
    sides, uses = numpy.unique(numpy.sort(sides, axis=1), axis=0, return_counts=True)
    assert uses.max() <= 2, "a side of more than two cells"
    return points[sides[uses == 1]]


def on_border(sides):
    """For every side, whether it lies in one of the volume's six faces."""
    bounds = numpy.array(EXTENT, dtype=float).reshape(3, 2)
    on = [(sides[:, :, axis] == bound).all(axis=1) for axis in range(3) for bound in bounds[axis]]
    return numpy.any(on, axis=0)


def pieces(proxy):
    """On the first process, what each process has of a filter's output; elsewhere, nothing."""
    proxy.UpdatePipeline()
    output = proxy.GetClientSideObject().GetOutputDataObject(0)
    if output.IsA("vtkCompositeDataSet"):
        iterator = output.NewIterator()
        iterator.InitTraversal()
        output = iterator.GetCurrentDataObject()
    return gathered(output)


def compare(name, proxy, filter):
    """Compares the pieces of a ParaView filter with the whole mesh of a VTK filter."""
    meshes = pieces(proxy)
    if rank > 0:
        return
    filter.Update()
    whole = filter.GetOutputDataObject(0)
    pieces_of_all = [own_cells(mesh) for mesh in meshes]
    counts = [len(rows) for rows in pieces_of_all]
    assert len(meshes) == ranks and max(counts) <= 2 * sum(counts) / ranks, (name, counts)
    together = numpy.concatenate(pieces_of_all)
    expected = cells(whole)
    assert len(expected) > 500, (name, len(expected))
    assert together.shape == expected.shape, (name, together.shape, expected.shape)
    assert (lexsorted(together) == lexsorted(expected)).all(), name
    assert len(numpy.unique(together, axis=0)) == len(together), f"{name}: a cell twice"
    size = whole.GetCell(0).GetNumberOfPoints()
    if size > 1:
        alone = faces_of_one(together, size)
        assert len(alone) == len(faces_of_one(expected, size)), name
        if size == 3:
            assert on_border(alone).all(), f"{name}: a crack"
    print(f"{ranks} processes, {name}: {counts} cells")


source = vtkRTAnalyticSource()
source.SetWholeExtent(*EXTENT)
wavelet = Wavelet(WholeExtent=EXTENT)


def serial(filter, **properties):
    """The filter on the volume, without pieces and without ParaView."""
    filter.SetInputConnection(source.GetOutputPort())
    for name, value in properties.items():
        getattr(filter, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    return filter


builder = serial(isodiamonds.vtkIsodiamondBuilder(), Isovalue=150, ErrorMetric=1, PreserveTopology=True)


def of_hierarchy(filter, tolerance=None):
    filter.SetInputConnection(builder.GetOutputPort())
    if tolerance is not None:
        filter.SetErrorTolerance(tolerance)
    return filter


def main():
    for tolerance in (0, 0.3, 2):
        compare(
            f"contour at {tolerance}",
            IsodiamondContour(wavelet, Isosurfaces=[150], ErrorTolerance=tolerance, ComputeScalars=1),
            serial(isodiamonds.vtkIsodiamondContour(), Value=(0, 150), ErrorTolerance=tolerance),
        )
        compare(
            f"interval volume at {tolerance}",
            IsodiamondIntervalVolume(wavelet, Isorange=[150, 200], ErrorTolerance=tolerance),
            serial(isodiamonds.vtkIsodiamondIntervalVolume(), Isorange=(150, 200),
                   ErrorTolerance=tolerance),
        )

    # Each process has asked for its part of the volume only.
    extent = wavelet.GetClientSideObject().GetOutputDataObject(0).GetExtent()
    assert ranks == 1 or extent[5] - extent[4] < EXTENT[5] - EXTENT[4], extent

    hierarchy = IsodiamondHierarchy(wavelet, Isovalue=150, ErrorMetric="Distance")
    hierarchy.UpdatePipeline()
    outline = hierarchy.GetClientSideObject().GetOutputDataObject(0)
    assert outline.GetNumberOfCells() == (12 if rank == 0 else 0)
    assert outline.GetNumberOfActiveIsodiamonds() > 0
    for tolerance in (0, 0.3):
        compare(
            f"extraction at {tolerance}",
            IsodiamondExtract(hierarchy, ErrorTolerance=tolerance),
            of_hierarchy(isodiamonds.vtkIsodiamondExtractor(), tolerance),
        )
    path = os.path.join(FOLDER, f"parallel-{ranks}.vtp")
    if rank == 0:
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(path)
        writer.SetDataModeToBinary()
        writer.SetInputConnection(builder.GetOutputPort())
        assert writer.Write() == 1
    controller.Barrier()
    compare(
        "extraction from a file",
        IsodiamondExtract(XMLPolyDataReader(FileName=[path]), ErrorTolerance=0.3),
        of_hierarchy(isodiamonds.vtkIsodiamondExtractor(), 0.3),
    )
    # Behind a group, filters ask for the whole volume, not pieces, and the group passes that on.
    compare(
        "contour of a group",
        IsodiamondContour(
            GroupDatasets(wavelet), Isosurfaces=[150], ErrorTolerance=0.3, ComputeScalars=1
        ),
        serial(isodiamonds.vtkIsodiamondContour(), Value=(0, 150), ErrorTolerance=0.3),
    )
    compare(
        "diamond mesh",
        DiamondMesh(hierarchy, ErrorTolerance=0.3),
        of_hierarchy(isodiamonds.vtkDiamondMesh(), 0.3),
    )
    compare("points", IsodiamondPoints(hierarchy), of_hierarchy(isodiamonds.vtkIsodiamondPoints()))


run(main)
