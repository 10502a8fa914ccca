// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_HalfTetrahedronMasks_h
#define isodiamond_HalfTetrahedronMasks_h

#include "Lattice/DiamondTables.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

/**
 * @file HalfTetrahedronMasks.h
 * All half-tetrahedra of a diamond at once, in a word with four bits for each.
 *
 * Bits 0 to 2 of the four stand for the half-tetrahedron's outer vertices: a set of vertices of the
 * diamond, given as an edge mask, becomes the three bits that tell the case of each
 * half-tetrahedron. A set of half-tetrahedra uses bit 0 of the four.
 */
namespace isodiamond
{

using HalfTetrahedronMask = std::uint64_t;

/** Bit 0 of every half-tetrahedron. */
inline constexpr HalfTetrahedronMask EveryHalf = 0x1111111111111111U;

/** The words of sets of vertices, from tables for the lower and the upper half of the edge mask. */
class VertexMasks
{
public:
  constexpr VertexMasks() = default;

  /** @param words by vertex */
  explicit constexpr VertexMasks(const std::array<HalfTetrahedronMask, MaximumVertices>& words)
  {
    for (std::size_t set = 1; set < this->Lower.size(); ++set)
    {
      for (int i = 0; i < HalfOfVertices; ++i)
      {
        this->Lower[set] |= ((set >> i) & 1U) != 0 ? words[i] : 0;
        this->Upper[set] |= ((set >> i) & 1U) != 0 ? words[HalfOfVertices + i] : 0;
      }
    }
  }

  constexpr HalfTetrahedronMask operator()(std::uint32_t vertices) const
  {
    return this->Lower[vertices & ((1U << HalfOfVertices) - 1U)] |
      this->Upper[(vertices >> HalfOfVertices) & ((1U << HalfOfVertices) - 1U)];
  }

private:
  static constexpr int HalfOfVertices = MaximumVertices / 2;

  std::array<HalfTetrahedronMask, 1U << HalfOfVertices> Lower{};
  std::array<HalfTetrahedronMask, 1U << HalfOfVertices> Upper{};
};

namespace tables
{

/** @param byAge whether a half-tetrahedron's vertices are ordered from youngest to oldest, or as
 *         listed */
inline constexpr VertexMasks MakeVertexMasks(const TypeTable& shape, bool byAge)
{
  std::array<HalfTetrahedronMask, MaximumVertices> words{};
  for (int index = 0; index < shape.HalfTetrahedronCount; ++index)
  {
    const HalfTetrahedron& half = shape.HalfTetrahedra[index];
    for (int i = 0; i < 3; ++i)
    {
      words[half.Vertices[byAge ? half.ByAge[i] : i]] |= HalfTetrahedronMask{ 1 }
        << (4 * index + i);
    }
  }
  return VertexMasks(words);
}

/** One constant per type: compilers limit the work that goes into a single one. */
template <std::size_t Type, bool ByAge>
inline constexpr VertexMasks VertexMasksOfType = MakeVertexMasks(Types[Type], ByAge);

template <bool ByAge, std::size_t... Type>
inline constexpr std::array<VertexMasks, 64> MakeAllVertexMasks(std::index_sequence<Type...>)
{
  return { VertexMasksOfType<Type, ByAge>... };
}

/** By type. */
inline constexpr std::array<VertexMasks, 64> MasksAsListed =
  MakeAllVertexMasks<false>(std::make_index_sequence<64>());
inline constexpr std::array<VertexMasks, 64> MasksByAge =
  MakeAllVertexMasks<true>(std::make_index_sequence<64>());

inline constexpr bool ChildrenHaveTwoHalves()
{
  for (const TypeTable& shape : Types)
  {
    if (shape.Valid && shape.HalfTetrahedraPerChild != 2)
    {
      return false;
    }
  }
  return true;
}
static_assert(ChildrenHaveTwoHalves(), "every child has a byte");

}

/** The half-tetrahedra that have any of the vertices. */
inline constexpr HalfTetrahedronMask HalvesWithAny(HalfTetrahedronMask vertices)
{
  return (vertices | (vertices >> 1) | (vertices >> 2)) & EveryHalf;
}

/** The half-tetrahedra that have exactly two of the vertices. */
inline constexpr HalfTetrahedronMask HalvesWithTwo(HalfTetrahedronMask vertices)
{
  const HalfTetrahedronMask first = vertices;
  const HalfTetrahedronMask second = vertices >> 1;
  const HalfTetrahedronMask third = vertices >> 2;
  const HalfTetrahedronMask two = (first & second) | (second & third) | (first & third);
  return two & ~(first & second & third) & EveryHalf;
}

/** The half-tetrahedra of children, given as a mask of up to eight. */
inline constexpr HalfTetrahedronMask HalvesOfChildren(std::uint32_t children)
{
  // Bit i of the copy in byte i, moved to the byte's top, then down.
  const std::uint64_t copies = children * std::uint64_t{ 0x0101010101010101 };
  const std::uint64_t tops =
    ((copies & 0x8040201008040201U) + 0x7f7f7f7f7f7f7f7fU) & 0x8080808080808080U;
  return (tops >> 7) * 0x11U;
}

/** The children that have any of the half-tetrahedra. */
inline constexpr std::uint32_t ChildrenOfHalves(HalfTetrahedronMask halves)
{
  // Bit 0 of every byte i becomes bit i of the topmost byte.
  const std::uint64_t bytes = (halves | (halves >> 4)) & 0x0101010101010101U;
  return static_cast<std::uint32_t>((bytes * 0x0102040810204080U) >> 56);
}

}

#endif
