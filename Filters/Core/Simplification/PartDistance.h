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
 * Whole triangles are compared. Most of the original have their three points near to one triangle
 * of the simpler mesh, the one that one of them lies over, and then are as near to it; of most of
 * the simpler ones their shadow tells (ShadowTest.h). The others are cut in pieces (Covering.h).
 *
 * Of each original triangle is known which triangles it is near to, so where these have not been
 * touched it need not be looked at again; nor where all are again what they were at the start, if
 * that was near: what is near may be hard to find.
 */
class PartDistance
{
public:
  /** @param part must outlive it; its near lists are kept as they should be
   *  @param isStartNear whether its simpler mesh is known to be near, and its near lists tell to
   * what
   */
  explicit PartDistance(MeshPart& part, bool isStartNear = false);

  /** What is too far away: some of it is not what it was at the start, if that was near. */
  struct Faults
  {
    std::vector<std::uint32_t> Triangles; ///< numbers of the simpler mesh's
    std::vector<std::uint32_t> Points;    ///< of the original, gone from the simpler one
    bool Any() const { return !this->Triangles.empty() || !this->Points.empty(); }
  };

  /**
   * Compares.
   *
   * @param simple the mesh in place of the part's simpler one, by the same numbers
   * @param homes by sample: which of its triangles it lies over; None where nothing is known
   * @param isTouched by number: whether it is another triangle, or gone, since the last time
   */
  Faults Find(const LinkedTriangles& simple, const std::vector<std::uint32_t>& homes,
    const std::vector<bool>& isTouched, const ParallelFor& parallelFor = SerialFor);

private:
  class Comparison;

  /** What a thread looks at the original with. */
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
  NearLists NearAtStart;
  WorkSpaces<OriginalSpace> OriginalSpaces;
  std::vector<std::uint32_t> OriginalAt; ///< by point: one of the original's triangles, or None
};

}

#endif
