// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceField.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reference
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

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

/** A point of a tetrahedron and its barycentric coordinates there. */
struct InnerPoint
{
  Point Position;
  std::array<double, 4> Weights;
};

/** The sampled lattice points of a closed tetrahedron. */
std::vector<InnerPoint> InnerPoints(const Hierarchy& hierarchy, const Tetrahedron& tetrahedron)
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
  for (int axis = 0; axis < 3; ++axis)
  {
    high[axis] = std::min(high[axis], hierarchy.Dims()[axis] - 1);
  }

  const long long volume = SixfoldVolume(tetrahedron.Vertices);
  std::vector<InnerPoint> points;
  for (int z = low[2]; z <= high[2]; ++z)
  {
    for (int y = low[1]; y <= high[1]; ++y)
    {
      for (int x = low[0]; x <= high[0]; ++x)
      {
        InnerPoint point;
        point.Position = { x, y, z };
        bool isInside = true;
        for (int i = 0; i < 4; ++i)
        {
          std::array<Point, 4> opposite = tetrahedron.Vertices;
          opposite[i] = point.Position;
          point.Weights[i] =
            static_cast<double>(SixfoldVolume(opposite)) / static_cast<double>(volume);
          isInside = isInside && point.Weights[i] >= 0.0;
        }
        if (isInside)
        {
          points.push_back(point);
        }
      }
    }
  }
  return points;
}

}

double ScalarField::At(const Point& point) const
{
  const std::size_t row = static_cast<std::size_t>(point[2]) * this->Dims[1] + point[1];
  return this->Samples.at(row * this->Dims[0] + point[0]);
}

int SignOf(double value, double isovalue)
{
  return value > isovalue ? 1 : 0;
}

std::vector<Kind> Classify(const Hierarchy& hierarchy, const ScalarField& field, double isovalue)
{
  std::vector<Kind> kinds(hierarchy.Size(), Kind::Inactive);
  // Children come after their parents, so going backwards every child is known before its parents.
  for (int index = hierarchy.Size() - 1; index >= 0; --index)
  {
    const Diamond& diamond = hierarchy.At(index);
    std::array<bool, 2> isPresent{ false, false };
    for (const Point& vertex : diamond.Vertices)
    {
      if (hierarchy.IsSampled(vertex))
      {
        isPresent[SignOf(field.At(vertex), isovalue)] = true;
      }
    }
    const bool isMixed = isPresent[0] && isPresent[1];
    const bool isUniform = isPresent[0] != isPresent[1];
    if (isMixed)
    {
      kinds[index] = Kind::Active;
    }
    else if (isUniform && hierarchy.IsSampled(diamond.Center) &&
      !isPresent[SignOf(field.At(diamond.Center), isovalue)])
    {
      kinds[index] = Kind::Creation;
    }
    else if (std::any_of(diamond.Children.begin(), diamond.Children.end(),
               [&kinds](int child) { return kinds[child] != Kind::Inactive; }))
    {
      kinds[index] = Kind::Relevant;
    }
  }
  return kinds;
}

Counts Count(const Hierarchy& hierarchy, const ScalarField& field, double isovalue,
  const std::vector<Kind>& kinds)
{
  const auto isCut = [&](const Point& a, const Point& b)
  {
    return hierarchy.IsSampled(a) && hierarchy.IsSampled(b) &&
      SignOf(field.At(a), isovalue) != SignOf(field.At(b), isovalue);
  };

  Counts counts;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    counts.Active += kinds[index] == Kind::Active;
    counts.Creation += kinds[index] == Kind::Creation;
    counts.Relevant += kinds[index] == Kind::Creation || kinds[index] == Kind::Relevant;
    const Diamond& diamond = hierarchy.At(index);
    for (const Point& vertex : diamond.Vertices)
    {
      counts.Isovertices += isCut(diamond.Center, vertex);
    }
  }
  for (const std::array<Point, 2>& edge : hierarchy.BaseEdges())
  {
    counts.BaseIsovertices += isCut(edge[0], edge[1]);
  }
  return counts;
}

std::vector<Point> DomainPoints(const Hierarchy& hierarchy, int diamond)
{
  std::vector<Point> points;
  for (const Tetrahedron& tetrahedron : hierarchy.At(diamond).Tetrahedra)
  {
    for (const InnerPoint& point : InnerPoints(hierarchy, tetrahedron))
    {
      points.push_back(point.Position);
    }
  }
  return points;
}

double OwnFieldError(const Hierarchy& hierarchy, const ScalarField& field, int diamond)
{
  if (hierarchy.At(diamond).SticksOut)
  {
    return Infinity;
  }
  double error = 0.0;
  for (const Tetrahedron& tetrahedron : hierarchy.At(diamond).Tetrahedra)
  {
    for (const InnerPoint& point : InnerPoints(hierarchy, tetrahedron))
    {
      const double value = field.At(point.Position);
      if (!std::isfinite(value))
      {
        return Infinity;
      }
      double interpolated = 0.0;
      for (int i = 0; i < 4; ++i)
      {
        interpolated += point.Weights[i] * field.At(tetrahedron.Vertices[i]);
      }
      error = std::max(error, std::abs(value - interpolated));
    }
  }
  return error;
}

std::vector<double> OwnFieldErrors(const Hierarchy& hierarchy, const ScalarField& field)
{
  std::vector<double> errors;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    errors.push_back(OwnFieldError(hierarchy, field, index));
  }
  return errors;
}

ValueRange DomainRange(const Hierarchy& hierarchy, const ScalarField& field, int diamond)
{
  ValueRange range{ Infinity, -Infinity };
  for (const Point& point : DomainPoints(hierarchy, diamond))
  {
    const double value = field.At(point);
    if (!std::isnan(value))
    {
      range.Minimum = std::min(range.Minimum, value);
      range.Maximum = std::max(range.Maximum, value);
    }
  }
  return range;
}

bool IsCrossed(const Hierarchy& hierarchy, const ScalarField& field, double isovalue, int diamond)
{
  std::array<bool, 2> isPresent{ false, false };
  for (const Point& point : DomainPoints(hierarchy, diamond))
  {
    isPresent[SignOf(field.At(point), isovalue)] = true;
  }
  return isPresent[0] && isPresent[1];
}

std::vector<bool> CrossedDomains(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue)
{
  std::vector<bool> crossed;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    crossed.push_back(IsCrossed(hierarchy, field, isovalue, index));
  }
  return crossed;
}

}
