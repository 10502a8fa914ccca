// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/BestPlace.h"

namespace isodiamond
{
namespace
{

/** The first step, as a part of the distance to the nearest point. */
constexpr double FirstStep = 0.4;
constexpr int StepSizes = 6;
constexpr int StepsOfOneSize = 2;

/** Unit vectors of the sums of axes, with coefficients -1, 0, 1, that do not leave a wall. */
std::vector<Vector> Directions(Walls::Type walls, const std::array<Vector, 3>& axes)
{
  std::vector<Vector> directions;
  for (int code = 0; code < 27; ++code)
  {
    const std::array<int, 3> parts = { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 };
    Vector sum{};
    bool stays = (walls & Walls::Fixed) == 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      stays = stays && (parts[axis] == 0 || !Walls::OnAxis(walls, axis));
      sum = sum + static_cast<double>(parts[axis]) * axes[axis];
    }
    const double length = std::sqrt(Dot(sum, sum));
    if (stays && length > 0.0)
    {
      directions.push_back((1.0 / length) * sum);
    }
  }
  return directions;
}

}

PointStar FacesAround(const LocalMesh& mesh, std::uint32_t point)
{
  PointStar star;
  for (const std::uint32_t tetrahedron : mesh.StarOf(point))
  {
    star.Add(mesh.Mesh(), mesh.CornersOf(tetrahedron), point);
  }
  return star;
}

PlacedPoint BestPlace(PointStar& star, const Vector& from, Walls::Type walls,
  const std::array<Vector, 3>& axes, double wanted, const Reach& reach)
{
  PlacedPoint best{ from, star.WorstAt(from, -1.0) };
  const auto tryAt = [&](const Vector& place)
  {
    const double sine = star.WorstAt(place, best.Sine); // mostly decided by one look
    if (sine > best.Sine && (!reach.Allows || reach.Allows(place)))
    {
      best = { place, sine };
      return true;
    }
    return false;
  };
  if (walls == 0)
  {
    tryAt(star.Mean());
  }
  const std::vector<Vector> directions = Directions(walls, axes);
  double step = reach.FirstStep > 0.0 ? reach.FirstStep : FirstStep * star.Radius(from);
  for (int size = 0; size < StepSizes && best.Sine < wanted; ++size, step *= 0.5)
  {
    bool goesOn = true;
    for (int i = 0; i < StepsOfOneSize && goesOn && best.Sine < wanted; ++i)
    {
      goesOn = false;
      for (const Vector& direction : directions)
      {
        goesOn = tryAt(best.Place + step * direction) || goesOn;
      }
    }
  }
  return best;
}

}
