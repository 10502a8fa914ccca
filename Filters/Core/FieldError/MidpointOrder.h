// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MidpointOrder_h
#define isodiamond_MidpointOrder_h

#include "Lattice/DiamondTables.h"

#include <vector>

namespace isodiamond
{

/**
 * The lattice points of a small diamond's domain, each after the two others it lies midway between.
 *
 * Bisecting the diamond's tetrahedra repeatedly reaches all of them, each as the middle of an edge
 * inside one tetrahedron. There the diamond's interpolant is the mean of its values at the edge's
 * ends: along the list, each of its values costs one addition.
 */
class MidpointOrder
{
public:
  static constexpr int MaximumScale = 3;
  /** Points of the largest domain, a cube. */
  static constexpr int MaximumSize = 17 * 17 * 17;

  struct Entry
  {
    std::array<std::int8_t, 3> Offset{}; ///< from the central vertex
    std::array<std::uint16_t, 2> Ends{}; ///< indices of earlier entries; void for vertices
  };

  /** How many numbers there are. */
  static constexpr int Count = 64 * (MaximumScale + 1);

  /** The number of the order of a diamond of at most the maximum scale: less than Count. */
  static int NumberOf(const Place& place);

  /** The order with a number; empty if no diamond has it. */
  static const MidpointOrder& Of(int number);

  /** The diamond's vertices, which come first. Then comes its central vertex. */
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
