// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Coarsening.h"

#include "Simplification/PartDistance.h"
#include "Simplification/SelfIntersections.h"
#include "Simplification/SimplerPart.h"
#include "Stuffing/MeasuredSurfaces.h"
#include "Stuffing/TetrahedronCollapses.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** The least distance in degrees of the tetrahedra's dihedral angles from 0 and from 180, unless
 *  what they replace has worse ones. The less, the fewer tetrahedra. */
constexpr double LeastAngle = 16.0;

/** Passes over the inside and the surfaces; what one leaves lets the other go on. */
constexpr int CollapsePasses = 6;

/** How often edges inside that could not collapse are tried again, where points have moved. */
constexpr int RelaxationRounds = 2;

/** See FarLeaves(). @param distance of the surfaces' part, which is measured */
std::vector<std::uint32_t> FarLeavesOf(const MeasuredSurfaces& surfaces, PartDistance& distance,
  const std::vector<bool>& canBeNearer, const ParallelFor& parallelFor)
{
  const PartDistance::Faults faults = distance.Find(surfaces.Part.Simple, surfaces.Homes(),
    std::vector<bool>(surfaces.Part.Simple.Triangles.size(), true), parallelFor);
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t i = 0; i < surfaces.Part.Original.Triangles.size(); ++i)
  {
    if (surfaces.Part.Near[i].empty())
    {
      leaves.push_back(surfaces.Origins[i]); // nothing is near to it
    }
  }
  for (const std::uint32_t triangle : faults.Triangles)
  {
    leaves.push_back(surfaces.SimpleOrigins[triangle]);
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                 [&](std::uint32_t leaf) { return !canBeNearer[leaf]; }),
    leaves.end());
  return leaves;
}

}

std::vector<std::uint32_t> FarLeaves(
  const TetrahedronMesh& mesh, const CoarseningInput& input, const ParallelFor& parallelFor)
{
  if (std::find(input.CanBeNearer.begin(), input.CanBeNearer.end(), true) ==
    input.CanBeNearer.end())
  {
    return {};
  }
  MeasuredSurfaces surfaces(input.Plain, mesh, input.Allowances, parallelFor);
  if (!surfaces.AreSound)
  {
    return {};
  }
  PartDistance distance(surfaces.Part);
  return FarLeavesOf(surfaces, distance, input.CanBeNearer, parallelFor);
}

std::vector<std::uint32_t> Coarsen(
  TetrahedronMesh& mesh, const CoarseningInput& input, const ParallelFor& parallelFor)
{
  MeasuredSurfaces surfaces(input.Plain, mesh, input.Allowances, parallelFor);
  MeshPart& part = surfaces.Part;
  if (!surfaces.AreSound)
  {
    return {};
  }
  PartDistance distance(part);
  if (std::vector<std::uint32_t> far =
        FarLeavesOf(surfaces, distance, input.CanBeNearer, parallelFor);
      !far.empty())
  {
    return far;
  }

  const double plain = VolumeOf(input.Plain);
  const double other = input.VolumeAtTolerance.value_or(plain);
  TetrahedronCollapses tetrahedra(
    std::move(mesh), LeastAngle, { std::min(other, plain), std::max(other, plain) });
  const SelfIntersections intersections(part);
  EdgeCollapses edges(part, input.UsedPart, &tetrahedra);
  std::vector<bool> isTouched;
  std::size_t before = 0;
  for (int pass = 0; pass < CollapsePasses && (pass == 0 || tetrahedra.Count() > 1.01 * before);
       ++pass)
  {
    before = tetrahedra.Count();
    if (!input.KeepsInside)
    {
      tetrahedra.CollapseInside(parallelFor);
    }
    parallelFor(1, 1, [&](std::int64_t, std::int64_t) { isTouched = edges.Run(); });
  }
  // What cannot be nearer may be too far away as it was.
  UndoWhatIsWrong(intersections, distance, std::move(isTouched), edges, parallelFor);
  // All that is left to do changes only the inside, and nothing has to be undone any more.
  if (!input.KeepsInside)
  {
    tetrahedra.RelaxInside(input.Axes, parallelFor);
    for (int round = 0; round < RelaxationRounds; ++round)
    {
      tetrahedra.CollapseInside(parallelFor);
      tetrahedra.RelaxInside(input.Axes, parallelFor);
    }
  }
  mesh = tetrahedra.Take();
  return {};
}

}
