// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PartBorders_h
#define isodiamond_PartBorders_h

#include "Simplification/BoundsTree.h"
#include "Simplification/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * Where parts of a mesh that are simplified on their own might get through each other.
 *
 * What a part has stays within the bounds of its triangles, as no point is new. There it has to
 * know what other parts have (Others); it cannot know what they are about to make. So new triangles
 * are compared afterwards (Meeting), and parts that meet are made again, which is rare.
 */
class PartBorders
{
public:
  /** By number; the first point is None if a triangle is gone. */
  using Triangles = std::vector<Triangle>;

  /** @param positions of the points, must outlive it
   *  @param parts their triangles at the start; what stays as it is may be a part, too */
  PartBorders(const std::vector<Vector>& positions, std::vector<Triangles> parts);

  /** Says what a part has become. */
  void Set(std::uint32_t part, Triangles triangles) { this->Now[part] = std::move(triangles); }

  /** For each of some parts, the triangles of other parts in its bounds. */
  std::vector<Triangles> Others(const std::vector<std::uint32_t>& parts) const;

  /** Which of some parts, ascending, have new triangles that intersect new ones of a part with a
   * smaller number. These get back what they had at the start. */
  std::vector<std::uint32_t> Meeting(const std::vector<std::uint32_t>& parts);

private:
  /** A new triangle that is in the bounds of another part. */
  struct Stray
  {
    std::uint32_t Part;
    Triangle Points;
  };
  std::vector<Stray> Strays(const std::vector<std::uint32_t>& parts) const;
  template <typename Visit>
  void ForEachPartAt(std::uint32_t part, const Triangle& triangle, Visit&& visit) const;

  const std::vector<Vector>& Positions;
  std::vector<Triangles> Start;
  std::vector<Triangles> Now;
  BoundsTree Reach; ///< of the parts
};

}

#endif
