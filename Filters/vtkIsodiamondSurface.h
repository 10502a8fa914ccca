// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondSurface_h
#define vtkIsodiamondSurface_h

#include "AffineMap.h"
#include "IsodiamondHierarchy.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkCellArray;
class vtkFloatArray;
class vtkPoints;
class vtkSignedCharArray;

namespace vtkIsodiamond
{

/** An extracted isosurface as VTK arrays. */
struct Surface
{
  vtkSmartPointer<vtkPoints> Points;          ///< world positions, float
  vtkSmartPointer<vtkCellArray> Triangles;    ///< 32-bit storage where ids fit
  vtkSmartPointer<vtkSignedCharArray> Levels; ///< "Level", one a triangle
};

/** Extracts a surface from an RI or MI. Runs on the calling thread's vtkSMPTools scope. */
Surface ExtractSurface(const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::AffineMap& world, double tolerance);

/** The isovalue at every point, under the name of the input's array. */
vtkSmartPointer<vtkFloatArray> ConstantScalars(
  const std::string& name, std::int64_t count, double isovalue);

}

#endif
