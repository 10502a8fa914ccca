// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceDistance.h"

#include "ReferenceExact.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace reference
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

using Vector = std::array<double, 3>;

Vector Difference(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector Scaled(const Vector& vector, const Vector& factors)
{
  return { factors[0] * vector[0], factors[1] * vector[1], factors[2] * vector[2] };
}

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector ToVector(const Point& point)
{
  return { double(point[0]), double(point[1]), double(point[2]) };
}

double DistanceFromSegment(
  const Vector& point, const Vector& from, const Vector& to, const Vector& spacing)
{
  const Vector edge = Scaled(Difference(to, from), spacing);
  Vector offset = Scaled(Difference(point, from), spacing);
  const double squaredLength = Dot(edge, edge);
  const double fraction =
    squaredLength > 0.0 ? std::clamp(Dot(offset, edge) / squaredLength, 0.0, 1.0) : 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    offset[axis] -= fraction * edge[axis];
  }
  return std::sqrt(Dot(offset, offset));
}

/** The corner of a triangle that is opposite to its longest side. */
int CornerOfShortSides(const std::array<Vector, 3>& corners)
{
  const auto opposite = [&](int corner)
  {
    const Vector side = Difference(corners[(corner + 1) % 3], corners[(corner + 2) % 3]);
    return Dot(side, side);
  };
  const int other = opposite(0) < opposite(1) ? 1 : 0;
  return opposite(other) < opposite(2) ? 2 : other;
}

/**
 * The distance from the plane of a triangle if the nearest point of the plane is in the triangle,
 * otherwise infinity. Thin triangles do no harm: in index space the normal is not rounded, and the
 * spacing changes its length and direction without any cancellation; in the world, the normal of a
 * needle is that of its shorter sides.
 */
double DistanceFromInterior(
  const Vector& point, const SurfaceTriangle& triangle, const Vector& spacing)
{
  const std::array<Vector, 3>& corners = triangle.Corners;
  const int corner = CornerOfShortSides(corners);
  const Vector& base = corners[corner];
  const Vector indexNormal =
    Cross(Difference(corners[(corner + 1) % 3], base), Difference(corners[(corner + 2) % 3], base));
  const Vector normal = Scaled(
    indexNormal, { spacing[1] * spacing[2], spacing[2] * spacing[0], spacing[0] * spacing[1] });
  const double length = std::sqrt(Dot(normal, normal));
  if (!(length > 0.0))
  {
    return Infinity;
  }
  for (int i = 0; i < 3; ++i)
  {
    const Vector edge = Scaled(Difference(corners[(i + 1) % 3], corners[i]), spacing);
    const Vector offset = Scaled(Difference(point, corners[i]), spacing);
    if (Dot(Cross(normal, edge), offset) < 0.0)
    {
      return Infinity;
    }
  }
  const double indexVolume = Dot(indexNormal, Difference(point, base));
  return std::abs(indexVolume * spacing[0] * spacing[1] * spacing[2]) / length;
}

/** Six times the signed volume of a tetrahedron, exactly. */
long long SixfoldVolume(const std::array<Point, 4>& vertices)
{
  std::array<std::array<long long, 3>, 3> edge;
  for (int i = 0; i < 3; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      edge[i][axis] = vertices[i + 1][axis] - vertices[0][axis];
    }
  }
  return edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) -
    edge[0][1] * (edge[1][0] * edge[2][2] - edge[1][2] * edge[2][0]) +
    edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
}

bool HasVertex(const Tetrahedron& tetrahedron, const Point& vertex)
{
  return std::find(tetrahedron.Vertices.begin(), tetrahedron.Vertices.end(), vertex) !=
    tetrahedron.Vertices.end();
}

bool HasVertices(const Tetrahedron& tetrahedron, const std::vector<Point>& vertices)
{
  return std::all_of(vertices.begin(), vertices.end(),
    [&tetrahedron](const Point& vertex) { return HasVertex(tetrahedron, vertex); });
}

bool HasAllSamples(const Hierarchy& hierarchy, const Tetrahedron& tetrahedron)
{
  return std::all_of(tetrahedron.Vertices.begin(), tetrahedron.Vertices.end(),
    [&hierarchy](const Point& vertex) { return hierarchy.IsSampled(vertex); });
}

