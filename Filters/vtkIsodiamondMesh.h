// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondMesh_h
#define vtkIsodiamondMesh_h

#include "AffineMap.h"
#include "RefinedSet.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkCellArray;
class vtkFloatArray;
class vtkPoints;
class vtkSignedCharArray;
class vtkUnstructuredGrid;

namespace vtkIsodiamond
{

/** An extracted isosurface as VTK arrays. */
struct Surface
{
  vtkSmartPointer<vtkPoints> Points;          ///< world positions, float
  vtkSmartPointer<vtkCellArray> Triangles;    ///< 32-bit storage where ids fit
  vtkSmartPointer<vtkSignedCharArray> Levels; ///< "Level", one a triangle
};

/** Extracts a surface. Runs in the calling thread's vtkSMPTools scope, like all of these. */
Surface ExtractSurface(const isodiamond::RefinedSet& refined, const isodiamond::AffineMap& world);

/** The isovalue at every point, under the name of the input's array. */
vtkSmartPointer<vtkFloatArray> ConstantScalars(
  const std::string& name, std::int64_t count, double isovalue);

/** Extracts an isosurface or interval volume with all of its point and cell data. */
void ExtractMesh(const isodiamond::RefinedSet& refined, const isodiamond::AffineMap& world,
  const std::string& arrayName, vtkUnstructuredGrid* output);

}

#endif
