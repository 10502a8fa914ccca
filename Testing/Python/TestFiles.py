# SPDX-License-Identifier: BSD-3-Clause
"""Four processes build a hierarchy together and save it with ParaView's parallel writer; any number
of processes read it, and have the same arrays and the same mesh as one process that builds it."""
import os
import sys

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

import isodiamonds
from ParallelTestTools import cells, controller, gathered, lexsorted, own_cells, rank, run

PATH = os.path.join(sys.argv[1], "hierarchy.pvtp")
SAVES = sys.argv[2] == "save"
EXTENT = [-8, 8, -7, 9, -6, 26]
LoadPlugin(os.environ["ISODIAMONDS_PLUGIN"], remote=False, ns=globals())


def save():
    hierarchy = IsodiamondHierarchy(Wavelet(WholeExtent=EXTENT), Isovalue=150, ErrorMetric="Distance")
    SaveData(PATH, hierarchy, DataMode="Binary")  # see README.md on files
    controller.Barrier()
    # One process has written it all: none has only a part of a hierarchy.
    assert os.listdir(PATH[:-5]) == ["hierarchy_0.vtp"], os.listdir(PATH[:-5])


def serial():
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*EXTENT)
    builder = isodiamonds.vtkIsodiamondBuilder()
    builder.SetInputConnection(source.GetOutputPort())
    builder.SetIsovalue(150)
    builder.SetErrorMetricToDistance()
    builder.SetPreserveTopology(True)
    builder.Update()
    return builder


def read():
    reader = XMLPartitionedPolydataReader(FileName=[PATH])
    extract = IsodiamondExtract(reader, ErrorTolerance=0.3)
    extract.UpdatePipeline()
    meshes = gathered(extract.GetClientSideObject().GetOutputDataObject(0))
    found = reader.GetClientSideObject().GetOutputDataObject(0).GetFieldData()
    builder = serial()
    built = builder.GetOutput().GetFieldData()
    for i in range(built.GetNumberOfArrays()):
        name = built.GetArrayName(i)
        array = found.GetAbstractArray(name)
        assert array is not None, name
        if name.startswith("Isodiamond") and built.GetArray(i):
            assert vtk_to_numpy(array).tobytes() == vtk_to_numpy(built.GetArray(i)).tobytes(), name
    if rank == 0:
        extractor = isodiamonds.vtkIsodiamondExtractor()
        extractor.SetInputConnection(builder.GetOutputPort())
        extractor.SetErrorTolerance(0.3)
        extractor.Update()
        expected = cells(extractor.GetOutputDataObject(0))
        together = numpy.concatenate([own_cells(mesh) for mesh in meshes])
        assert len(expected) > 500, len(expected)
        assert together.shape == expected.shape, (together.shape, expected.shape)
        assert (lexsorted(together) == lexsorted(expected)).all()


run(save if SAVES else read)
