// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DomainSearch_h
#define isodiamond_DomainSearch_h

#include "BlockFits.h"
#include "DomainSummary.h"
#include "MidpointOrder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isodiamond
{

/**
 * The summary of a large domain by branch and bound.
 *
 * Bisecting a diamond's tetrahedra down to class 0 leaves tetrahedra that lie in cubes of the
 * lattice, each along a path of three of its cube's edges, from one corner to the opposite. The
 * linear fit to the samples in the cube bounds the error in the tetrahedron. Only where the bound
 * or the range of the samples exceeds what was found is a tetrahedron cut into eight of half the
 * size; in the smallest cubes its samples are visited.
 */
template <typename T>
class DomainSearch
{
public:
  /** The least scale of diamonds with tetrahedra that fill cubes of the finest fits. */
  static constexpr int LeastScale = 3;

  DomainSearch(
    const Grid& grid, const SampleView<T>& samples, const BlockFits& fits, const Place& place)
    : Domain(grid)
    , Samples(samples)
    , Fits(fits)
    , TopLevel(place.Scale - LeastScale)
    , Sums(grid.SticksOut(place.Position, place.Scale) ? SummaryBuilder::Infinity : 0.0)
  {
    this->CutDiamond(place);
  }

  DomainSummary Run()
  {
    std::sort(this->Roots.begin(), this->Roots.end(), HasGreaterBound);
    for (const Tetrahedron& root : this->Roots)
    {
      this->Search(root, this->TopLevel);
    }
    return this->Sums.Result();
  }

private:
  static constexpr int FinestEdge = BlockFits::FinestEdge;

  struct Tetrahedron
  {
    std::array<Point, 4> Corners{}; ///< of class 0: along the path
    std::array<double, 4> Values{}; ///< the interpolant's
    const BlockFit* Cube = nullptr; ///< the samples around it
    double Bound = 0.0;             ///< of the error
  };

  static bool HasGreaterBound(const Tetrahedron& a, const Tetrahedron& b)
  {
    return a.Bound > b.Bound;
  }

  double ValueAt(const Point& point) const
  {
    return this->Domain.IsSampled(point) ? this->Samples(point) : 0.0;
  }

  /** Cuts the diamond's tetrahedra into those of class 0. */
  void CutDiamond(const Place& place)
  {
    const TypeTable& shape = ShapeOf(place.Position);
    const Point centre = Centre(place);
    const auto vertex = [&](int i) { return centre + (1 << place.Scale) * shape.Offsets[i]; };
    const double middle =
      0.5 * (this->ValueAt(vertex(shape.Spine[0])) + this->ValueAt(vertex(shape.Spine[1])));
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      Tetrahedron half;
      half.Corners[3] = centre;
      half.Values[3] = middle;
      for (int j = 0; j < 3; ++j)
      {
        half.Corners[j] = vertex(shape.HalfTetrahedra[i].Vertices[j]);
        half.Values[j] = this->ValueAt(half.Corners[j]);
      }
      this->AddRoots(half, 2 - shape.DiamondClass);
    }
  }

  /** Bisects the longest edge a number of times, then puts the corners in the path's order. */
  void AddRoots(Tetrahedron tetrahedron, int bisections)
  {
    std::array<int, 2> longest = { 0, 1 };
    for (const std::array<int, 2>& edge : TetrahedronEdges)
    {
      longest =
        SquaredLength(tetrahedron, edge) > SquaredLength(tetrahedron, longest) ? edge : longest;
    }
    Swap(tetrahedron, 0, longest[0]);
    Swap(tetrahedron, 3, longest[1]);
    if (bisections > 0)
    {
      for (const Tetrahedron& half : Bisect(tetrahedron, 3))
      {
        this->AddRoots(half, bisections - 1);
      }
      return;
    }
    if (SquaredLength(tetrahedron, { 0, 1 }) > SquaredLength(tetrahedron, { 0, 2 }))
    {
      Swap(tetrahedron, 1, 2);
    }
    if (this->FindBound(tetrahedron, this->TopLevel))
    {
      this->Roots.push_back(tetrahedron);
    }
  }

  static std::int64_t SquaredLength(const Tetrahedron& tetrahedron, const std::array<int, 2>& edge)
  {
    std::int64_t sum = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t difference =
        tetrahedron.Corners[edge[0]][axis] - tetrahedron.Corners[edge[1]][axis];
      sum += difference * difference;
    }
    return sum;
  }

  static void Swap(Tetrahedron& tetrahedron, int i, int j)
  {
    std::swap(tetrahedron.Corners[i], tetrahedron.Corners[j]);
    std::swap(tetrahedron.Values[i], tetrahedron.Values[j]);
  }

  /** Bisects the edge between the first and another corner. Of a path, bisecting the edge to the
   *  last corner, then to the second last and to the second, gives eight paths again (Maubach). */
  static std::array<Tetrahedron, 2> Bisect(const Tetrahedron& whole, int last)
  {
    const Point sum = whole.Corners[0] + whole.Corners[last];
    const Point middle = { sum[0] / 2, sum[1] / 2, sum[2] / 2 };
    const double value = 0.5 * (whole.Values[0] + whole.Values[last]);
    std::array<Tetrahedron, 2> halves = { whole, whole };
    for (int i = 0; i < last; ++i)
    {
      halves[1].Corners[i] = whole.Corners[i + 1];
      halves[1].Values[i] = whole.Values[i + 1];
    }
    for (Tetrahedron& half : halves)
    {
      half.Corners[last] = middle;
      half.Values[last] = value;
    }
    return halves;
  }

  /** Finds a tetrahedron's cube and bound. @return whether the cube meets the grid. */
  bool FindBound(Tetrahedron& tetrahedron, int level) const
  {
    Point first{};
    Point cube{};
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = std::min(tetrahedron.Corners[0][axis], tetrahedron.Corners[3][axis]);
      cube[axis] = first[axis] / (FinestEdge << level);
      if (first[axis] < 0 || first[axis] >= this->Domain.Last(axis))
      {
        return false;
      }
    }
    tetrahedron.Cube = &this->Fits(level, cube);
    double apart = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      const double fitted = tetrahedron.Cube->At(tetrahedron.Corners[i] + -1 * first);
      apart = std::max(apart, std::fabs(fitted - tetrahedron.Values[i]));
    }
    tetrahedron.Bound = apart + tetrahedron.Cube->Residual;
    return true;
  }

  /** Looks into a tetrahedron if that can matter. */
  void Search(const Tetrahedron& tetrahedron, int level)
  {
    const BlockFit& cube = *tetrahedron.Cube;
    if (cube.IsFinite() && !this->Sums.CanGrow(cube.Range, tetrahedron.Bound))
    {
      return;
    }
    if (level == 0)
    {
      this->Visit(tetrahedron);
      return;
    }
    std::array<Tetrahedron, 8> eighths; // greatest bound first
    auto end = eighths.begin();
    for (const Tetrahedron& half : Bisect(tetrahedron, 3))
    {
      for (const Tetrahedron& quarter : Bisect(half, 2))
      {
        for (const Tetrahedron& eighth : Bisect(quarter, 1))
        {
          *end = eighth;
          if (this->FindBound(*end, level - 1))
          {
            std::rotate(
              std::upper_bound(eighths.begin(), end, *end, HasGreaterBound), end, end + 1);
            ++end;
          }
        }
      }
    }
    std::for_each(
      eighths.begin(), end, [&](const Tetrahedron& eighth) { this->Search(eighth, level - 1); });
  }

  /** Visits the samples of a tetrahedron in one of the smallest cubes: a first steps along the
   *  path's first edge, b along the second and c along the third, a >= b >= c. */
  void Visit(const Tetrahedron& tetrahedron)
  {
    const std::array<Point, 4>& corners = tetrahedron.Corners;
    const std::array<double, 4>& values = tetrahedron.Values;
    std::array<Point, 3> steps{};
    std::array<std::int64_t, 3> strides{};
    std::array<double, 3> slopes{};
    for (int i = 0; i < 3; ++i)
    {
      const Point edge = corners[i + 1] + -1 * corners[i];
      steps[i] = { edge[0] / FinestEdge, edge[1] / FinestEdge, edge[2] / FinestEdge };
      strides[i] = this->Samples.Index(steps[i]);
      slopes[i] = (values[i + 1] - values[i]) / FinestEdge;
    }
    const bool isCut = !this->Domain.IsSampled(corners[0]) || !this->Domain.IsSampled(corners[3]);
    const T* first = this->Samples.Pointer() + this->Samples.Index(corners[0]);
    SummaryBuilder sums = this->Sums;
    for (int a = 0; a <= FinestEdge; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        const T* row = first + a * strides[0] + b * strides[1];
        const double start = values[0] + a * slopes[0] + b * slopes[1];
        const Point point = corners[0] + a * steps[0] + b * steps[1];
        for (int c = 0; c <= b; ++c)
        {
          if (!isCut || this->Domain.IsSampled(point + c * steps[2]))
          {
            sums.Add(row[c * strides[2]], start + c * slopes[2]);
          }
        }
      }
    }
    this->Sums = sums;
  }

  const Grid& Domain;
  const SampleView<T>& Samples;
  const BlockFits& Fits;
  int TopLevel;
  SummaryBuilder Sums;
  std::vector<Tetrahedron> Roots;
};

}

#endif