/** The coded position of the isovertex on the edge between two vertices. */
Vector PositionBetween(const Hierarchy& hierarchy, const ScalarField& field, double isovalue,
  bool exact, const Point& a, const Point& b)
{
  const std::array<Point, 2> edge = hierarchy.YoungerFirst(a, b);
  const Isovertex isovertex{ edge[0], edge[1] };
  return exact ? ExactPosition(field, isovalue, isovertex)
               : Position(isovertex, Coefficient(field, isovalue, isovertex));
}

/**
 * The four vertices as c, i, j, k, two of each sign: c is the youngest, k has the same sign as c,
 * and i and j are in the order that makes the tetrahedron positively oriented.
 */
std::array<Point, 4> OrderedForDiagonal(
  const Hierarchy& hierarchy, std::vector<Point> upper, std::vector<Point> lower)
{
  const auto isOlder = [&hierarchy](const Point& a, const Point& b)
  { return hierarchy.Age(a) < hierarchy.Age(b); };
  std::sort(upper.begin(), upper.end(), isOlder);
  std::sort(lower.begin(), lower.end(), isOlder);
  if (isOlder(upper[1], lower[1]))
  {
    std::swap(upper, lower);
  }
  std::array<Point, 4> ordered{ upper[1], lower[0], lower[1], upper[0] };
  if (SixfoldVolume(ordered) < 0)
  {
    std::swap(ordered[1], ordered[2]);
  }
  return ordered;
}

/** An isovertex of full resolution. */
struct FineIsovertex
{
  /** Where it is in index space, in steps of 1/256. */
  Point Steps;
  /** The same in units. */
  Vector Position;
  /** Whether both ends of its edge are finite. */
  bool IsFinite;
};

FineIsovertex FineIsovertexAt(const ScalarField& field, double isovalue, const Isovertex& isovertex)
{
  const int coefficient = Coefficient(field, isovalue, isovertex);
  FineIsovertex fine;
  fine.Position = Position(isovertex, coefficient);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int difference = isovertex.Older[axis] - isovertex.Younger[axis];
    if (std::abs(difference) > 1)
    {
      throw std::logic_error("an edge of full resolution is longer than a unit step");
    }
    fine.Steps[axis] = 256 * isovertex.Younger[axis] + difference * coefficient;
  }
  fine.IsFinite =
    std::isfinite(field.At(isovertex.Younger)) && std::isfinite(field.At(isovertex.Older));
  return fine;
}

/** Whether a closed tetrahedron holds a point, given in steps of 1/256; exact. */
bool Holds(const Tetrahedron& tetrahedron, const Point& steps)
{
  std::array<Point, 4> vertices = tetrahedron.Vertices;
  for (Point& vertex : vertices)
  {
    vertex = { 256 * vertex[0], 256 * vertex[1], 256 * vertex[2] };
  }
  const bool isPositive = SixfoldVolume(vertices) > 0;
  for (int i = 0; i < 4; ++i)
  {
    std::array<Point, 4> opposite = vertices;
    opposite[i] = steps;
    const long long volume = SixfoldVolume(opposite);
    if (isPositive ? volume < 0 : volume > 0)
    {
      return false;
    }
  }
  return true;
}

/** The isovertices of full resolution, by the lattice points that their positions round down to. */
class FineIsovertices
{
public:
  FineIsovertices(const Hierarchy& hierarchy, const ScalarField& field, double isovalue)
  {
    for (const Isovertex& isovertex :
      IsoverticesOf(FullResolutionPatches(hierarchy, field, isovalue)))
    {
      const FineIsovertex fine = FineIsovertexAt(field, isovalue, isovertex);
      const Point floor{ fine.Steps[0] / 256, fine.Steps[1] / 256, fine.Steps[2] / 256 };
      this->ByFloor[floor].push_back(fine);
    }
  }

