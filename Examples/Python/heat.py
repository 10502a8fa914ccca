#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Heat in an interval volume: python3 heat.py VOLUME.vtu [TEMPERATURE.vtu]

VOLUME.vtu is made by Isodiamond Interval Volume or Isodiamond Extract, best with Simulation
Quality, and saved with data mode Binary or Ascii. Each unit of volume generates one unit of heat;
the surfaces are kept at 0 degrees, and nothing passes through the walls of the image. Prints how
many steps the method of conjugate gradients needs, and writes the temperature. Needs getfem, meshio
and SciPy (Debian: python3-getfem python3-meshio python3-scipy), but neither ParaView nor VTK.
"""
import inspect
import os
import sys
import tempfile

import getfem
import meshio
import numpy
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree


def linear_system(points, tetrahedra):
    """Stiffness and load of linear elements, and the position of each unknown."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "volume.msh")
        meshio.write(name, meshio.Mesh(points, [("tetra", tetrahedra)]), "gmsh22", binary=False)
        mesh = getfem.Mesh("import", "gmsh", name)
    elements = getfem.MeshFem(mesh, 1)
    elements.set_fem(getfem.Fem("FEM_PK(3,1)"))
    rule = getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(2)"))
    zero = numpy.zeros(elements.nbdof())
    unknown = (-1, "u", 1, elements, zero)
    stiffness = getfem.asm_generic(rule, 2, "Grad_u.Grad_Test_u", *unknown)
    load = getfem.asm_generic(rule, 1, "Test_u", *unknown)
    first, rows = stiffness.csc_ind()
    shape = (zero.size, zero.size)
    matrix = csc_matrix((stiffness.csc_val(), rows, first), shape=shape)
    return matrix, load, elements.basic_dof_nodes().T


if len(sys.argv) not in (2, 3):
    sys.exit(__doc__)
getfem.util_trace_level(level=0)
volume = meshio.read(sys.argv[1])
if "tetra" not in volume.cells_dict or "Surface" not in volume.point_data:
    sys.exit(f"heat.py: '{sys.argv[1]}' is no interval volume")
tetrahedra = volume.cells_dict["tetra"]
matrix, load, places = linear_system(volume.points, tetrahedra)
_, point = cKDTree(volume.points).query(places)  # getfem renumbers the points
free = volume.point_data["Surface"][point] == 0

steps = 0


def count(_):
    global steps
    steps += 1


relative = "rtol" if "rtol" in inspect.signature(cg).parameters else "tol"  # until SciPy 1.12
solution, info = cg(matrix[free][:, free].tocsr(), load[free], callback=count, **{relative: 1e-8})
if info != 0:
    sys.exit("heat.py: no solution was found")
temperature = numpy.zeros(len(volume.points))
temperature[point[free]] = solution
print(f"{sys.argv[1]}: {len(tetrahedra):,} tetrahedra, {solution.size:,} unknowns, "
      f"{steps} steps, at most {temperature.max():.2f} degrees")
if len(sys.argv) == 3:
    meshio.write(sys.argv[2], meshio.Mesh(volume.points, [("tetra", tetrahedra)],
                                          point_data={"Temperature": temperature}))
