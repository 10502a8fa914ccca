// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/FineDomain.h"

#include "DistanceError/Bisection.h"
#include "DistanceError/SpineEdges.h"

#include <cassert>
#include <map>

namespace isodiamond
{
namespace
{

/** Which of some tetrahedra contain the middle of an edge, and so all of it. */
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

/** Calls body(tetrahedron) for the finest tetrahedra that a tetrahedron is bisected into. */
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

/** An owner's index in a domain's list, by its place. */
class OwnerIndices
{
public:
  OwnerIndices(const Place& diamond, const FineDomain& domain)
  {
    for (const FineDomain::Owner& owner : domain.Owners)
    {
      const auto index = static_cast<std::uint8_t>(this->Indices.size());
      this->Indices.emplace(Centre(diamond) + owner.Offset, index);
    }
  }
  std::uint8_t operator()(const Place& owner) const { return this->Indices.at(Centre(owner)); }

private:
  std::map<Point, std::uint8_t> Indices;
};

void AddTetrahedra(const Place& diamond, FineDomain& domain)
{
  const OwnerIndices indexOf(diamond, domain);
  const Grid grid({ 65, 65, 65 }); // surrounds any example
  ForEachParentHalf(diamond,
    [&](int number, const Place& parent, const HalfTetrahedron& half)
    {
      domain.AllTetrahedra |= 1U << number;
      ForEachFinest(grid, HalfPlace{ parent, 0, &half },
        [&](const HalfPlace& finest)
        {
          FineDomain::Tetrahedron added{ static_cast<std::uint8_t>(number), indexOf(finest.Parent),
            finest.Half, {} };
          for (int edge = 0; edge < 6; ++edge)
          {
            const OwnedEdge owned = OwnedEdgeOf(finest, edge);
            added.Edges[edge] = { indexOf(owned.Owner), owned.Edge };
          }
          domain.Tetrahedra.push_back(added);
        });
    });
}

/** The edges of an owner that lie in some of a diamond's tetrahedra. */
FineDomain::Owner MakeOwner(
  const Place& diamond, const std::vector<ClosedTetrahedron>& tetrahedra, const Point& offset)
{
  FineDomain::Owner owner;
  owner.Offset = offset;
  const Point centre = Centre(diamond) + offset;
  const TypeTable& shape = ShapeOf(centre);
  for (std::uint8_t edge = 0; shape.Valid && edge < shape.VertexCount; ++edge)
  {
    const FinePosition middle = FineUnits * centre + (FineUnits / 2) * shape.Offsets[edge];
    const std::uint16_t holders = HoldersOf(tetrahedra, middle);
    if (holders != 0)
    {
      const int holder = LowestBit(holders);
      std::uint32_t around = 0;
      ForEachBit(EdgesBetween(tetrahedra[holder].CornersAround(&middle, 1)[0]),
        [&](int i) { around |= 1U << SpineEdgesOf(diamond.Position).OfTetrahedron[holder][i]; });
      owner.EdgeMask |= 1U << edge;
      owner.Edges[edge] = { holders, around };
    }
  }
  owner.IsOlder = diamond.Scale == 0 && shape.DiamondClass < ShapeOf(diamond.Position).DiamondClass;
  return owner;
}

FineDomain MakeDomain(const Place& diamond)
{
  std::vector<ClosedTetrahedron> tetrahedra;
  ForEachParentHalf(diamond,
    [&](int, const Place& parent, const HalfTetrahedron& half) {
      tetrahedra.emplace_back(HalfPlace{ parent, 0, &half });
    });
  FineDomain domain;
  const int h = 1 << diamond.Scale;
  for (Point offset = { 0, 0, -h }; offset[2] <= h; ++offset[2])
  {
    for (offset[1] = -h; offset[1] <= h; ++offset[1])
    {
      for (offset[0] = -h; offset[0] <= h; ++offset[0])
      {
        const FineDomain::Owner owner = MakeOwner(diamond, tetrahedra, offset);
        if (owner.EdgeMask != 0)
        {
          domain.Owners.push_back(owner);
        }
      }
    }
  }
  AddTetrahedra(diamond, domain);
  return domain;
}

}

const FineDomain& FineDomainOf(const Place& diamond)
{
  static const auto ofScale0 = MakeByType(
    [](const Point& position) {
      return MakeDomain({ 0, position });
    });
  static const auto ofScale1 = MakeByType(
    [](const Point& position) {
      return MakeDomain({ 1, position });
    });
  assert(diamond.Scale <= 1 && "there are tables of two scales");
  return (diamond.Scale == 0 ? ofScale0 : ofScale1)[TypeOf(diamond.Position)];
}

}