  /** Those in a closed tetrahedron. */
  std::vector<FineIsovertex> In(const Tetrahedron& tetrahedron) const
  {
    Point low = tetrahedron.Vertices[0];
    Point high = tetrahedron.Vertices[0];
    for (const Point& vertex : tetrahedron.Vertices)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], vertex[axis]);
        high[axis] = std::max(high[axis], vertex[axis]);
      }
    }
    std::vector<FineIsovertex> inside;
    for (int z = low[2]; z <= high[2]; ++z)
    {
      for (int y = low[1]; y <= high[1]; ++y)
      {
        for (int x = low[0]; x <= high[0]; ++x)
        {
          this->Append(tetrahedron, { x, y, z }, inside);
        }
      }
    }
    return inside;
  }

private:
  void Append(
    const Tetrahedron& tetrahedron, const Point& floor, std::vector<FineIsovertex>& inside) const
  {
    const auto found = this->ByFloor.find(floor);
    if (found == this->ByFloor.end())
    {
      return;
    }
    std::copy_if(found->second.begin(), found->second.end(), std::back_inserter(inside),
      [&tetrahedron](const FineIsovertex& fine) { return Holds(tetrahedron, fine.Steps); });
  }

  std::unordered_map<Point, std::vector<FineIsovertex>, PointHash> ByFloor;
};

/** A tetrahedron of a diamond, by the indices of both. */
struct Member
{
  int Diamond;
  int Index;
};

/** From index space to the world: moves positions, then scales the differences between them. */
struct World
{
  std::function<Vector(const Vector&)> Move;
  Vector Spacing;
};

/** Finds errors; holds all that they depend on. */
class ErrorFinder
{
public:
  ErrorFinder(const Hierarchy& hierarchy, const ScalarField& field, double isovalue, World world,
    bool exact, bool preserveFeatures)
    : Diamonds(hierarchy)
    , Isovertices(hierarchy, field, isovalue)
    , InWorld(std::move(world))
    , PreserveFeatures(preserveFeatures)
  {
    for (const Diamond& diamond : hierarchy.Diamonds())
    {
      this->HaveFiniteVertices.push_back(
        std::all_of(diamond.Vertices.begin(), diamond.Vertices.end(),
          [&](const Point& vertex)
          { return !hierarchy.IsSampled(vertex) || std::isfinite(field.At(vertex)); }));
      this->Patches.emplace_back();
      for (const Tetrahedron& tetrahedron : diamond.Tetrahedra)
      {
        this->Patches.back().push_back(TrianglesOf(hierarchy, field, isovalue, tetrahedron, exact));
        for (SurfaceTriangle& triangle : this->Patches.back().back())
        {
          for (Vector& corner : triangle.Corners)
          {
            corner = this->InWorld.Move(corner);
          }
        }
      }
    }
  }

  double ErrorOf(int index) const
  {
    const Diamond& diamond = this->Diamonds.At(index);
    double error = -Infinity;
    for (int i = 0; i < static_cast<int>(diamond.Tetrahedra.size()); ++i)
    {
      const std::vector<FineIsovertex> inside = this->Isovertices.In(diamond.Tetrahedra[i]);
      const bool areFinite = std::all_of(inside.begin(), inside.end(),
        [](const FineIsovertex& isovertex) { return isovertex.IsFinite; });
      if (!areFinite ||
        (!inside.empty() && (diamond.SticksOut || !this->HaveFiniteVertices[index])))
      {
        return Infinity;
      }
      const std::vector<Place> places = this->PlacesFor({ index, i });
      for (const FineIsovertex& isovertex : inside)
      {
        error = std::max(
          error, this->DistanceFrom(places, this->InWorld.Move(isovertex.Position), error));
      }
    }
    return error == Infinity && !this->PreserveFeatures ? this->DiameterOf(diamond) : error;
  }

  std::vector<double> Errors() const
  {
    std::vector<double> errors;
    errors.reserve(this->Diamonds.Size());
    for (int index = 0; index < this->Diamonds.Size(); ++index)
    {
      errors.push_back(this->ErrorOf(index));
    }
    return errors;
  }

private:
  /** Tetrahedra of which one is certain to be a leaf: the farthest one counts. */
  using Place = std::vector<Member>;

  const Tetrahedron& At(const Member& member) const
  {
    return this->Diamonds.At(member.Diamond).Tetrahedra[member.Index];
  }

