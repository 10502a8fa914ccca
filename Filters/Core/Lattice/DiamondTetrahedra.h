// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondTetrahedra_h
#define isodiamond_DiamondTetrahedra_h

#include "Lattice/DiamondTables.h"

#include <cassert>
#include <cstdint>

/**
 * @file DiamondTetrahedra.h
 * The tetrahedra of a diamond, those around its spine: each is one of the halves that a parent
 * makes. They are numbered by parent, then by half; a number means the same tetrahedron for all
 * diamonds of a type.
 */
namespace isodiamond
{

/** A tetrahedron of the hierarchy: one of the halves that its youngest vertex's diamond makes. */
struct HalfPlace
{
  Place Parent; ///< a stored diamond
  std::uint32_t Rank = 0;
  const HalfTetrahedron* Half = nullptr;

  const TypeTable& Shape() const { return ShapeOf(this->Parent.Position); }
  Place Child() const { return ChildPlace(this->Shape(), this->Parent, this->Half->Child); }
};

/** An edge by its owner, the diamond at its younger end. */
struct OwnedEdge
{
  Place Owner;
  std::uint8_t Edge = 0; ///< index in the owner's edge mask
};

/** An edge of a half-tetrahedron: 0 to 2 lead from the centre to its vertices, 3 to 5 lie opposite
 *  to them. */
inline OwnedEdge OwnedEdgeOf(const HalfPlace& tetrahedron, int edge)
{
  const HalfTetrahedron& half = *tetrahedron.Half;
  if (edge < 3)
  {
    return { tetrahedron.Parent, half.Vertices[edge] };
  }
  const OuterEdge& outer = half.OuterEdges[edge - 3];
  const Point position =
    tetrahedron.Parent.Position + tetrahedron.Shape().Offsets[outer.OwnerVertex];
  const int step = outer.OwnerStep;
  return { { tetrahedron.Parent.Scale + step,
             { position[0] >> step, position[1] >> step, position[2] >> step } },
    outer.OwnerEdge };
}

/** The first of the halves that a parent makes for a child. */
inline const HalfTetrahedron* HalvesOfChild(const Place& parent, const Place& child)
{
  const TypeTable& shape = ShapeOf(parent.Position);
  const Point offset = child.Position + -(1 << shape.ChildStep) * parent.Position;
  int index = 0;
  while (shape.ChildOffsets[index] != offset)
  {
    ++index;
    assert(index < shape.ChildCount && "a child of the parent");
  }
  return &shape.HalfTetrahedra[index * shape.HalfTetrahedraPerChild];
}

/** Calls body(number, parent, half) for the tetrahedra of a diamond. */
template <typename Body>
void ForEachParentHalf(const Place& diamond, Body&& body)
{
  const TypeTable& shape = ShapeOf(diamond.Position);
  int number = 0;
  for (int i = 0; i < shape.ParentCount; ++i)
  {
    const Place parent = ParentPlace(shape, diamond, i);
    const HalfTetrahedron* halves = HalvesOfChild(parent, diamond);
    for (int j = 0; j < ShapeOf(parent.Position).HalfTetrahedraPerChild; ++j)
    {
      body(number++, parent, halves[j]);
    }
  }
}

/** The number of the diamond's tetrahedron that one of its halves comes from. */
int NumberOfWhole(const Point& position, const HalfTetrahedron& half);

/** A tetrahedron of a diamond by its number; without the parent's rank. */
inline HalfPlace TetrahedronOf(const Place& diamond, int number)
{
  const TypeTable& shape = ShapeOf(diamond.Position);
  const int halvesOfParent = shape.HalfTetrahedronCount / 2 / shape.ParentCount;
  const Place parent = ParentPlace(shape, diamond, number / halvesOfParent);
  return { parent, 0, HalvesOfChild(parent, diamond) + number % halvesOfParent };
}

}

#endif
