// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SpineEdges_h
#define isodiamond_SpineEdges_h

#include "Lattice/DiamondTetrahedra.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/**
 * The edges of the tetrahedra around a spine, each once: neighbours share most of theirs, and so
 * the isovertices on them. Each is named by its owner, the diamond at its younger end.
 */
struct SpineEdges
{
  struct Edge
  {
    std::uint8_t Owner = 0;     ///< index in Owners
    std::uint8_t OwnerEdge = 0; ///< index in the owner's edge mask
  };

  /** From a diamond to an owner. */
  struct OwnerPlace
  {
    Point Offset{}; ///< to its centre, at the diamond's scale
    int Step = 0;   ///< its scale minus the diamond's
  };

  static constexpr int MostEdges = 25; ///< of a class 2 diamond

  int OwnerCount = 0;
  std::array<OwnerPlace, MaximumVertices> Owners;
  int EdgeCount = 0;
  std::array<Edge, MostEdges> Edges;
  /** By number of the tetrahedron, then as a half-tetrahedron's edges are numbered. */
  std::array<std::array<std::uint8_t, 6>, 8> OfTetrahedron{};
};

/** The table for the type of a position. */
const SpineEdges& SpineEdgesOf(const Point& position);

/** The place of an owner. */
inline Place OwnerOf(const Place& diamond, const SpineEdges::OwnerPlace& owner)
{
  const Point position = diamond.Position + owner.Offset;
  return { diamond.Scale + owner.Step,
    { position[0] >> owner.Step, position[1] >> owner.Step, position[2] >> owner.Step } };
}

}

#endif
