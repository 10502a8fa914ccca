# SPDX-License-Identifier: BSD-3-Clause
"""Dihedral angles of tetrahedral meshes: pvpython dihedral_angles.py MESH.vtu...

Prints the least and the greatest angle of each mesh, in degrees, and how its angles are
distributed. An equilateral tetrahedron has six of 70.5 degrees; solvers want none near 0 or 180.
"""
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

BOUNDS = (0, 5, 10, 20, 30, 45, 60, 90, 120, 135, 150, 160, 170, 175, 180)
AT_ONCE = 1_000_000  # tetrahedra


def dihedral_angles(corners):
    """Six angles, in degrees, for each of n tetrahedra given as (n, 4, 3) coordinates."""
    angles = []
    for i in range(4):
        for j in range(i + 1, 4):
            k, m = (v for v in range(4) if v not in (i, j))
            edge = corners[:, j] - corners[:, i]
            # Normals of the two faces at the edge, with the same angle between them as the faces.
            first = numpy.cross(edge, corners[:, k] - corners[:, i])
            second = numpy.cross(edge, corners[:, m] - corners[:, i])
            across = numpy.linalg.norm(numpy.cross(first, second), axis=1)
            along = numpy.einsum("ij,ij->i", first, second)
            angles.append(numpy.degrees(numpy.arctan2(across, along)))
    return numpy.stack(angles, axis=1)


def report(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    count = mesh.GetNumberOfCells()
    ids = vtk_to_numpy(mesh.GetCells().GetConnectivityArray())
    if count == 0 or ids.size != 4 * count:
        sys.exit(f"dihedral_angles.py: '{path}' is not a mesh of tetrahedra")
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    histogram = numpy.zeros(len(BOUNDS) - 1, dtype=int)
    least, greatest = 180.0, 0.0
    for begin in range(0, count, AT_ONCE):
        corners = points[ids[4 * begin : 4 * (begin + AT_ONCE)].reshape(-1, 4)]
        angles = dihedral_angles(corners)
        least = min(least, angles.min())
        greatest = max(greatest, angles.max())
        histogram += numpy.histogram(angles, BOUNDS)[0]
    print(f"{path}: {count:,} tetrahedra, dihedral angles from {least:.3f} to {greatest:.3f}")
    for low, high, number in zip(BOUNDS, BOUNDS[1:], histogram):
        print(f"  {low:3} - {high:3}: {100 * number / histogram.sum():6.2f} %")


if len(sys.argv) < 2:
    sys.exit(__doc__)
for argument in sys.argv[1:]:
    report(argument)
