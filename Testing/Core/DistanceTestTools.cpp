// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceTestTools.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <utility>

namespace test
{
namespace
{

double LongestSide(const reference::SurfaceTriangle& triangle)
{
  double longest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const isodiamond::Vector side =
      isodiamond::operator-(triangle.Corners[(i + 1) % 3], triangle.Corners[i]);
    longest = std::max(longest, std::sqrt(isodiamond::Dot(side, side)));
  }
  return longest;
}

}

isodiamond::AffineMap Spacing(double x, double y, double z)
{
  isodiamond::AffineMap world;
  world.Rows = { { { x, 0, 0, 5 }, { 0, y, 0, -3 }, { 0, 0, z, 1 } } };
  return world;
}

isodiamond::AxisCoordinates UnevenCoordinates(const std::array<int, 3>& dims, double ratio)
{
  isodiamond::AxisCoordinates coordinates;
  std::mt19937 random(dims[0] + 100 * dims[1]);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    double at = axis == 0 ? 5.0 : -40.0;
    for (int i = 0; i < dims[axis]; ++i)
    {
      coordinates[axis].push_back(at);
      const double power = axis == 2 ? part(random) : i / (dims[axis] - 1.0);
      const double step = std::round(1024.0 * 0.25 * std::pow(ratio, power)) / 1024.0;
      at += axis == 1 ? -step : step;
    }
  }
  return coordinates;
}

SurfaceTriangles Placed(const SurfaceTriangles& triangles, const isodiamond::GridGeometry& world)
{
  SurfaceTriangles placed = triangles;
  for (reference::SurfaceTriangle& triangle : placed)
  {
    for (std::array<double, 3>& corner : triangle.Corners)
    {
      corner = world(corner);
    }
  }
  return placed;
}

SurfaceTriangles Placed(const Mesh& mesh, const isodiamond::GridGeometry& world)
{
  SurfaceTriangles placed;
  for (const std::array<std::int32_t, 3>& t : mesh.Triangles)
  {
    reference::SurfaceTriangle triangle;
    for (int i = 0; i < 3; ++i)
    {
      const Corner& point = mesh.Points[t[i]];
      triangle.Corners[i] = world({ point[0], point[1], point[2] });
    }
    placed.push_back(triangle);
  }
  return placed;
}

SurfaceTriangles Placed(const Volume& volume, int surface, const isodiamond::GridGeometry& world)
{
  SurfaceTriangles placed;
  for (const std::array<std::int32_t, 3>& t : SurfaceFaces(volume, surface))
  {
    placed.push_back(
      { { world(volume.Points[t[0]]), world(volume.Points[t[1]]), world(volume.Points[t[2]]) } });
  }
  return placed;
}

void NearestTriangle::Box::Add(const std::array<double, 3>& point)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Low[axis] = std::min(this->Low[axis], point[axis]);
    this->High[axis] = std::max(this->High[axis], point[axis]);
  }
}

double NearestTriangle::Box::SquaredDistance(const std::array<double, 3>& point) const
{
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double beside =
      std::max({ this->Low[axis] - point[axis], point[axis] - this->High[axis], 0.0 });
    squared += beside * beside;
  }
  return squared;
}

NearestTriangle::NearestTriangle(SurfaceTriangles triangles)
  : Triangles(std::move(triangles))
{
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    const auto& corners = this->Triangles[i].Corners;
    this->Boxes.push_back({ corners[0], corners[0] });
    if (i % GroupSize == 0)
    {
      this->Groups.push_back({ corners[0], corners[0] });
    }
    for (const std::array<double, 3>& corner : corners)
    {
      this->Boxes.back().Add(corner);
      this->Groups.back().Add(corner);
    }
  }
}

