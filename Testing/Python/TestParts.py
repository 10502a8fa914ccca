# SPDX-License-Identifier: BSD-3-Clause
"""In pvbatch with two or four processes: a source that gives a part of an image in each process,
whatever it is asked for, as a simulation does. Together the processes have the mesh that one makes
of the whole, to the bit. Parts that do not make a whole are an error in all processes."""
import numpy

import isodiamonds
from ParallelTestTools import SIZE, Source, abort_at, lexsorted, new, rank, ranks, rows, run, together


def slabs_of(axis, shared):
    """This process's slab across an axis. @param shared whether neighbours share samples"""
    bounds = [(SIZE[axis] - 1) * i // ranks for i in range(ranks + 1)]
    part = [bound for length in SIZE for bound in (0, length - 1)]
    part[2 * axis] = bounds[rank] + (0 if shared or rank == 0 else 1)
    part[2 * axis + 1] = bounds[rank + 1]
    return part


def boxes():
    """This process's box. The boxes form no grid: a plane between two may end at a third."""
    x, y, z = (length - 1 for length in SIZE)
    parts = {
        2: [[0, x, 0, y, 0, 9], [0, x, 0, y, 9, z]],
        4: [[0, 11, 0, y, 0, 33], [11, x, 0, y, 0, 33], [0, x, 0, 21, 33, z], [0, x, 21, y, 33, z]],
    }
    return parts[ranks][rank]


def check(name, make, part, slabs, ghosts=0, blanks=False, **properties):
    source, whole = Source(), Source()
    source.have(part, ghosts)
    source.blanks = whole.blanks = blanks
    shared = new(make(), source, **properties)
    for tolerance in (0.0, 0.4):
        shared.SetErrorTolerance(tolerance)
        found = together(shared)
        if rank == 0:
            alone = new(make(), whole, **dict(properties, NumberOfBlocks=1))
            alone.SetErrorTolerance(tolerance)
            alone.Update()
            expected = rows(alone.GetOutputDataObject(0))
            assert len(expected) > 100, (name, len(expected))
            assert found.shape == expected.shape, (name, tolerance, found.shape, expected.shape)
            assert numpy.array_equal(lexsorted(found), lexsorted(expected)), (name, tolerance)
    assert shared.GetNumberOfSlabs() == slabs, (name, shared.GetNumberOfSlabs())
    if rank == 0:
        print(f"{ranks} processes, {name}: {len(found)} cells", flush=True)


def check_hierarchy(part):
    settings = dict(Isovalue=0.0, ErrorMetric=1, PreserveTopology=1)
    source = Source()
    source.have(part)
    for model, metric in ((2, 1), (1, 0), (0, 0)):
        settings.update(Model=model, ErrorMetric=metric)
        builder = new(isodiamonds.vtkIsodiamondBuilder(), source, **settings)
        builder.UpdatePiece(rank, ranks, 0)
        alone = new(isodiamonds.vtkIsodiamondBuilder(), Source(), NumberOfBlocks=1, **settings)
        alone.Update()
        found, expected = builder.GetHierarchy().GetFieldData(), alone.GetHierarchy().GetFieldData()
        assert found.GetNumberOfArrays() == expected.GetNumberOfArrays() > 5
        for i in range(expected.GetNumberOfArrays()):
            array, other = expected.GetArray(i), found.GetArray(expected.GetAbstractArray(i).GetName())
            if array:
                assert array.GetNumberOfValues() == other.GetNumberOfValues(), array.GetName()
                assert memoryview(array).tobytes() == memoryview(other).tobytes(), array.GetName()
    if rank == 0:
        print(f"{ranks} processes: the same hierarchies", flush=True)


def check_refused(name, part, message, change=lambda source: None):
    source = Source()
    source.have(part)
    change(source)
    contour = new(isodiamonds.vtkIsodiamondContour(), source, Value=(0, 0.0), ErrorTolerance=0.4)
    errors = []
    observer = lambda caller, event, text: errors.append(text)
    observer.CallDataType = "string0"
    contour.AddObserver("ErrorEvent", observer)
    for _ in range(2):
        contour.UpdatePiece(rank, ranks, 0)
        assert contour.GetOutput().GetNumberOfPoints() == 0, name
        contour.Modified()
    assert errors and all(message in error for error in errors), (name, errors)
    if rank == 0:
        print(f"{ranks} processes, {name}: refused", flush=True)


def check_change(part):
    """One process's part changes while all are asked for another tolerance: all build anew."""
    source, whole = Source(), Source()
    source.have(part)
    contour = new(isodiamonds.vtkIsodiamondContour(), source, Value=(0, 0.0), ErrorTolerance=0.4)
    contour.UpdatePiece(rank, ranks, 0)
    if rank == 0:
        source.sign = -1
        source.Modified()
    contour.SetErrorTolerance(0.5)
    changed = together(contour)
    assert contour.GetNumberOfBuilds() == 2, contour.GetNumberOfBuilds()
    if rank == 0:
        new(alone := isodiamonds.vtkIsodiamondContour(), whole, Value=(0, 0.0), ErrorTolerance=0.5).Update()
        assert len(changed) != len(rows(alone.GetOutput())), len(changed)
        print(f"{ranks} processes: all build anew", flush=True)


def check_abortion(phase, part, process):
    """One process aborts: all have an empty mesh, and the whole one afterwards."""
    source = Source()
    source.have(part)
    contour = new(isodiamonds.vtkIsodiamondContour(), source, Value=(0, 0.0), ErrorTolerance=0.4, ComputeNormals=1)
    contour.AddObserver("ErrorEvent", lambda *_: None)
    if rank == process:
        abort_at(contour, phase)
    for _ in range(2):
        contour.UpdatePiece(rank, ranks, 0)
        assert contour.GetOutput().GetNumberOfPoints() == 0, phase
    contour.RemoveObservers("ProgressEvent")
    contour.SetAbortExecute(0)
    found = together(contour)
    assert rank > 0 or len(found) > 100, phase
    if rank == 0:
        print(f"{ranks} processes, aborted while {phase}: all end", flush=True)


def main():
    contour, volume = isodiamonds.vtkIsodiamondContour, isodiamonds.vtkIsodiamondIntervalVolume
    value = dict(Value=(0, 0.0))
    for axis in range(3):
        for shared in (False, True):
            check(f"slabs across axis {axis}, shared {shared}", contour, slabs_of(axis, shared), slabs=ranks,
                  ComputeNormals=1, **value)
    check("boxes with ghosts", contour, boxes(), ghosts=2, slabs=ranks, ComputeGradients=1, **value)
    check("boxes in nine slabs", contour, boxes(), slabs=9, NumberOfBlocks=9, Simplify=1, **value)
    check("at once", contour, boxes(), slabs=1, NumberOfBlocks=1, **value)
    check("field metric", contour, boxes(), ghosts=1, slabs=ranks, ErrorMetric=0, **value)
    check("closed boundary", contour, slabs_of(0, False), slabs=ranks, CloseBoundary=1, **value)
    check("blanked cells", contour, boxes(), ghosts=1, blanks=True, slabs=1, **value)
    check("interval volume", volume, boxes(), ghosts=1, slabs=ranks, Isorange=(-0.5, 4.0))
    check("interior tolerance", volume, slabs_of(1, True), slabs=ranks, Isorange=(-0.5, 4.0), InteriorTolerance=2.0)
    check_hierarchy(boxes())
    narrow = slabs_of(2, True)
    narrow[1] -= rank == ranks - 1
    check_refused("a part that leaves a column out", narrow, "leave some of it out")
    check_refused("another place", slabs_of(2, True), "do not fit",
                  lambda source: setattr(source, "origin", (rank, 0, 0)))
    check_change(slabs_of(2, True))
    for phase in ("Reading signs", "Placing isovertices", "Reading point data", "Extracting the mesh"):
        check_abortion(phase, slabs_of(2, True), ranks - 1)
    check_abortion("Reading signs", slabs_of(2, True), 0)


run(main)
