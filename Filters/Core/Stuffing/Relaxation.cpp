// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Relaxation.h"

#include "Stuffing/BestPlace.h"
#include "Stuffing/SearchAhead.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** Points whose best places are searched for at the same time: few of them are neighbours. */
constexpr std::size_t PointsAtOnce = 64;

/** A sine that grows by less is the same but for rounding. */
constexpr double LeastGain = 1e-9;

class Relaxation
{
public:
  Relaxation(LocalMesh& mesh, const RelaxationOptions& options)
    : Mesh(mesh)
    , Options(options)
  {
  }

  std::vector<std::uint32_t> Run(const ParallelFor& parallelFor)
  {
    const std::vector<std::uint32_t> points = this->PointsInside();
    SearchAhead(
      parallelFor, points.size(), PointsAtOnce, this->Touched,
      [&](std::size_t i) { return this->BestPlaceOf(points[i]); },
      [&](std::size_t i, const Vector& /*best*/, int changes)
      { return this->Touched.IsTouched(points[i], changes); },
      [&](std::size_t i, const Vector& best) { this->MoveTo(points[i], best); });
    return std::move(this->Moved);
  }

private:
  /** Scattered, so that those searched for at the same time are mostly far from each other. */
  std::vector<std::uint32_t> PointsInside() const
  {
    std::vector<std::uint32_t> points;
    for (std::uint32_t point = 0; point < this->Mesh.Mesh().Positions.size(); ++point)
    {
      const LocalMesh::Star star = this->Mesh.StarOf(point);
      if (this->Mesh.Mesh().Surfaces[point] == 0 && star.begin() != star.end())
      {
        points.push_back(point);
      }
    }
    Scatter(points);
    return points;
  }

  /** Where a point goes; where it is now, if that is as good. */
  Vector BestPlaceOf(std::uint32_t point) const
  {
    const Vector& now = this->Mesh.At(point);
    const double worst = this->Mesh.WorstAround(point);
    if (worst >= this->Options.Wanted)
    {
      return now;
    }
    PointStar star = FacesAround(this->Mesh, point);
    const PlacedPoint best = BestPlace(star, now, this->Mesh.Mesh().OnWalls[point],
      this->Options.Axes, this->Options.Wanted,
      { 0.0, [&](const Vector& place) { return this->Options.Allows(point, place); } });
    return best.Sine > worst + LeastGain ? best.Place : now;
  }

  void MoveTo(std::uint32_t point, const Vector& place)
  {
    if (place != this->Mesh.At(point))
    {
      this->Mesh.Move(point, place);
      this->Touched.BeginChange();
      this->Touched.Touch(this->Mesh, this->Mesh.StarOf(point));
      this->Moved.push_back(point);
    }
  }

  LocalMesh& Mesh;
  const RelaxationOptions& Options;
  TouchedPoints Touched;
  std::vector<std::uint32_t> Moved;
};

}

std::vector<std::uint32_t> RelaxInside(
  LocalMesh& mesh, const RelaxationOptions& options, const ParallelFor& parallelFor)
{
  return Relaxation(mesh, options).Run(parallelFor);
}

}
