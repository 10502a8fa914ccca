// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchDistance_h
#define isodiamond_PatchDistance_h

#include "AffineMap.h"
#include "RefinedSet.h"
#include "SurfacePatch.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace isodiamond
{

/** An isovertex in index space, in units of 1/256: exact. */
using FinePosition = std::array<std::int32_t, 3>;
inline constexpr std::int32_t FineUnits = 256;

using Vector = std::array<double, 3>;

inline Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
inline double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/**
 * World lengths in index space: maps fine positions to a space in which distances are the world's
 * but orientation and origin do not matter, by the upper triangular factor of the map's metric.
 */
class WorldMetric
{
public:
  explicit WorldMetric(const AffineMap& world)
  {
    const auto metric = [&](int i, int j)
    {
      double sum = 0.0;
      for (const std::array<double, 4>& row : world.Rows)
      {
        sum += row[i] * row[j];
      }
      return sum;
    };
    // Cholesky: rows of the factor one after the other.
    for (int i = 0; i < 3; ++i)
    {
      for (int j = i; j < 3; ++j)
      {
        double rest = metric(i, j);
        for (int k = 0; k < i; ++k)
        {
          rest -= this->Factor[k][i] * this->Factor[k][j];
        }
        this->Factor[i][j] = i == j ? std::sqrt(rest) : rest / this->Factor[i][i];
      }
    }
  }

  Vector operator()(double x, double y, double z) const
  {
    const auto& f = this->Factor;
    return { f[0][0] * x + f[0][1] * y + f[0][2] * z, f[1][1] * y + f[1][2] * z, f[2][2] * z };
  }
  Vector operator()(const FinePosition& p) const
  {
    constexpr double unit = 1.0 / FineUnits;
    return (*this)(unit * p[0], unit * p[1], unit * p[2]);
  }

private:
  std::array<std::array<double, 3>, 3> Factor{};
};

/** Squared distances to a triangle. */
class TriangleDistance
{
public:
  TriangleDistance() = default;
  TriangleDistance(const Vector& a, const Vector& b, const Vector& c)
    : Corner(a)
    , First(b - a)
    , Second(c - a)
    , FirstFirst(Dot(this->First, this->First))
    , FirstSecond(Dot(this->First, this->Second))
    , SecondSecond(Dot(this->Second, this->Second))
  {
    const Vector& u = this->First;
    const Vector& v = this->Second;
    const Vector normal = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    const double squaredLength = Dot(normal, normal);
    const double inverse = squaredLength > 0.0 ? 1.0 / squaredLength : 0.0;
    this->InverseArea = inverse;
    const double scale = std::sqrt(inverse);
    this->Normal = { scale * normal[0], scale * normal[1], scale * normal[2] };
  }

  double Squared(const Vector& point) const
  {
    const Vector p = point - this->Corner;
    const double alongFirst = Dot(p, this->First);
    const double alongSecond = Dot(p, this->Second);
    const double s = this->SecondSecond * alongFirst - this->FirstSecond * alongSecond;
    const double t = this->FirstFirst * alongSecond - this->FirstSecond * alongFirst;
    if (s >= 0.0 && t >= 0.0 && (s + t) * this->InverseArea <= 1.0 && this->InverseArea > 0.0)
    {
      const double height = Dot(p, this->Normal);
      return height * height;
    }
    // Outside of the prism over the triangle: to the nearest of its sides.
    const Vector third = this->Second - this->First;
    const double toFirst = SquaredToSide(p, this->First, this->FirstFirst, alongFirst);
    const double toSecond = SquaredToSide(p, this->Second, this->SecondSecond, alongSecond);
    const Vector fromThird = p - this->First;
    const double toThird =
      SquaredToSide(fromThird, third, Dot(third, third), Dot(fromThird, third));
    return std::fmin(toFirst, std::fmin(toSecond, toThird));
  }

private:
  static double SquaredToSide(
    const Vector& p, const Vector& side, double squaredLength, double along)
  {
    const double place =
      along <= 0.0 ? 0.0 : (along >= squaredLength ? 1.0 : along / squaredLength);
    const Vector rest = { p[0] - place * side[0], p[1] - place * side[1], p[2] - place * side[2] };
    return Dot(rest, rest);
  }

  Vector Corner{};
  Vector First{};
  Vector Second{};
  Vector Normal{};
  double FirstFirst = 0.0;
  double FirstSecond = 0.0;
  double SecondSecond = 0.0;
  double InverseArea = 0.0; ///< of the squared length of the normal; 0 for a degenerate triangle
};

/** A tetrahedron of the hierarchy: one of the halves that its youngest vertex's diamond makes. */
struct HalfPlace
{
  Place Parent; ///< a stored diamond
  std::uint32_t Rank = 0;
  const HalfTetrahedron* Half = nullptr;

  const TypeTable& Shape() const { return ShapeOf(this->Parent.Position); }
  Place Child() const { return ChildPlace(this->Shape(), this->Parent, this->Half->Child); }
};

/** Squared distances to the patch of a tetrahedron. */
class PatchDistance
{
public:
  PatchDistance(const IsodiamondHierarchy& hierarchy, const WorldMetric& metric,
    const HalfPlace& tetrahedron, int surface)
  {
    const SurfacePatch patch = PatchOf(hierarchy, tetrahedron.Rank, *tetrahedron.Half, surface);
    this->Count = patch.TriangleCount;
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      std::array<Vector, 3> corners;
      for (int j = 0; j < 3; ++j)
      {
        corners[j] = metric(Corner(hierarchy, tetrahedron, patch.Triangles[i][j], surface));
      }
      this->Triangles[i] = { corners[0], corners[1], corners[2] };
    }
  }

  bool IsEmpty() const { return this->Count == 0; }

  /** @pre the patch is not empty */
  double Squared(const Vector& point) const
  {
    const double first = this->Triangles[0].Squared(point);
    return this->Count == 1 ? first : std::fmin(first, this->Triangles[1].Squared(point));
  }

private:
  /** The isovertex on an edge of a half-tetrahedron. */
  static FinePosition Corner(const IsodiamondHierarchy& hierarchy, const HalfPlace& tetrahedron,
    std::uint8_t edge, int surface)
  {
    const HalfTetrahedron& half = *tetrahedron.Half;
    if (edge < OwnEdgeCount)
    {
      return IsovertexAt(
        hierarchy, tetrahedron.Parent, tetrahedron.Rank, half.Vertices[edge], surface);
    }
    const OuterEdge& outer = half.OuterEdges[edge - OwnEdgeCount];
    const Point position =
      tetrahedron.Parent.Position + tetrahedron.Shape().Offsets[outer.OwnerVertex];
    const int step = outer.OwnerStep;
    const Place owner{ tetrahedron.Parent.Scale + step,
      { position[0] >> step, position[1] >> step, position[2] >> step } };
    const auto rank = static_cast<std::uint32_t>(hierarchy.Diamonds().Rank(owner));
    return IsovertexAt(hierarchy, owner, rank, outer.OwnerEdge, surface);
  }

public:
  /** The isovertex of a stored diamond on one of its subdivision edges. */
  static FinePosition IsovertexAt(const IsodiamondHierarchy& hierarchy, const Place& place,
    std::uint32_t rank, int edge, int surface)
  {
    const std::uint32_t lower = hierarchy.Edges(rank);
    const std::uint32_t before = (1U << edge) - 1U;
    const int index = surface == 0
      ? PopCount(lower & before)
      : PopCount(lower) + PopCount(hierarchy.UpperEdges(rank) & before);
    const std::int32_t along = hierarchy.Isovertices(rank)[index];
    const Point& offset = tables::Parities[Parity(place.Position)].Offsets[edge];
    return (1 << place.Scale) * (FineUnits * place.Position + along * offset);
  }

  int Count = 0;
  std::array<TriangleDistance, 2> Triangles;
};

}

#endif
