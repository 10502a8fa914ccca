// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PartDistance_h
#define isodiamond_PartDistance_h

#include "Field/Parallel.h"
#include "Field/WorkSpaces.h"
#include "Simplification/Covering.h"
#include "Simplification/MeshPart.h"
#include "Simplification/ShadowTest.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace isodiamond
{

/**
 * Finds where a simpler mesh is too far from the original, both ways, or turned over.
 *
 * Whole triangles are compared. Most of the original have all three points near to one triangle of
 * the simpler mesh, the one that one of the points lies over, and so are as near to it; most of the
 * simpler ones are settled by a shadow (ShadowTest.h). The others are cut into pieces (Covering.h).
 *
 * For each original triangle it is known which triangles it is near to. It need not be looked at
 * again if these have not been touched; nor if they all are again what they were at the start, and
 * the start was near: what is near may be hard to find.
 */
class PartDistance
{
public:
  /** @param part must outlive it; its near lists are kept up to date
   *  @param isStartNear whether its simpler mesh is known to be near, and its near lists say what
   * is near to what
   *  @param mayTurnOver whether a triangle that is near may face the other way
   */
  explicit PartDistance(MeshPart& part, bool isStartNear = false, bool mayTurnOver = false);

  /** What is too far away. If the start was near, some of it has changed since. */
  struct Faults
  {
    std::vector<std::uint32_t> Triangles; ///< numbers in the simpler mesh
    std::vector<std::uint32_t> Points;    ///< of the original, gone from the simpler one
    bool Any() const { return !this->Triangles.empty() || !this->Points.empty(); }
  };

  /**
   * Compares.
   *
   * @param simple the mesh to compare in place of the part's simpler one, with the same numbers
   * @param homes by sample: which triangle of that mesh it lies over; None if unknown
   * @param isTouched by number: whether a triangle has changed, or gone, since the last time
   */
  Faults Find(const LinkedTriangles& simple, const std::vector<std::uint32_t>& homes,
    const std::vector<bool>& isTouched, const ParallelFor& parallelFor = SerialFor);

private:
  class Comparison;

  /** What a thread uses to look at the original. */
  struct OriginalSpace
  {
    explicit OriginalSpace(const MeshPart& part)
      : Cover(part.Positions, part.Original)
      , Shadow(part.Positions, part.Original, part.Allowances)
    {
    }

    Covering Cover;
    ShadowTest Shadow;
  };

  MeshPart& Part;
  bool IsStartNear;
  bool MayTurnOver;
  NearLists NearAtStart;
  WorkSpaces<OriginalSpace> OriginalSpaces;
  std::vector<std::uint32_t> OriginalAt; ///< by point: one of the original's triangles, or None
};

}

#endif
