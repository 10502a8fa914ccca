// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Tuples_h
#define vtkIsodiamond_Tuples_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkDataSetAttributes;
class vtkPoints;

/**
 * @file Tuples.h
 * Copies of some of a mesh's data per point or cell, in the order of the ids that are kept. VTK's
 * own functions (GetPoints, CopyData) would end the program where there is no memory, see Arrays.h.
 */
namespace vtkIsodiamond
{

/** The points with given ids. @throws std::bad_alloc */
vtkSmartPointer<vtkPoints> PointsOf(vtkPoints* points, const std::vector<vtkIdType>& ids);

/** Keeps, of a mesh's attributes, whose arrays are all data arrays, the tuples with given ids.
 *  @throws std::bad_alloc */
void KeepTuples(vtkDataSetAttributes* data, const std::vector<vtkIdType>& ids);

}

#endif
