// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FineDomain_h
#define isodiamond_FineDomain_h

#include "Lattice/DiamondTetrahedra.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The edges and tetrahedra of full resolution in the closed domain of a diamond of scale 0 or 1, as
 * nearly all diamonds are: there lie the isovertices that the error depends on. Listed by the
 * diamonds that own the edges, all of scale 0.
 */
struct FineDomain
{
  /** An edge, and the diamond's tetrahedra that hold it. */
  struct Edge
  {
    std::uint16_t Tetrahedra = 0; ///< mask of their numbers
    /** The tetrahedra's edge that it lies on, or the edges of the triangle, numbered as in
     *  SpineEdges; none if it lies inside a tetrahedron. */
    std::uint32_t Around = 0;
  };

  struct Owner
  {
    Point Offset{};                            ///< from the diamond, in samples
    std::uint32_t EdgeMask = 0;                ///< of its subdivision edges, those in the domain
    std::array<Edge, MaximumVertices> Edges{}; ///< those of the mask
    /** At scale 0, whether its edges are edges of the tetrahedra: their isovertices are corners of
     *  patches. */
    bool IsOlder = false;
  };

  /** A tetrahedron of full resolution. */
  struct Tetrahedron
  {
    std::uint8_t Whole = 0; ///< the number of the diamond's tetrahedron that it is part of
    std::uint8_t Owner = 0; ///< index of the owner at its youngest vertex
    const HalfTetrahedron* Half = nullptr;
    /** By edge, numbered as a half-tetrahedron's: the owner's index, and the owner's edge. */
    std::array<std::array<std::uint8_t, 2>, 6> Edges{};
  };

  std::vector<Owner> Owners;
  std::vector<Tetrahedron> Tetrahedra;
  std::uint32_t AllTetrahedra = 0; ///< of the diamond, a mask of their numbers
};

/** The table for the type of a diamond of scale 0 or 1. */
const FineDomain& FineDomainOf(const Place& diamond);

}

#endif
