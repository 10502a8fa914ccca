// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/CurvedLengths.h"

#include "Patches/WorldLengths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

namespace isodiamond
{
namespace
{

double LengthOf(const Vector& vector)
{
  return std::sqrt(Dot(vector, vector));
}

double DiagonalOf(const Bounds& box)
{
  return LengthOf(box.High - box.Low);
}

}

CurvedLengths::CurvedLengths(const GridGeometry& world)
  : World(world)
  , Last(world.Dimensions() + (2 * world.Padding() - 1) * Point{ 1, 1, 1 })
  , Origin(world.PaddedAt({ 0, 0, 0 }))
{
  const double longest = DiagonalOf(world.CellsInWorld().OfAll());
  // Of the boxes around cells, too, and of positions that are far from the origin.
  this->AbsoluteError = 1e-14 * (longest + LengthOf(this->Origin));
  // Where most samples coincide no step is typical, but none may count as nothing.
  constexpr double leastPart = 1e-6;
  this->Step = std::max(world.SmallestStep(), leastPart * longest);
}

bool CurvedLengths::CanBeMeasured(const GridGeometry& world)
{
  const SamplePositions& positions = *world.Positions();
  const std::array<int, 3>& size = positions.Dimensions;
  const std::int64_t count = std::int64_t{ 3 } * size[0] * size[1] * size[2];
  bool areFinite = true;
  Bounds box;
  std::visit(
    [&](const auto* coordinates)
    {
      for (std::int64_t i = 0; i < count; i += 3)
      {
        const Vector place = { coordinates[i], coordinates[i + 1], coordinates[i + 2] };
        areFinite = areFinite && std::isfinite(place[0]) && std::isfinite(place[1]) &&
          std::isfinite(place[2]);
        box.Add(place);
      }
    },
    positions.Coordinates);
  const double longest = areFinite ? DiagonalOf(box) : HUGE_VAL;
  return longest >= ShortestStep && longest <= LongestStep;
}

double CurvedLengths::SquaredRadius(const FineBox& box, const FinePosition& middle) const
{
  const Vector centre = (*this)(middle);
  double squared = 0.0;
  Point cells{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int first = box.Low[axis] / FineUnits;
    cells[axis] = (box.High[axis] + FineUnits - 1) / FineUnits - first;
  }
  if (std::max({ cells[0], cells[1], cells[2] }) <= 1)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector reach = (*this)({ (corner & 1) != 0 ? box.High[0] : box.Low[0],
                             (corner & 2) != 0 ? box.High[1] : box.Low[1],
                             (corner & 4) != 0 ? box.High[2] : box.Low[2] }) -
        centre;
      squared = std::max(squared, Dot(reach, reach));
    }
    return squared;
  }
  const Point low = { box.Low[0] / FineUnits, box.Low[1] / FineUnits, box.Low[2] / FineUnits };
  const Bounds around = this->World.CellsInWorld().Of(low, low + cells);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = centre[axis] + this->Origin[axis];
    const double reach = std::max(place - around.Low[axis], around.High[axis] - place);
    squared += reach * reach;
  }
  return squared;
}

Bounds CurvedLengths::IndexBox(const Vector& point, double radius) const
{
  const Vector reach = { radius, radius, radius };
  return this->Near({ point - reach, point + reach });
}

Bounds CurvedLengths::IndexBoxAround(const Vector* corners, int count) const
{
  Bounds box;
  std::for_each(corners, corners + count, [&](const Vector& corner) { box.Add(corner); });
  Bounds found = this->Near(box);
  // In the outermost cells it may leave the grid.
  for (int axis = 0; axis < 3; ++axis)
  {
    found.Low[axis] -= found.Low[axis] <= 0.0 ? 1.0 : 0.0;
    found.High[axis] += found.High[axis] >= this->Last[axis] ? 1.0 : 0.0;
  }
  return found;
}

Bounds CurvedLengths::Near(const Bounds& box) const
{
  const Vector slack = { this->AbsoluteError, this->AbsoluteError, this->AbsoluteError };
  return this->World.CellsInWorld().IndexBoxOf(
    { box.Low + this->Origin - slack, box.High + this->Origin + slack });
}

double CurvedLengths::StepIn(const Point& cell) const
{
  const double diagonal = LengthOf(this->Between(cell, cell + Point{ 1, 1, 1 }));
  return diagonal > 0.0 ? 0.5 * diagonal : this->Step;
}

double CurvedLengths::LongestDistance(const Point& /*last*/) const
{
  return DiagonalOf(this->World.CellsInWorld().OfAll());
}

}