  int OriginOf(const Member& member) const
  {
    return this->Diamonds.At(member.Diamond).Origins[member.Index];
  }

  /** The tetrahedron that a member was bisected from; the member must not be one of the root's. */
  Member CoarserThan(const Member& member) const
  {
    const std::array<Point, 4>& vertices = this->At(member).Vertices;
    const int origin = this->OriginOf(member);
    const std::vector<Tetrahedron>& tetrahedra = this->Diamonds.At(origin).Tetrahedra;
    for (int i = 0; i < static_cast<int>(tetrahedra.size()); ++i)
    {
      for (const Tetrahedron& half : Hierarchy::Bisect(tetrahedra[i]))
      {
        if (HasVertices(half, { vertices.begin(), vertices.end() }))
        {
          return { origin, i };
        }
      }
    }
    throw std::logic_error("no tetrahedron of the parent has this half");
  }

  /** A tetrahedron and those it was bisected from, as far up as they have its diamond's spine and
   *  all samples. */
  Place ChainFrom(const Member& member) const
  {
    const std::array<Point, 2>& spine = this->Diamonds.At(member.Diamond).Spine;
    Place chain{ member };
    while (this->OriginOf(chain.back()) >= 0)
    {
      const Member coarser = this->CoarserThan(chain.back());
      if (!HasVertices(this->At(coarser), { spine[0], spine[1] }) ||
        !HasAllSamples(this->Diamonds, this->At(coarser)))
      {
        break;
      }
      chain.push_back(coarser);
    }
    return chain;
  }

  /** Where the isovertices in a tetrahedron may find the surface. */
  std::vector<Place> PlacesFor(const Member& member) const
  {
    const Diamond& diamond = this->Diamonds.At(member.Diamond);
    std::vector<Place> places{ { member } };
    for (int i = 0; i < static_cast<int>(diamond.Tetrahedra.size()); ++i)
    {
      const Member other{ member.Diamond, i };
      if (i == member.Index || !HasAllSamples(this->Diamonds, this->At(other)))
      {
        continue;
      }
      const bool isMate = this->OriginOf(other) == this->OriginOf(member);
      places.push_back(isMate ? Place{ other } : this->ChainFrom(other));
    }
    return places;
  }

  double DistanceFrom(const Place& place, const Vector& position) const
  {
    double farthest = 0.0;
    for (const Member& member : place)
    {
      const std::vector<SurfaceTriangle>& patch = this->Patches[member.Diamond][member.Index];
      farthest = std::max(farthest, Distance(position, patch, this->InWorld.Spacing));
    }
    return farthest;
  }

  /** The distance from the nearest place, or any distance that is small enough. */
  double DistanceFrom(
    const std::vector<Place>& places, const Vector& position, double smallEnough) const
  {
    double nearest = Infinity;
    for (const Place& place : places)
    {
      nearest = std::min(nearest, this->DistanceFrom(place, position));
      if (nearest <= smallEnough)
      {
        break;
      }
    }
    return nearest;
  }

  double DiameterOf(const Diamond& diamond) const
  {
    double diameter = 0.0;
    for (const Point& a : diamond.Vertices)
    {
      for (const Point& b : diamond.Vertices)
      {
        const Vector offset =
          Scaled(Difference(this->InWorld.Move(ToVector(a)), this->InWorld.Move(ToVector(b))),
            this->InWorld.Spacing);
        diameter = std::max(diameter, std::sqrt(Dot(offset, offset)));
      }
    }
    return diameter;
  }

  const Hierarchy& Diamonds;
  FineIsovertices Isovertices;
  World InWorld;
  bool PreserveFeatures;
  std::vector<bool> HaveFiniteVertices;
  /** For every diamond, the triangles in each of its tetrahedra. */
  std::vector<std::vector<std::vector<SurfaceTriangle>>> Patches;
};

}

