// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MidpointOrder_h
#define isodiamond_MidpointOrder_h

#include "DiamondTables.h"

#include <vector>

namespace isodiamond
{

/**
 * The lattice points of a small diamond's domain, each after two points whose midpoint it is.
 *
 * Bisecting the tetrahedra again and again meets every lattice point as the middle of an edge that
 * lies in one of them. There the diamond's interpolant is the mean of its values at the ends, so
 * that walking along the list gives all its values at the cost of an addition each.
 */
class MidpointOrder
{
public:
  /** Largest scale with a table. */
  static constexpr int MaximumScale = 3;

  static constexpr int MaximumCount = 4913;

  struct Entry
  {
    std::array<std::int8_t, 3> Offset{}; ///< from the central vertex
    std::array<std::uint16_t, 2> Ends{}; ///< indices of earlier entries
  };

  /** The table of a diamond's shape and scale, the diamond's vertices first. */
  static const MidpointOrder& Of(const Place& place);

  int VertexCount() const { return this->Vertices; }
  const std::vector<Entry>& Entries() const { return this->List; }

private:
  MidpointOrder() = default;
  MidpointOrder(const TypeTable& type, int scale);

  class Builder;

  int Vertices = 0;
  std::vector<Entry> List;
};

}

#endif
