// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/ScaleZeroDomain.h"

#include "DistanceError/Bisection.h"
#include "DistanceError/SpineEdges.h"

namespace isodiamond
{
namespace
{

/** Which of some tetrahedra hold the middle of an edge, and so all of it. */
std::uint16_t HoldersOf(
  const std::vector<ClosedTetrahedron>& tetrahedra, const FinePosition& middle)
{
  std::uint16_t holders = 0;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
  {
    holders |= static_cast<std::uint16_t>(static_cast<unsigned>(tetrahedra[i].Holds(middle)) << i);
  }
  return holders;
}

/** The edges of a tetrahedron between corners, two or three of them: as a mask of its edges. */
std::uint32_t EdgesBetween(std::uint32_t corners)
{
  // The edges by their ends, in the order of a half-tetrahedron's edges.
  constexpr std::array<std::uint32_t, 6> ends = { 0b0011, 0b0101, 0b1001, 0b1100, 0b1010, 0b0110 };
  std::uint32_t edges = 0;
  for (std::size_t i = 0; i < ends.size() && corners != 0b1111; ++i)
  {
    edges |= ((ends[i] & ~corners) == 0 ? 1U : 0U) << i;
  }
  return edges;
}

ScaleZeroDomain MakeDomain(const Point& position)
{
  std::vector<ClosedTetrahedron> tetrahedra;
  ForEachParentHalf({ 0, position },
    [&](int, const Place& parent, const HalfTetrahedron& half) {
      tetrahedra.emplace_back(HalfPlace{ parent, 0, &half });
    });
  ScaleZeroDomain domain;
  for (int i = 0; i < 27; ++i)
  {
    ScaleZeroDomain::Owner owner;
    owner.Offset = { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 };
    const Point centre = position + owner.Offset;
    const TypeTable& shape = ShapeOf(centre);
    for (std::uint8_t edge = 0; shape.Valid && edge < shape.VertexCount; ++edge)
    {
      const FinePosition middle = FineUnits * centre + (FineUnits / 2) * shape.Offsets[edge];
      const std::uint16_t holders = HoldersOf(tetrahedra, middle);
      if (holders != 0)
      {
        const int holder = LowestBit(holders);
        std::uint32_t around = 0;
        ForEachBit(EdgesBetween(tetrahedra[holder].CornersAround(middle)),
          [&](int i) { around |= 1U << SpineEdgesOf(position).OfTetrahedron[holder][i]; });
        owner.EdgeMask |= 1U << edge;
        owner.Edges.push_back({ edge, holders, around });
      }
    }
    owner.IsOlder = shape.DiamondClass < ShapeOf(position).DiamondClass;
    if (owner.EdgeMask != 0)
    {
      domain.Owners.push_back(owner);
    }
  }
  return domain;
}

}

const ScaleZeroDomain& ScaleZeroDomainOf(const Point& position)
{
  static const auto domains = MakeByType(MakeDomain);
  return domains[TypeOf(position)];
}

}