std::vector<SurfaceTriangle> TrianglesOf(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const Tetrahedron& tetrahedron, bool exact)
{
  if (!HasAllSamples(hierarchy, tetrahedron))
  {
    return {};
  }
  std::vector<Point> upper;
  std::vector<Point> lower;
  for (const Point& vertex : tetrahedron.Vertices)
  {
    (SignOf(field.At(vertex), isovalue) == 1 ? upper : lower).push_back(vertex);
  }
  const auto cut = [&](const Point& a, const Point& b)
  { return PositionBetween(hierarchy, field, isovalue, exact, a, b); };

  if (upper.empty() || lower.empty())
  {
    return {};
  }
  if (upper.size() == 2)
  {
    const auto [c, i, j, k] = OrderedForDiagonal(hierarchy, upper, lower);
    return { SurfaceTriangle{ { cut(c, i), cut(c, j), cut(j, k) } },
      SurfaceTriangle{ { cut(c, i), cut(j, k), cut(i, k) } } };
  }
  const bool isUpperAlone = upper.size() == 1;
  const Point& apex = isUpperAlone ? upper[0] : lower[0];
  const std::vector<Point>& base = isUpperAlone ? lower : upper;
  return { SurfaceTriangle{ { cut(apex, base[0]), cut(apex, base[1]), cut(apex, base[2]) } } };
}

double Distance(const std::array<double, 3>& point, const SurfaceTriangle& triangle,
  const std::array<double, 3>& spacing)
{
  double distance = DistanceFromInterior(point, triangle, spacing);
  for (int i = 0; i < 3; ++i)
  {
    distance = std::min(distance,
      DistanceFromSegment(point, triangle.Corners[i], triangle.Corners[(i + 1) % 3], spacing));
  }
  return distance;
}

double Distance(const std::array<double, 3>& point, const std::vector<SurfaceTriangle>& triangles,
  const std::array<double, 3>& spacing)
{
  double distance = Infinity;
  for (const SurfaceTriangle& triangle : triangles)
  {
    distance = std::min(distance, Distance(point, triangle, spacing));
  }
  return distance;
}

std::vector<double> OwnDistanceErrors(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const std::array<double, 3>& spacing, bool exact, bool preserveFeatures)
{
  const World world{ [](const Vector& point) { return point; }, spacing };
  return ErrorFinder(hierarchy, field, isovalue, world, exact, preserveFeatures).Errors();
}

Vector PlaceByCoordinates(const Vector& point, const Coordinates& coordinates)
{
  Vector place{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& along = coordinates[axis];
    std::size_t sample = 0;
    while (sample + 2 < along.size() && point[axis] >= static_cast<double>(sample + 1))
    {
      ++sample;
    }
    const double fraction = point[axis] - static_cast<double>(sample);
    place[axis] = (1.0 - fraction) * along[sample] + fraction * along[sample + 1];
  }
  return place;
}

std::vector<double> OwnDistanceErrors(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const Coordinates& coordinates, bool exact, bool preserveFeatures)
{
  const World world{ [&coordinates](const Vector& point)
    { return PlaceByCoordinates(point, coordinates); },
    { 1.0, 1.0, 1.0 } };
  return ErrorFinder(hierarchy, field, isovalue, world, exact, preserveFeatures).Errors();
}

std::vector<double> OwnDistanceErrors(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const SamplePlaces& places, bool exact, bool preserveFeatures)
{
  const auto placeOf = [&places](const Vector& point)
  {
    Vector place{};
    std::array<int, 3> cell{};
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = std::min(static_cast<int>(point[axis]), places.Dims[axis] - 2);
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      std::array<int, 3> sample{};
      for (int axis = 0; axis < 3; ++axis)
      {
        const int step = (corner >> axis) & 1;
        sample[axis] = cell[axis] + step;
        const double fraction = point[axis] - cell[axis];
        weight *= step == 1 ? fraction : 1.0 - fraction;
      }
      const int index = (sample[2] * places.Dims[1] + sample[1]) * places.Dims[0] + sample[0];
      for (int axis = 0; axis < 3; ++axis)
      {
        place[axis] += weight * places.Coordinates[3 * index + axis];
      }
    }
    return place;
  };
  const World world{ placeOf, { 1.0, 1.0, 1.0 } };
  return ErrorFinder(hierarchy, field, isovalue, world, exact, preserveFeatures).Errors();
}

}
