// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PartDistance_h
#define isodiamond_PartDistance_h

#include "Simplification/Covering.h"
#include "Simplification/MeshPart.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * Finds where a simpler mesh is too far from the original, both ways, or turned over.
 *
 * Whole triangles are compared (Covering.h). Of each original triangle is known which triangles
 * it is near to, so where these have not been touched it need not be looked at again.
 */
class PartDistance
{
public:
  /** @param part must outlive it; its near lists are kept as they should be */
  explicit PartDistance(MeshPart& part);

  /** Whether the original can be walked over. */
  bool IsSound() const { return this->Links.FaultyPoints().empty(); }

  /** What is too far away. */
  struct Faults
  {
    std::vector<std::uint32_t> Triangles; ///< numbers of the simpler mesh's
    std::vector<std::uint32_t> Points;    ///< of the original, gone from the simpler one
    bool Any() const { return !this->Triangles.empty() || !this->Points.empty(); }
  };

  /**
   * Compares.
   *
   * @param simple triangles on the points of the original
   * @param numbers that these go by: in the near lists, and in what was touched
   * @param isTouched by number: whether it is another triangle, or gone, since the last time
   */
  Faults Find(const std::vector<Triangle>& simple, const std::vector<std::uint32_t>& numbers,
    const std::vector<bool>& isTouched);

private:
  class Comparison;

  MeshPart& Part;
  Connectivity Links;
  Covering Cover;
};

}

#endif
