// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/OverturnedTetrahedra.h"

#include "DistanceError/IsovertexClusters.h"
#include "Patches/IntervalCases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace isodiamond
{
namespace
{

double SixVolumes(const std::array<Vector, 4>& corners)
{
  return isodiamond::SixVolumes(corners[0], corners[1], corners[2], corners[3]);
}

/** The greatest distance from the first corner. */
double LongestFrom(const std::array<Vector, 4>& corners)
{
  double squared = 0.0;
  for (const Vector& corner : corners)
  {
    squared = std::max(squared, Dot(corner - corners[0], corner - corners[0]));
  }
  return std::sqrt(squared);
}

}

OverturnedTetrahedra::OverturnedTetrahedra(
  const IsodiamondHierarchy& relevant, const GridGeometry& world)
  : Hierarchy(relevant)
  , World(world)
  , Orientation(world.Mirrors() ? -1.0 : 1.0)
  , Neighbourhood(relevant)
{
}

bool OverturnedTetrahedra::AreAround(const Place& diamond) const
{
  bool are = false;
  this->Neighbourhood.ForEachTetrahedron(diamond, true,
    [&](int /*number*/, const HalfPlace& tetrahedron) { are = are || this->AreIn(tetrahedron); });
  return are;
}

/** Whether any of those that a tetrahedron is cut into are turned over. */
bool OverturnedTetrahedra::AreIn(const HalfPlace& tetrahedron) const
{
  const HalfTetrahedron& half = *tetrahedron.Half;
  const std::vector<PatchTetrahedron>& pieces =
    IntervalPatches()[IntervalCase(this->Hierarchy, tetrahedron.Rank, half)];
  const std::array<Vector, 4> whole = { this->VertexOf(tetrahedron, 0),
    this->VertexOf(tetrahedron, 1), this->VertexOf(tetrahedron, 2),
    this->VertexOf(tetrahedron, 3) };
  const double sign = half.OddByAge ? -this->Orientation : this->Orientation;
  // Where samples coincide or a cell is turned over itself, so are others; then only what is surely
  // turned over counts.
  const double rounding =
    sign * SixVolumes(whole) > 0.0 ? 0.0 : 1e-9 * std::pow(LongestFrom(whole), 3);
  return std::any_of(pieces.begin(), pieces.end(),
    [&](const PatchTetrahedron& piece)
    {
      std::array<Vector, 4> corners;
      std::transform(piece.begin(), piece.end(), corners.begin(),
        [&](const PatchPoint& point) {
          return point.IsVertex() ? whole[point.Younger()] : this->IsovertexOf(tetrahedron, point);
        });
      const double volume = sign * SixVolumes(corners);
      return !(rounding == 0.0 ? volume > 0.0 : volume >= -rounding);
    });
}

/** @param age 0 for the parent's centre, the youngest */
Vector OverturnedTetrahedra::VertexOf(const HalfPlace& tetrahedron, int age) const
{
  const HalfTetrahedron& half = *tetrahedron.Half;
  return this->At(FineUnits *
    (age == 0 ? Centre(tetrahedron.Parent)
              : VertexAt(tetrahedron.Parent,
                  tetrahedron.Shape().Offsets[half.Vertices[half.ByAge[age - 1]]])));
}

Vector OverturnedTetrahedra::IsovertexOf(
  const HalfPlace& tetrahedron, const PatchPoint& point) const
{
  const int edge = EdgeBetween(*tetrahedron.Half, point.Younger(), point.Older());
  return this->At(IsovertexOn(this->Hierarchy, tetrahedron, edge, point.Surface()));
}

Vector OverturnedTetrahedra::At(const FinePosition& p) const
{
  constexpr double unit = 1.0 / FineUnits;
  return this->World({ unit * p[0], unit * p[1], unit * p[2] });
}

}
