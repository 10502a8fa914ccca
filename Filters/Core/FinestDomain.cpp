// SPDX-License-Identifier: BSD-3-Clause
#include "FinestDomain.h"

#include "Bisection.h"

namespace isodiamond
{
namespace
{

/** Which of some tetrahedra hold the middle of an edge, and so all of it. */
std::uint16_t HoldersOf(
  const std::vector<ClosedTetrahedron>& tetrahedra, const Point& end, const Point& offset)
{
  const FinePosition middle = FineUnits * end + (FineUnits / 2) * offset;
  std::uint16_t holders = 0;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
  {
    holders |= static_cast<std::uint16_t>(static_cast<unsigned>(tetrahedra[i].Holds(middle)) << i);
  }
  return holders;
}

FinestDomain MakeDomain(const Point& position)
{
  std::vector<ClosedTetrahedron> tetrahedra;
  ForEachParentHalf({ 0, position },
    [&](int, const Place& parent, const HalfTetrahedron& half) {
      tetrahedra.emplace_back(HalfPlace{ parent, 0, &half });
    });
  FinestDomain domain;
  for (int i = 0; i < 27; ++i)
  {
    FinestDomain::Owner owner;
    owner.Offset = { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 };
    const Point centre = position + owner.Offset;
    const TypeTable& shape = ShapeOf(centre);
    for (std::uint8_t edge = 0; shape.Valid && edge < shape.VertexCount; ++edge)
    {
      const std::uint16_t holders = HoldersOf(tetrahedra, centre, shape.Offsets[edge]);
      if (holders != 0)
      {
        owner.EdgeMask |= 1U << edge;
        owner.Edges.push_back({ edge, holders });
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

const FinestDomain& FinestDomainOf(const Point& position)
{
  static const std::array<FinestDomain, 64> domains = []
  {
    std::array<FinestDomain, 64> all;
    for (int type = 0; type < 64; ++type)
    {
      const Point position = PositionOfType(type);
      if (ShapeOf(position).Valid)
      {
        all[type] = MakeDomain(position);
      }
    }
    return all;
  }();
  return domains[TypeOf(position)];
}

}
