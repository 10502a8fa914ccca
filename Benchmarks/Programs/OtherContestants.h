// SPDX-License-Identifier: BSD-3-Clause
#ifndef OtherContestants_h
#define OtherContestants_h

#include "IsodiamondContestants.h"

#include "vtkFlyingEdges3D.h"

#include <memory>
#include <vector>

/**
 * @file OtherContestants.h
 * What people use: contour filters, simplification, and clipping to a range of values.
 */
namespace benchmark
{

/** vtkFlyingEdges3D without normals and scalars. */
vtkSmartPointer<vtkFlyingEdges3D> MakeFlyingEdges(const Task& task);

/** vtkFlyingEdges3D. @param threads 0 for the task's */
Contestant FlyingEdgesContestant(const Task& task, int threads = 0);

/** vtkContourFilter, also without normals and scalars: what ParaView's Contour calls. */
Contestant ContourFilterContestant(const Task& task);

/** A number of triangles, set when it is known; 0 for a tenth of the contour's. */
using Goal = std::shared_ptr<double>;

/** vtkFlyingEdges3D, then vtkQuadricDecimation. */
Contestant DecimationContestant(const Task& task, const Goal& triangles);

/** vtkFlyingEdges3D, then meshoptimizer's meshopt_simplify; none if the build did not find it. */
std::vector<Contestant> MeshOptimizerContestants(const Task& task, const Goal& triangles);

/** OpenVDB's volumeToMesh, uniform and adaptive, from a grid made beforehand (but counted in the
 *  peak memory); none if the build did not find OpenVDB. */
std::vector<Contestant> OpenVDBContestants(const Task& task);

/** What ParaView's IsoVolume does: vtkTableBasedClipDataSet twice. */
Contestant ClipContestant(const Task& task);

/** The same, then vtkDataSetTriangleFilter: tetrahedra. Slow; without a measure of memory. */
Contestant ClipToTetrahedraContestant(const Task& task);

}

#endif
