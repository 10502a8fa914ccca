// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/DistanceTestTools.h"

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

namespace
{

/** @param at maps [0, 1] on each axis to the world */
World CurvedWorld(const std::array<int, 3>& dims,
  const std::function<isodiamond::Vector(double, double, double)>& at)
{
  std::vector<double> positions;
  for (int z = 0; z < dims[2]; ++z)
  {
    for (int y = 0; y < dims[1]; ++y)
    {
      for (int x = 0; x < dims[0]; ++x)
      {
        const isodiamond::Vector place =
          at(x / (dims[0] - 1.0), y / (dims[1] - 1.0), z / (dims[2] - 1.0));
        positions.insert(positions.end(), place.begin(), place.end());
      }
    }
  }
  return { std::move(positions), dims };
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

World Bent(const std::array<int, 3>& dims)
{
  return CurvedWorld(dims,
    [](double x, double y, double z) -> isodiamond::Vector
    {
      const double turn = 0.3 + 0.8 * z;
      const double u = 5.0 * x + 1.5 * std::sin(3.0 * y);
      const double v = 7.0 * y - 1.5 * std::sin(3.0 * x);
      return { std::cos(turn) * u - std::sin(turn) * v + 5.0,
        std::sin(turn) * u + std::cos(turn) * v - 40.0, 6.0 * z + std::sin(2.0 * x * y) };
    });
}

World Wound(const std::array<int, 3>& dims)
{
  return CurvedWorld(dims,
    [](double x, double y, double z) -> isodiamond::Vector
    {
      const double angle = 6.283185307179586 * (x < 1.0 ? x : 0.0);
      return { 5.0 * y * std::cos(angle), 5.0 * y * std::sin(angle), 8.0 * z };
    });
}

std::vector<World> StraightWorldsFor(const std::array<int, 3>& dims)
{
  return { { Spacing(0.5, 2.0, 1.25) },
    { isodiamond::GridGeometry(UnevenCoordinates(dims, 20.0)) } };
}

std::vector<World> WorldsFor(const std::array<int, 3>& dims)
{
  std::vector<World> worlds = StraightWorldsFor(dims);
  worlds.push_back(Bent(dims));
  worlds.push_back(Wound(dims));
  return worlds;
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

int CountOverturned(const Volume& volume, const isodiamond::GridGeometry& world)
{
  using isodiamond::operator-;
  return static_cast<int>(std::count_if(volume.Tetrahedra.begin(), volume.Tetrahedra.end(),
    [&](const auto& tetrahedron)
    {
      const isodiamond::Vector first = world(volume.Points[tetrahedron[0]]);
      const auto to = [&](int corner) { return world(volume.Points[tetrahedron[corner]]) - first; };
      const double sixVolume = isodiamond::Dot(isodiamond::Cross(to(1), to(2)), to(3));
      return !(world.Mirrors() ? sixVolume < 0.0 : sixVolume > 0.0);
    }));
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

std::array<NearestTriangle::Part, 2> NearestTriangle::Part::Halves() const
{
  const std::size_t middle = this->First + (this->End - this->First) / 2;
  return { Part{ 2 * this->Number + 1, this->First, middle },
    Part{ 2 * this->Number + 2, middle, this->End } };
}

NearestTriangle::NearestTriangle(SurfaceTriangles triangles)
  : Triangles(std::move(triangles))
{
  if (!this->Triangles.empty())
  {
    this->MakeBoxes(this->All());
  }
}

void NearestTriangle::MakeBoxes(const Part& part)
{
  const auto at = [this](std::size_t i)
  { return this->Triangles.begin() + static_cast<std::ptrdiff_t>(i); };
  Box box{ at(part.First)->Corners[0], at(part.First)->Corners[0] };
  std::for_each(at(part.First), at(part.End),
    [&box](const reference::SurfaceTriangle& triangle)
    {
      for (const std::array<double, 3>& corner : triangle.Corners)
      {
        box.Add(corner);
      }
    });
  this->Boxes.resize(std::max(this->Boxes.size(), part.Number + 1));
  this->Boxes[part.Number] = box;
  if (part.IsLeaf())
  {
    return;
  }
  const auto length = [&box](int axis) { return box.High[axis] - box.Low[axis]; };
  const int yz = length(1) > length(2) ? 1 : 2;
  const int axis = length(0) > length(yz) ? 0 : yz;
  const auto halves = part.Halves();
  std::nth_element(at(part.First), at(halves[1].First), at(part.End),
    [axis](const reference::SurfaceTriangle& a, const reference::SurfaceTriangle& b)
    {
      return a.Corners[0][axis] + a.Corners[1][axis] + a.Corners[2][axis] <
        b.Corners[0][axis] + b.Corners[1][axis] + b.Corners[2][axis];
    });
  this->MakeBoxes(halves[0]);
  this->MakeBoxes(halves[1]);
}

double NearestTriangle::Distance(const std::array<double, 3>& point, double enough) const
{
  if (this->Triangles.empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  // The next point is often near the last one.
  double distance = reference::Distance(point, this->Triangles[this->Last], { 1.0, 1.0, 1.0 });
  this->Search(this->All(), point, enough, distance);
  return distance;
}

void NearestTriangle::Search(
  const Part& part, const std::array<double, 3>& point, double enough, double& distance) const
{
  if (distance <= enough || this->Boxes[part.Number].SquaredDistance(point) >= distance * distance)
  {
    return;
  }
  if (part.IsLeaf())
  {
    for (std::size_t i = part.First; i < part.End; ++i)
    {
      const double other = reference::Distance(point, this->Triangles[i], { 1.0, 1.0, 1.0 });
      this->Last = other < distance ? i : this->Last;
      distance = std::min(distance, other);
    }
    return;
  }
  const auto halves = part.Halves();
  const bool isFirstNearer = this->Boxes[halves[0].Number].SquaredDistance(point) <=
    this->Boxes[halves[1].Number].SquaredDistance(point);
  this->Search(halves[isFirstNearer ? 0 : 1], point, enough, distance);
  this->Search(halves[isFirstNearer ? 1 : 0], point, enough, distance);
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
  // No point of a triangle is farther from its nearest corner than this part of the longest side.
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

/** Checks that points in a box are near triangles, and describes the farthest that is not. */
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
    this->Farthest += 1e-12 * largest; // rounding, also of corners that a grid has turned
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
