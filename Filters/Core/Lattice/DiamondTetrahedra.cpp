// SPDX-License-Identifier: BSD-3-Clause
#include "Lattice/DiamondTetrahedra.h"

#include <algorithm>
#include <array>

namespace isodiamond
{
namespace
{

using Corners = std::array<Point, 4>;

Corners Sorted(Corners corners)
{
  std::sort(corners.begin(), corners.end());
  return corners;
}

/** A half's corners, with its diamond's centre replaced by the other end of the spine. */
Corners CornersOfWhole(const Point& position, const HalfTetrahedron& half)
{
  const TypeTable& shape = ShapeOf(position);
  const bool hasFirst = ((half.Mask >> shape.Spine[0]) & 1U) != 0;
  Corners corners{ position + shape.Offsets[shape.Spine[hasFirst ? 1 : 0]] };
  for (int i = 0; i < 3; ++i)
  {
    corners[i + 1] = position + shape.Offsets[half.Vertices[i]];
  }
  return Sorted(corners);
}

/** By type and half. */
using NumberTable = std::array<std::array<std::uint8_t, MaximumHalfTetrahedra>, 64>;

/** @param position at scale 0, with room for parents */
void AddNumbers(const Point& position, NumberTable& numbers)
{
  ForEachParentHalf({ 0, position },
    [&](int number, const Place& parent, const HalfTetrahedron& whole)
    {
      Corners corners{ Centre(parent) };
      for (int i = 0; i < 3; ++i)
      {
        corners[i + 1] = (1 << parent.Scale) *
          (parent.Position + ShapeOf(parent.Position).Offsets[whole.Vertices[i]]);
      }
      corners = Sorted(corners);
      const TypeTable& shape = ShapeOf(position);
      for (int half = 0; half < shape.HalfTetrahedronCount; ++half)
      {
        if (CornersOfWhole(position, shape.HalfTetrahedra[half]) == corners)
        {
          numbers[TypeOf(position)][half] = static_cast<std::uint8_t>(number);
        }
      }
    });
}

}

int NumberOfWhole(const Point& position, const HalfTetrahedron& half)
{
  static const NumberTable numbers = []
  {
    NumberTable all{};
    for (int type = 0; type < 64; ++type)
    {
      const Point example = PositionOfType(type);
      if (ShapeOf(example).Valid)
      {
        AddNumbers(example, all);
      }
    }
    return all;
  }();
  return numbers[TypeOf(position)][&half - ShapeOf(position).HalfTetrahedra.data()];
}

}
