// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_StuffedVolume_h
#define vtkIsodiamond_StuffedVolume_h

#include "Mesh/IntervalExtraction.h"
#include "Private/Extraction/Mesh.h"
#include "Stuffing/NewLeaves.h"
#include "Stuffing/Stuffing.h"

#include <functional>
#include <optional>
#include <vector>

/**
 * @file StuffedVolume.h
 * Tetrahedra of good shape instead of those of an interval volume's mesh.
 */
namespace vtkIsodiamond
{

/** What is asked of tetrahedra for simulations. */
struct SimulationOptions
{
  double DistanceTolerance = 0.0; ///< the least tolerated distance from full resolution
  /** The same in a triangle or tetrahedron, given its corners in the world; empty to not
   *  measure. */
  std::function<double(const isodiamond::Vector* corners, int count)> ToleranceIn = nullptr;
  bool GetsCoarser = true;  ///< whether tolerances are used, or only measured
  bool KeepsInside = false; ///< whether points on no surface stay
  /** The volume that a mesh not for simulations has at the whole tolerance; none if the mesh does
   *  not get coarser. */
  std::optional<double> VolumeAtTolerance = {};
  bool MayRefine = true;                  ///< whether FarDiamonds() are looked for
  bool MayPin = true;                     ///< whether TightVertices() are looked for
  std::vector<std::uint64_t> Pinned = {}; ///< see isodiamond::Pin()
};

/**
 * The interval volume of a refined set, stuffed (see Stuffing/Stuffing.h). If diamonds have to be
 * refined, or vertices pinned, first, it says which, and has no mesh.
 */
class StuffedVolume
{
public:
  /** @param refined must outlive it
   *  @param known changes of this mesh before it was last refined, which are updated; or null */
  StuffedVolume(const isodiamond::RefinedSet& refined, const MeshOptions& options,
    const SimulationOptions& simulation, const isodiamond::ParallelFor& parallelFor,
    isodiamond::KnownChanges* known);

  /** Those that have to be refined because surfaces are too far away. */
  std::vector<isodiamond::Place> FarDiamonds() const;

  ///@{
  /** Each once, as PackedPoint(), sorted: the vertices that have to be pinned, as surfaces are too
   *  far away where nothing can be refined; and all that are near bad tetrahedra. */
  std::vector<std::uint64_t> TightVertices() const;
  std::vector<std::uint64_t> VerticesNearBad() const;
  ///@}

  /** Whether there is no room for good angles nearly anywhere. */
  bool IsHopeless() const { return this->Stuffed.IsHopeless; }

  /** Its points and cells, with their data: those of moved and added points are interpolated
   *  linearly in the interval volume's mesh. @pre there are no far diamonds or tight vertices */
  Mesh Write(const MeshOptions& options, const isodiamond::ParallelFor& parallelFor) const;

private:
  const isodiamond::IsodiamondHierarchy& Hierarchy;
  isodiamond::IntervalExtraction Extraction;
  isodiamond::CutMesh Leaves;
  isodiamond::StuffedMesh Stuffed;
};

/**
 * Looks for the diamonds that have to be refined because stuffed leaves would be too far away, in
 * one refined set after the other; only where these differ. That takes much less time than a
 * StuffedVolume, which then finds the few others.
 */
class FarDiamondSearch
{
public:
  std::vector<isodiamond::Place> Find(const isodiamond::RefinedSet& refined,
    const MeshOptions& options, const SimulationOptions& simulation,
    const isodiamond::ParallelFor& parallelFor);

private:
  isodiamond::NewLeaves News;
};

}

#endif
