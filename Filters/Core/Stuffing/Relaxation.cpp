// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Relaxation.h"

#include "Stuffing/BestPlace.h"

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
    , MovedWith(mesh.Mesh().Positions.size(), 0)
  {
  }

  std::vector<std::uint32_t> Run(const ParallelFor& parallelFor)
  {
    const std::vector<std::uint32_t> points = this->PointsInside();
    std::vector<Vector> best(PointsAtOnce);
    for (std::size_t first = 0; first < points.size(); first += PointsAtOnce)
    {
      ++this->Batch;
      const std::size_t count = std::min(PointsAtOnce, points.size() - first);
      ForEachIndex(parallelFor, count, 1,
        [&](std::int64_t i) { best[i] = this->BestPlaceOf(points[first + i]); });
      for (std::size_t i = 0; i < count; ++i)
      {
        const std::uint32_t point = points[first + i];
        this->MoveTo(point, this->IsBesideMoved(point) ? this->BestPlaceOf(point) : best[i]);
      }
    }
    return std::move(this->Moved);
  }

private:
  /** Scattered, so that those searched for at the same time are mostly far from each other. */
  std::vector<std::uint32_t> PointsInside() const
  {
    std::vector<std::uint32_t> points;
    for (std::uint32_t point = 0; point < this->MovedWith.size(); ++point)
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

  /** Whether anything around a point has moved since its best place was searched for. */
  bool IsBesideMoved(std::uint32_t point) const
  {
    const LocalMesh::Star star = this->Mesh.StarOf(point);
    return std::any_of(star.begin(), star.end(),
      [&](std::uint32_t tetrahedron)
      {
        const Corners& corners = this->Mesh.CornersOf(tetrahedron);
        return std::any_of(corners.begin(), corners.end(),
          [&](std::uint32_t corner) { return this->MovedWith[corner] == this->Batch; });
      });
  }

  void MoveTo(std::uint32_t point, const Vector& place)
  {
    if (place != this->Mesh.At(point))
    {
      this->Mesh.Move(point, place);
      this->MovedWith[point] = this->Batch;
      this->Moved.push_back(point);
    }
  }

  LocalMesh& Mesh;
  const RelaxationOptions& Options;
  std::uint32_t Batch = 0;
  std::vector<std::uint32_t> MovedWith; ///< by point: the last batch with which it moved
  std::vector<std::uint32_t> Moved;
};

}

std::vector<std::uint32_t> RelaxInside(
  LocalMesh& mesh, const RelaxationOptions& options, const ParallelFor& parallelFor)
{
  return Relaxation(mesh, options).Run(parallelFor);
}

}
