// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondTetrahedra_h
#define isodiamond_DiamondTetrahedra_h

#include "DiamondTables.h"

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

/** The first of the halves that a parent makes for a child. */
inline const HalfTetrahedron* HalvesOfChild(const Place& parent, const Place& child)
{
  const TypeTable& shape = ShapeOf(parent.Position);
  const Point offset = child.Position + -(1 << shape.ChildStep) * parent.Position;
  int index = 0;
  while (shape.ChildOffsets[index] != offset)
  {
    ++index;
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

/** The number of the tetrahedron of a diamond that a half of the diamond comes from. */
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
