# SPDX-License-Identifier: BSD-3-Clause
"""In pvbatch with any number of processes: a source that gives each process what it asks for, and
no more. Each asks for its share of the volume, and together they have the mesh that one process
makes, to the bit. A process that fails does not keep the others waiting."""
import numpy
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.vtkImagingCore import vtkImageShiftScale

import isodiamonds
from ParallelTestTools import SIZE, Source, abort_at, lexsorted, new, rank, ranks, rows, run, together


def check(name, make, settings, has_nan=False, blocks=0):
    """Compares a filter in all processes with one in a single one, for some settings in turn."""
    source = Source()
    source.has_nan = has_nan
    shared = new(make(), source, NumberOfBlocks=blocks)
    alone = new(make(), source_alone := Source(), NumberOfBlocks=1)
    source_alone.has_nan = has_nan
    slabs = max(ranks, min(blocks, SIZE[2] // 8))
    for properties in settings:
        new(shared, source, **properties)
        found = together(shared)
        if rank == 0:
            new(alone, source_alone, **properties)
            alone.Update()
            expected = rows(alone.GetOutputDataObject(0))
            assert len(expected) > 100, (name, len(expected))
            assert found.shape == expected.shape, (name, properties, found.shape, expected.shape)
            assert numpy.array_equal(lexsorted(found), lexsorted(expected), equal_nan=True), (name, properties)
    assert shared.GetNumberOfSlabs() == (slabs if ranks > 1 or blocks > 1 else 1), (name, shared.GetNumberOfSlabs())
    if ranks > 1:
        # The process's own slabs, with 8 slices on both sides.
        own = [i for i in range(slabs) if i * ranks // slabs == rank]
        first, last = SIZE[2] * own[0] // slabs - 8, SIZE[2] * (own[-1] + 1) // slabs - 1 + 8
        assert min(s[0] for s in source.slices) >= first, (name, source.slices)
        assert max(s[1] for s in source.slices) <= last, (name, source.slices)
    if rank == 0:
        print(f"{ranks} processes, {name}: {len(found)} cells, {slabs} slabs", flush=True)


def check_hierarchy():
    """A hierarchy that all processes build together: in each, the same as one builds alone."""
    settings = dict(Isovalue=0.0, ErrorMetric=1, PreserveTopology=1, ComputeNormals=1)
    source = Source()
    builder = new(isodiamonds.vtkIsodiamondBuilder(), source, **settings)
    builder.AddPointArray("other")
    alone = new(isodiamonds.vtkIsodiamondBuilder(), Source(), NumberOfBlocks=1, **settings)
    alone.AddPointArray("other")
    for tolerance in (0.0, 0.4):
        builder.SetPreserveFeatures(tolerance > 0)
        alone.SetPreserveFeatures(tolerance > 0)
        builder.UpdatePiece(rank, ranks, 0)
        alone.Update()
        found, expected = builder.GetHierarchy().GetFieldData(), alone.GetHierarchy().GetFieldData()
        assert found.GetNumberOfArrays() == expected.GetNumberOfArrays() > 5
        for i in range(expected.GetNumberOfArrays()):
            array = expected.GetArray(i)
            if array:
                other = dataset_adapter.vtkDataArrayToVTKArray(found.GetArray(array.GetName()))
                assert numpy.array_equal(other, dataset_adapter.vtkDataArrayToVTKArray(array)), array.GetName()
        requests = len(source.slices)
        builder.UpdatePiece(rank, ranks, 0)
        assert len(source.slices) == requests
    assert builder.GetNumberOfSlabs() == ranks
    if rank == 0:
        print(f"{ranks} processes: the same hierarchy", flush=True)


def check_failure(name, fail, **properties):
    """One process fails: all have an error, and work again afterwards."""
    source = Source()
    contour = new(isodiamonds.vtkIsodiamondContour(), source, Value=(0, 0.0), ErrorTolerance=0.4, NumberOfBlocks=8,
                  **properties)
    errors = []
    for teller in (contour, source, source.GetExecutive()):
        teller.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    if rank == ranks - 1:
        fail(source, contour)
    contour.UpdatePiece(rank, ranks, 0)
    assert contour.GetOutput().GetNumberOfPoints() == 0, name
    # The process that aborts needs no error to know.
    assert errors or (rank == ranks - 1 and name.startswith("aborted")), name
    contour.UpdatePiece(rank, ranks, 0)  # executed again by all of them or by none
    source.fails_at = None
    contour.RemoveObservers("ProgressEvent")
    contour.SetAbortExecute(0)
    source.Modified()
    contour.Modified()
    found = together(contour)
    assert rank > 0 or len(found) > 100, name
    if rank == 0:
        print(f"{ranks} processes, {name}: all fail, none waits", flush=True)


def check_failure_upstream():
    """One process's source fails, behind a filter that keeps what it made before."""
    source, between = Source(), vtkImageShiftScale()
    between.SetInputConnection(source.GetOutputPort())
    contour = new(isodiamonds.vtkIsodiamondContour(), between, Value=(0, 0.0), ErrorTolerance=0.4)
    for teller in (contour, source.GetExecutive(), between.GetExecutive()):
        teller.AddObserver("ErrorEvent", lambda *_: None)
    contour.UpdatePiece(rank, ranks, 0)
    assert contour.GetOutput().GetNumberOfPoints() > 100
    if rank == ranks - 1:
        source.fails_at = len(source.slices) + 1
    source.Modified()
    contour.UpdatePiece(rank, ranks, 0)
    assert rank == ranks - 1 or contour.GetOutput().GetNumberOfPoints() == 0
    contour.UpdatePiece(rank, ranks, 0)
    assert contour.GetOutput().GetNumberOfPoints() > 100
    if rank == 0:
        print(f"{ranks} processes, no part behind a filter: none waits", flush=True)


def main():
    contour = isodiamonds.vtkIsodiamondContour
    volume = isodiamonds.vtkIsodiamondIntervalVolume
    values = dict(Value=(0, 0.0), ComputeNormals=1, ComputeGradients=1)
    check("contour", contour, [
        dict(values, ErrorTolerance=0.0), dict(ErrorTolerance=0.4), dict(ErrorTolerance=3.0),
        dict(UseRegionOfInterest=1, RegionOfInterest=(0, 20, 0, 20, 0, 40), ErrorTolerance=0.1)])
    check("contour of one tolerance", contour, [
        dict(values, OneTolerance=1, ErrorTolerance=0.4), dict(ErrorTolerance=1.0), dict(ErrorTolerance=0.0),
        dict(ErrorTolerance=0.3, Simplify=1), dict(OneTolerance=0),
        dict(OneTolerance=1, UseRegionOfInterest=1, RegionOfInterest=(0, 20, 0, 20, 0, 40), ErrorTolerance=0.1)])
    check("contour with a target", contour, [dict(values, TargetNumberOfTriangles=2000)])
    check("two contours in nine slabs", contour, [
        dict(Value=(0, 0.0)), dict(Value=(1, 4.0), MinimumPieceSize=10, ErrorTolerance=0.3),
        dict(Simplify=1)], blocks=9)
    check("contour of values that are not finite", contour,
          [dict(Value=(0, 0.0), ErrorTolerance=0.4)], has_nan=True)
    check("contour by the field metric", contour, [
        dict(values, ErrorMetric=0, ErrorTolerance=0.0), dict(ErrorTolerance=0.5), dict(ErrorTolerance=0.5, CloseBoundary=1)])
    check("closed contour", contour, [
        dict(values, CloseBoundary=1, ErrorTolerance=0.0), dict(ErrorTolerance=0.4)])
    check("interval volume", volume, [
        dict(Isorange=(-0.5, 4.0), ErrorTolerance=0.0), dict(ErrorTolerance=0.5), dict(ComputeGradients=1),
        dict(SimulationQuality=1)])
    check("interval volume with an interior tolerance", volume, [
        dict(Isorange=(-0.5, 8.0), InteriorTolerance=0.5, ErrorTolerance=0.5), dict(ErrorTolerance=0.0),
        dict(ErrorMetric=0), dict(ErrorTolerance=1.0, InteriorTolerance=3.0)])
    check_hierarchy()
    if ranks > 1:
        check_failure_upstream()
        for request in (1, 2, 3, 4):
            check_failure(f"no part {request}", lambda source, _: setattr(source, "fails_at", request))
        for phase in ("Reading signs", "Classifying diamonds", "Placing isovertices", "Measuring errors",
                      "Finding thresholds", "Reading point data", "Extracting the mesh"):
            check_failure(f"aborted while {phase}", lambda _, contour: abort_at(contour, phase))
        for name, properties in (("of one tolerance", dict(OneTolerance=1)), ("in the field", dict(ErrorMetric=0))):
            check_failure(f"aborted while Measuring errors {name}",
                          lambda _, contour: abort_at(contour, "Measuring errors"), **properties)
        for request in (1, 2, 3, 4):
            check_failure(f"no part {request} of a closed volume",
                          lambda source, _: setattr(source, "fails_at", request), CloseBoundary=1)
        check_failure("aborted while Reading the range",
                      lambda _, contour: abort_at(contour, "Reading the range"), CloseBoundary=1)


run(main)
