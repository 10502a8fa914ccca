# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra of what lies above an isovalue, by Isodiamonds and by CGAL's Mesh_3.

Isodiamonds' are plain and with SimulationQuality; CGAL's are of the same samples.

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/tetrahedra.py VOLUME:ISOVALUE \\
      [--tolerances 2,1,0.5] [--cgal 0.5:3,0.2:1.5] [--mesher build/bin/IsodiamondCGALMesher]

VOLUME is a raw file of bytes, NAME_XxYxZ_uint8.raw, whose surface does not reach its boundary.
Tolerances, and CGAL's facet distance and size, are in voxels. Seconds are those of one thread: of
building the hierarchy, which serves all tolerances, and of each mesh; for CGAL, of meshing and of
optimizing (perturb, exude). The mesher is built if CGAL is found (Debian's libcgal-dev).
"""
import argparse
import os
import subprocess
import tempfile
import time

import numpy
from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from meshmeasures import Mesh, NearestTriangle, deviation_of_mesh, deviation_of_points, topology
from volumes import raw_volume
from vtkmodules.util.numpy_support import vtk_to_numpy

FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def arrays_of(grid):
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def read_medit(path):
    """Points and tetrahedra in a file of Medit's format."""
    with open(path) as file:
        words = iter(file.read().split())
    found = {}
    for word in words:
        columns = {"Vertices": 4, "Triangles": 4, "Tetrahedra": 5}.get(word)
        if columns:
            count = int(next(words))
            numbers = [float(next(words)) for _ in range(count * columns)]
            found[word] = numpy.array(numbers).reshape(count, columns)
    used, cells = numpy.unique(found["Tetrahedra"][:, :4].astype(int) - 1, return_inverse=True)
    return found["Vertices"][used, :3], cells.reshape(-1, 4)


def surface_of(points, cells):
    """The faces that belong to only one tetrahedron."""
    faces = numpy.concatenate([cells[:, face] for face in FACES])
    _, first, counts = numpy.unique(
        numpy.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    return Mesh(points, faces[first[counts == 1]])


def dihedral_angles(points, cells):
    """The smallest and the largest angle of each tetrahedron, in degrees."""
    corners = points[cells]
    normals = []
    for face in FACES:
        a, b, c = (corners[:, i] for i in face)
        normal = numpy.cross(b - a, c - a)
        normals.append(normal / numpy.linalg.norm(normal, axis=1)[:, None])
    pairs = [(i, j) for i in range(4) for j in range(i + 1, 4)]
    cosines = numpy.stack([-(normals[i] * normals[j]).sum(axis=1) for i, j in pairs], axis=1)
    angles = numpy.degrees(numpy.arccos(cosines.clip(-1, 1)))
    return angles.min(axis=1), angles.max(axis=1)


def print_row(name, points, cells, full, seconds):
    smallest, largest = dihedral_angles(points, cells)
    surface = surface_of(points, cells)
    there, _ = deviation_of_points(full.mesh.points, surface)
    back, _, _ = deviation_of_mesh(surface, full)
    print(
        f"| {name} | {len(cells):,} | {len(surface.triangles):,} | {smallest.min():.1f} -"
        f" {largest.max():.0f} | {100 * (smallest < 15).mean():.2f} | {there.rms:.3f} /"
        f" {there.maximum:.2f} | {back.rms:.3f} / {back.maximum:.2f} |"
        f" {topology(surface).pieces} | {seconds} |",
        flush=True,
    )


def timed(algorithm):
    start = time.perf_counter()
    algorithm.Update()
    return time.perf_counter() - start


def isodiamonds(image, isovalue, tolerances):
    builder = vtkIsodiamondBuilder()
    builder.SetInputData(image)
    builder.SetShapeToIntervalVolume()
    builder.SetIsorange(isovalue, float("inf"))
    builder.SetErrorMetricToDistance()
    builder.PreserveTopologyOn()
    builder.SetNumberOfThreads(1)
    building = timed(builder)
    extractor = vtkIsodiamondExtractor()
    extractor.SetInputConnection(builder.GetOutputPort())
    extractor.SetNumberOfThreads(1)
    extractor.Update()
    full = NearestTriangle(surface_of(*arrays_of(extractor.GetOutput())))
    for tolerance in tolerances:
        for quality in (False, True):
            extractor.SetErrorTolerance(tolerance)
            extractor.SetSimulationQuality(quality)
            seconds = timed(extractor)
            name = f"{tolerance:g}, " + ("SimulationQuality" if quality else "plain")
            points, cells = arrays_of(extractor.GetOutput())
            print_row(name, points, cells, full, f"{building:.2f} + {seconds:.3f}")
    return full


def cgal(mesher, image, isovalue, full, distance, size):
    dims = image.GetDimensions()
    samples = vtk_to_numpy(image.GetPointData().GetScalars()).astype(numpy.float32)
    with tempfile.TemporaryDirectory() as folder:
        source, result = os.path.join(folder, "samples.raw"), os.path.join(folder, "cgal.mesh")
        samples.tofile(source)
        command = [mesher, source, *dims, isovalue, distance, size, result]
        seconds = subprocess.run(
            [str(word) for word in command], check=True, capture_output=True, text=True
        ).stdout.split()
        points, cells = read_medit(result)
    name = f"CGAL, distance {distance:g}, size {size:g}"
    print_row(name, points, cells, full, " + ".join(f"{float(s):.1f}" for s in seconds))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("volume")
    parser.add_argument("--tolerances", default="2,1,0.5")
    parser.add_argument("--cgal", default="0.5:3,0.2:1.5")
    parser.add_argument("--mesher", default="build/bin/IsodiamondCGALMesher")
    options = parser.parse_args()
    name, image, isovalue = raw_volume(options.volume)
    print(f"{name} above {isovalue:g}; lengths in voxels, angles in degrees\n")
    print(
        "| | tetrahedra | surface triangles | angles | cells below 15, % | full -> mesh: rms / max"
        " | mesh -> full: rms / max | pieces | seconds |\n|---|---:|---:|---|---:|---|---|---:|---:|"
    )
    full = isodiamonds(image, isovalue, [float(t) for t in options.tolerances.split(",")])
    if not os.path.exists(options.mesher):
        print(f"\nNo {options.mesher}: without CGAL.")
        return
    for pair in options.cgal.split(","):
        distance, size = map(float, pair.split(":"))
        cgal(options.mesher, image, isovalue, full, distance, size)


main()
