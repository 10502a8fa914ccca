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

/** Calls body(tetrahedron) for what a tetrahedron is bisected into in the end. */
template <typename Body>
void ForEachFinest(const Grid& grid, const HalfPlace& whole, const Body& body)
{
  const Place diamond = whole.Child();
  if (diamond.Scale < 0)
  {
    body(whole);
    return;
  }
  ForEachHalf(grid, whole, diamond, 0,
    [&](const HalfPlace& half, const ExactPlane&) { ForEachFinest(grid, half, body); });
}

void AddTetrahedra(const Point& position, ScaleZeroDomain& domain)
{
  const auto indexOf = [&](const Place& place)
  {
    int i = 0;
    while (position + domain.Owners[i].Offset != place.Position)
    {
      ++i;
    }
    return static_cast<std::uint8_t>(i);
  };
  const Grid grid({ 65, 65, 65 }); // all around any example
  ForEachParentHalf({ 0, position },
    [&](int number, const Place& parent, const HalfTetrahedron& half)
    {
      domain.AllTetrahedra |= 1U << number;
      ForEachFinest(grid, HalfPlace{ parent, 0, &half },
        [&](const HalfPlace& finest)
        {
          ScaleZeroDomain::Tetrahedron added{ static_cast<std::uint8_t>(number),
            indexOf(finest.Parent), finest.Half, {} };
          for (int edge = 0; edge < 6; ++edge)
          {
            const OwnedEdge owned = OwnedEdgeOf(finest, edge);
            added.Edges[edge] = { indexOf(owned.Owner), owned.Edge };
          }
          domain.Tetrahedra.push_back(added);
        });
    });
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
  AddTetrahedra(position, domain);
  return domain;
}

}

const ScaleZeroDomain& ScaleZeroDomainOf(const Point& position)
{
  static const auto domains = MakeByType(MakeDomain);
  return domains[TypeOf(position)];
}

}
