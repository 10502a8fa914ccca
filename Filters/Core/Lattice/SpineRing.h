// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SpineRing_h
#define isodiamond_SpineRing_h

#include "Lattice/DiamondTables.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace isodiamond
{

/** The vertices of a diamond that are not ends of its spine: the *ring* around it, in cyclic order.
 *  Two consecutive ones span a tetrahedron with the spine. */
struct SpineRing
{
  int Count = 0;
  std::array<std::uint8_t, 8> Vertices{}; ///< indices as in the shape
};

namespace tables
{

inline constexpr SpineRing MakeRing(const TypeTable& shape)
{
  SpineRing ring;
  std::uint32_t left = 0;
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    left |= (i != shape.Spine[0] && i != shape.Spine[1] ? 1U : 0U) << i;
  }
  for (int next = 0; next < shape.VertexCount; ++next)
  {
    const bool follows = ring.Count == 0 ||
      IsRingEdge(
        shape.DiamondClass, shape.Offsets[ring.Vertices[ring.Count - 1]], shape.Offsets[next]);
    if (((left >> next) & 1U) != 0 && follows)
    {
      left &= ~(1U << next);
      ring.Vertices[ring.Count++] = static_cast<std::uint8_t>(next);
      next = -1; // from the first again
    }
  }
  return ring;
}

template <std::size_t... Type>
inline constexpr std::array<SpineRing, 64> MakeRings(std::index_sequence<Type...> /*types*/)
{
  return { MakeRing(Types[Type])... };
}

inline constexpr std::array<SpineRing, 64> Rings = MakeRings(std::make_index_sequence<64>());

}

/** The ring of the diamond at a position. */
inline constexpr const SpineRing& RingOf(const Point& position)
{
  return tables::Rings[TypeOf(position)];
}

}

#endif
