// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/OverturnedTetrahedra.h"

#include "DistanceError/Bisection.h"
#include "DistanceError/IsovertexClusters.h"
#include "DistanceError/SpineNeighbourhood.h"
#include "Patches/IntervalCases.h"
#include "Patches/IntervalPatches.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isodiamond
{
namespace
{

/** Looks at the tetrahedra around spines. */
class OverturnedSearch
{
public:
  OverturnedSearch(const IsodiamondHierarchy& hierarchy, const GridGeometry& world)
    : Hierarchy(hierarchy)
    , World(world)
    , Orientation(world.Mirrors() ? -1.0 : 1.0)
    , Neighbourhood(hierarchy)
  {
  }

  bool IsAnyAround(const Place& diamond) const
  {
    bool isAny = false;
    this->Neighbourhood.ForEachTetrahedron(diamond, true,
      [&](int /*number*/, const HalfPlace& tetrahedron)
      { isAny = isAny || this->IsAnyIn(tetrahedron); });
    return isAny;
  }

private:
  /** Whether a tetrahedron is cut into some that are turned over. */
  bool IsAnyIn(const HalfPlace& tetrahedron) const
  {
    const HalfTetrahedron& half = *tetrahedron.Half;
    const std::vector<PatchTetrahedron>& pieces =
      IntervalPatches()[IntervalCase(this->Hierarchy, tetrahedron.Rank, half)];
    const std::array<Vector, 4> whole = { this->VertexOf(tetrahedron, 0),
      this->VertexOf(tetrahedron, 1), this->VertexOf(tetrahedron, 2),
      this->VertexOf(tetrahedron, 3) };
    const double sign = half.OddByAge ? -this->Orientation : this->Orientation;
    // Where samples coincide or a cell is turned over itself, so are others; then only what is
    // surely turned over counts.
    const double rounding =
      sign * SixVolume(whole) > 0.0 ? 0.0 : 1e-9 * std::pow(LongestFrom(whole), 3);
    return std::any_of(pieces.begin(), pieces.end(),
      [&](const PatchTetrahedron& piece)
      {
        std::array<Vector, 4> corners;
        std::transform(piece.begin(), piece.end(), corners.begin(),
          [&](const PatchPoint& point) {
            return point.IsVertex() ? whole[point.Younger()]
                                    : this->IsovertexOf(tetrahedron, point);
          });
        const double volume = sign * SixVolume(corners);
        return !(rounding == 0.0 ? volume > 0.0 : volume >= -rounding);
      });
  }

  /** @param age 0 for the parent's centre, the youngest */
  Vector VertexOf(const HalfPlace& tetrahedron, int age) const
  {
    const HalfTetrahedron& half = *tetrahedron.Half;
    return this->At(FineUnits *
      (age == 0 ? Centre(tetrahedron.Parent)
                : VertexAt(tetrahedron.Parent,
                    tetrahedron.Shape().Offsets[half.Vertices[half.ByAge[age - 1]]])));
  }

  Vector IsovertexOf(const HalfPlace& tetrahedron, const PatchPoint& point) const
  {
    const int edge = EdgeBetween(*tetrahedron.Half, point.Younger(), point.Older());
    return this->At(IsovertexOn(this->Hierarchy, tetrahedron, edge, point.Surface()));
  }

  Vector At(const FinePosition& p) const
  {
    constexpr double unit = 1.0 / FineUnits;
    return this->World({ unit * p[0], unit * p[1], unit * p[2] });
  }

  static double SixVolume(const std::array<Vector, 4>& corners)
  {
    return Dot(Cross(corners[1] - corners[0], corners[2] - corners[0]), corners[3] - corners[0]);
  }

  /** The greatest distance from the first corner. */
  static double LongestFrom(const std::array<Vector, 4>& corners)
  {
    double squared = 0.0;
    for (const Vector& corner : corners)
    {
      squared = std::max(squared, Dot(corner - corners[0], corner - corners[0]));
    }
    return std::sqrt(squared);
  }

  const IsodiamondHierarchy& Hierarchy;
  const GridGeometry& World;
  double Orientation;
  SpineNeighbourhood Neighbourhood;
};

}

void SubdivideOverturned(const IsodiamondHierarchy& relevant, const GridGeometry& world,
  const ParallelFor& parallelFor, std::vector<ErrorCode::Type>& codes)
{
  if (!relevant.Region().IsVolume() || world.Affine() != nullptr)
  {
    return;
  }
  const OverturnedSearch search(relevant, world);
  const DiamondSet& diamonds = relevant.Diamonds();
  for (int scale = 0; scale < diamonds.ScaleCount() - 1; ++scale)
  {
    const std::vector<Brick>& bricks = diamonds.Level(scale).Bricks;
    ForEachIndex(parallelFor, static_cast<std::int64_t>(bricks.size()), 1,
      [&](std::int64_t i)
      {
        diamonds.ForEachInBrick(scale, bricks[i],
          [&](const Place& diamond, std::uint32_t rank)
          {
            if (codes[rank] != ErrorCode::Always && search.IsAnyAround(diamond))
            {
              codes[rank] = ErrorCode::Always;
            }
          });
      });
  }
}

}
