// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_RingFilling_h
#define isodiamond_RingFilling_h

#include "Stuffing/LocalMesh.h"

namespace isodiamond
{

/** Edges with more tetrahedra around them stay. */
inline constexpr std::size_t MostAround = 7;

/** The best way to fill the space around an edge without it: triangles between the ring's points,
 *  each joined to both ends (Klincsek's dynamic programming). @return the smallest sine */
double FillRing(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b,
  const std::vector<std::uint32_t>& ring, std::vector<Corners>& fresh);

}

#endif
