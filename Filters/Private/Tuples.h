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
 * Some of what a mesh has for each point or cell: copies, in the order of the ids of what is kept.
 * VTK's own (GetPoints, CopyData) would end the program where there is no memory, see Arrays.h.
 */
namespace vtkIsodiamond
{

/** Points with some ids. @throws std::bad_alloc */
vtkSmartPointer<vtkPoints> PointsOf(vtkPoints* points, const std::vector<vtkIdType>& ids);

/** Leaves of a mesh's attributes, whose arrays are data arrays, the tuples with some ids.
 *  @throws std::bad_alloc */
void KeepTuples(vtkDataSetAttributes* data, const std::vector<vtkIdType>& ids);

}

#endif