double NearestTriangle::Distance(const std::array<double, 3>& point, double enough) const
{
  constexpr std::array<double, 3> unit = { 1.0, 1.0, 1.0 };
  if (this->Triangles.empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  double distance = reference::Distance(point, this->Triangles[this->Last], unit);
  const std::size_t first = this->Last / GroupSize; // the next point often is near to the last one
  for (std::size_t k = 0; k < this->Groups.size() && distance > enough; ++k)
  {
    const std::size_t group = (first + k) % this->Groups.size();
    if (this->Groups[group].SquaredDistance(point) >= distance * distance)
    {
      continue;
    }
    const std::size_t end = std::min((group + 1) * GroupSize, this->Triangles.size());
    for (std::size_t i = group * GroupSize; i < end; ++i)
    {
      if (this->Boxes[i].SquaredDistance(point) < distance * distance)
      {
        const double other = reference::Distance(point, this->Triangles[i], unit);
        this->Last = other < distance ? i : this->Last;
        distance = std::min(distance, other);
      }
    }
  }
  return distance;
}

double ForEachSample(const reference::SurfaceTriangle& triangle, double step,
  const std::function<void(const std::array<double, 3>&)>& body)
{
  const auto& [a, b, c] = triangle.Corners;
  const double longest = LongestSide(triangle);
  const int parts = std::max(1, static_cast<int>(std::ceil(longest / step)));
  for (int i = 0; i <= parts; ++i)
  {
    for (int j = 0; j <= parts - i; ++j)
    {
      std::array<double, 3> point{};
      for (int axis = 0; axis < 3; ++axis)
      {
        point[axis] =
          ((parts - i - j) * a[axis] + i * b[axis] + j * c[axis]) / static_cast<double>(parts);
      }
      body(point);
    }
  }
  // Nothing in a triangle is farther from all corners than this part of the longest side.
  return longest / parts / std::sqrt(3.0);
}

void SampledDistance::Add(
  const reference::SurfaceTriangle& triangle, const NearestTriangle& to, double step)
{
  const double gap = ForEachSample(triangle, step,
    [&](const std::array<double, 3>& point)
    { this->Largest = std::max(this->Largest, to.Distance(point, this->Largest)); });
  this->Gap = std::max(this->Gap, gap);
}

namespace
{

/** Whether points in a box are within a distance of triangles, and the farthest one that is not. */
class NearnessCheck
{
public:
  NearnessCheck(const Promise& promise, const SurfaceTriangles& to)
    : Promised(promise)
    , Nearest(to)
    , Farthest(promise.Tolerance * (1.0 + 1e-9))
  {
    double largest = 0.0;
    for (const reference::SurfaceTriangle& triangle : to)
    {
      for (const double coordinate : triangle.Corners[0])
      {
        largest = std::max(largest, std::abs(coordinate));
      }
    }
    this->Farthest += 1e-13 * largest; // rounding
  }

  void operator()(const std::array<double, 3>& point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(point[axis] > this->Promised.Within[0][axis] &&
            point[axis] < this->Promised.Within[1][axis]))
      {
        return;
      }
    }
    const double distance = this->Nearest.Distance(point, this->Farthest);
    if (distance > this->Farthest)
    {
      this->Farthest = distance;
      std::ostringstream text;
      text << distance << " instead of " << this->Promised.Tolerance << " at " << point[0] << " "
           << point[1] << " " << point[2];
      this->Text = text.str();
    }
  }

  const std::string& Fault() const { return this->Text; }

private:
  const Promise& Promised;
  NearestTriangle Nearest;
  double Farthest;
  std::string Text;
};

}

std::string FaultOf(
  const Promise& promise, const SurfaceTriangles& full, const SurfaceTriangles& mesh)
{
  NearnessCheck forth(promise, mesh);
  const std::size_t stride =
    1 + static_cast<std::size_t>(3.0 * static_cast<double>(full.size()) / promise.MostSamples);
  for (std::size_t i = 0; i < full.size() && promise.Forth; i += stride)
  {
    std::for_each(full[i].Corners.begin(), full[i].Corners.end(), std::ref(forth));
  }
  double samples = 0.0;
  for (const reference::SurfaceTriangle& triangle : mesh)
  {
    const double parts = LongestSide(triangle) / promise.Step;
    samples += 3.0 + 0.5 * parts * parts;
  }
  const double coarser = std::max(1.0, std::sqrt(samples / promise.MostSamples));
  NearnessCheck back(promise, full);
  for (std::size_t i = 0; i < mesh.size() && promise.Back; ++i)
  {
    ForEachSample(mesh[i], promise.Step * coarser, std::ref(back));
  }
  return (forth.Fault().empty() ? "" : "full resolution: " + forth.Fault()) +
    (back.Fault().empty() ? "" : " mesh: " + back.Fault());
}

std::array<std::array<double, 3>, 2> Placed(
  const isodiamond::Box& box, const isodiamond::GridGeometry& world)
{
  const isodiamond::Vector a = world(box.Minimum);
  const isodiamond::Vector b = world(box.Maximum);
  std::array<std::array<double, 3>, 2> placed{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double rounding = 1e-9 * (std::abs(a[axis]) + std::abs(b[axis]));
    placed[0][axis] = std::min(a[axis], b[axis]) + rounding;
    placed[1][axis] = std::max(a[axis], b[axis]) - rounding;
  }
  return placed;
}

}
