// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/ToleranceExcess.h"

#include "Simplification/BoundsTree.h"
#include "Simplification/Covering.h"
#include "Simplification/PartDistance.h"
#include "Stuffing/MeasuredSurfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace isodiamond
{
namespace
{

/** The first length that is tried where the grid has no smallest step, as a part of the bounds'
 *  diagonal. It is doubled until it suffices. */
constexpr double LeastPart = 1.0 / 1024.0;

/** How often what is between a length that suffices and one that does not is halved. */
constexpr int Halvings = 4;

/** How often a triangle is cut into four, until there is one that all of a piece is near to. */
constexpr int MostCuts = 5;

/** The triangles of a mesh, wherever they are near to something: those that walking over the mesh
 *  (PartDistance.h) leads past, too. */
class TrianglesAround
{
public:
  /** @param surfaces by point: which of the two it is on
   *  @param reaches by triangle: how far away something may be that is near to it, besides what is
   *         added when it is asked for */
  TrianglesAround(const std::vector<Vector>& positions, const std::vector<std::int8_t>& surfaces,
    const LinkedTriangles& mesh, std::vector<double> reaches)
    : Mesh(mesh)
    , Surfaces(surfaces)
    , Reaches(std::move(reaches))
    , Tree(TreeOf(positions, mesh.Triangles, this->Reaches))
    , Cover(positions, mesh)
  {
  }

  /** Whether each place of another triangle is near to one of them on the same surface.
   *  @param surface that it is on
   *  @param more what is added to their reaches
   *  @param allowanceOf (triangle) -> how far away from it a place may be, if it is in reach */
  template <typename AllowanceOf>
  bool AreNear(const std::array<Vector, 3>& corners, std::int8_t surface, double more,
    const AllowanceOf& allowanceOf)
  {
    Bounds bounds;
    for (const Vector& corner : corners)
    {
      bounds.Add(corner);
    }
    std::vector<std::uint32_t> around;
    this->Tree.ForEachAt(bounds.Grown(more),
      [&](std::uint32_t triangle)
      {
        if (this->Surfaces[this->Mesh.Triangles[triangle][0]] == surface)
        {
          around.push_back(triangle);
        }
      });
    return this->Cover.IsNearAround(
      corners, around, [&](std::uint32_t triangle) { return this->Reaches[triangle] + more; },
      MostCuts,
      [&](std::uint32_t triangle, const std::array<Vector, 3>& piece)
      { return this->Cover.IsNear(triangle, piece.data(), 3, allowanceOf(triangle)); });
  }

private:
  const LinkedTriangles& Mesh;
  const std::vector<std::int8_t>& Surfaces;
  std::vector<double> Reaches;
  BoundsTree Tree;
  Covering Cover;
};

/** Measures surfaces with longer and shorter allowances. What is near enough stays so with a longer
 *  one, so that only what was too far away is looked at again. */
class LongerAllowances
{
public:
  /** @param onSurfaces by point */
  LongerAllowances(MeasuredSurfaces& surfaces, const std::vector<std::int8_t>& onSurfaces,
    const ParallelFor& parallelFor)
    : Part(surfaces.Part)
    , Surfaces(onSurfaces)
    , Allowed(surfaces.Part.Allowances)
    , Homes(surfaces.Homes())
    , ForAll(parallelFor)
    , Distance(surfaces.Part, false, true) // not near at the start, and may turn over
  {
  }

  /** What is too far away. */
  struct Far
  {
    NearLists Near; ///< of the part
    std::vector<bool> Triangles;
    bool IsAny = true;
  };
  Far All() const
  {
    return { this->Part.Near, std::vector<bool>(this->Part.Simple.Triangles.size(), true) };
  }

  /** @param before what is too far away with less */
  Far With(double length, const Far& before)
  {
    std::transform(this->Allowed.begin(), this->Allowed.end(), this->Part.Allowances.begin(),
      [&](double allowed) { return allowed + length; });
    this->Part.Near = before.Near;
    const PartDistance::Faults faults =
      this->Distance.Find(this->Part.Simple, this->Homes, before.Triangles, this->ForAll);
    Far far{ this->Part.Near, std::vector<bool>(before.Triangles.size()), false };
    const auto look = [&](std::int64_t, std::int64_t)
    {
      this->LookAtOriginals(far);
      this->LookAt(faults.Triangles, length, far);
    };
    this->ForAll(1, 1, look);
    return far;
  }

private:
  /** Those that nothing seems to be near to. */
  void LookAtOriginals(Far& far)
  {
    for (std::uint32_t i = 0; i < far.Near.Count() && !far.IsAny; ++i)
    {
      const double allowance = this->Part.Allowances[i];
      far.IsAny = far.Near[i].empty() &&
        !this->AroundSimple().AreNear(this->Part.Original.Corners(this->Part.Positions, i),
          this->SurfaceOf(this->Part.Original, i), allowance,
          [&](std::uint32_t) { return allowance; });
    }
  }

  void LookAt(const std::vector<std::uint32_t>& triangles, double length, Far& far)
  {
    for (const std::uint32_t i : triangles)
    {
      far.Triangles[i] = far.Triangles[i] ||
        !this->AroundOriginals().AreNear(this->Part.Simple.Corners(this->Part.Positions, i),
          this->SurfaceOf(this->Part.Simple, i), length,
          [&](std::uint32_t original) { return this->Part.Allowances[original]; });
      far.IsAny = far.IsAny || far.Triangles[i];
    }
  }

  std::int8_t SurfaceOf(const LinkedTriangles& mesh, std::uint32_t triangle) const
  {
    return this->Surfaces[mesh.Triangles[triangle][0]];
  }

  ///@{
  /** Made when they are needed. */
  TrianglesAround& AroundSimple()
  {
    if (!this->Simples)
    {
      const LinkedTriangles& mesh = this->Part.Simple;
      this->Simples.emplace(
        this->Part.Positions, this->Surfaces, mesh, std::vector<double>(mesh.Triangles.size()));
    }
    return *this->Simples;
  }
  TrianglesAround& AroundOriginals()
  {
    if (!this->Originals)
    {
      double longest = 0.0;
      for (const double allowed : this->Allowed)
      {
        longest = std::isfinite(allowed) ? std::max(longest, allowed) : longest;
      }
      // Where anything is allowed, not more than what is near is looked at, either.
      std::vector<double> reaches = this->Allowed;
      std::replace_if(
        reaches.begin(), reaches.end(), [](double reach) { return !std::isfinite(reach); },
        longest);
      this->Originals.emplace(
        this->Part.Positions, this->Surfaces, this->Part.Original, std::move(reaches));
    }
    return *this->Originals;
  }
  ///@}

  MeshPart& Part;
  const std::vector<std::int8_t>& Surfaces; ///< by point
  const std::vector<double> Allowed;
  const std::vector<std::uint32_t> Homes;
  const ParallelFor& ForAll;
  PartDistance Distance;
  std::optional<TrianglesAround> Simples;
  std::optional<TrianglesAround> Originals;
};

/** Nothing is farther away. */
double DiagonalOf(const std::vector<Vector>& positions)
{
  Bounds bounds;
  for (const Vector& position : positions)
  {
    bounds.Add(position);
  }
  const Vector diagonal = bounds.High - bounds.Low;
  return std::sqrt(Dot(diagonal, diagonal));
}

}

double ToleranceExcess(const TetrahedronMesh& plain, const TetrahedronMesh& stuffed,
  const std::vector<double>& allowances, double step, const ParallelFor& parallelFor)
{
  MeasuredSurfaces surfaces(plain, stuffed, allowances, parallelFor);
  if (!surfaces.AreSound)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  LongerAllowances measure(surfaces, stuffed.Surfaces, parallelFor);
  double tooLittle = 0.0;
  LongerAllowances::Far far = measure.All();
  // If nothing is allowed, hardly anything is near.
  const bool isAllowed = std::any_of(
    allowances.begin(), allowances.end(), [](double allowance) { return allowance > 0.0; });
  if (isAllowed)
  {
    far = measure.With(tooLittle, far);
    if (!far.IsAny)
    {
      return 0.0;
    }
  }
  const auto suffices = [&](double length)
  {
    LongerAllowances::Far left = measure.With(length, far);
    if (!left.IsAny)
    {
      return true;
    }
    tooLittle = length;
    far = std::move(left);
    return false;
  };
  const double longest = DiagonalOf(stuffed.Positions);
  double enough = step > 0.0 ? step : LeastPart * longest;
  while (!suffices(enough))
  {
    if (!(enough < longest && std::isfinite(longest)))
    {
      return HUGE_VAL;
    }
    enough *= 2.0;
  }
  for (int halving = 0; halving < Halvings; ++halving)
  {
    const double middle = 0.5 * (tooLittle + enough);
    enough = suffices(middle) ? middle : enough;
  }
  return enough;
}

}
