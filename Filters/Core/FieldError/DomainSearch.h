// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DomainSearch_h
#define isodiamond_DomainSearch_h

#include "FieldError/BlockFits.h"
#include "FieldError/DomainSummary.h"
#include "Lattice/KuhnTetrahedron.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace isodiamond
{

/**
 * The summary of a large domain by branch and bound.
 *
 * Bisecting a diamond's tetrahedra down to class 0 leaves tetrahedra that lie in cubes of the
 * lattice, each along a path of three of its cube's edges, from one corner to the opposite one. The
 * linear fit to the samples in the cube bounds the error in the tetrahedron. Only where the bound
 * or the range of the samples exceeds what was found so far is a tetrahedron cut into eight of half
 * the size; in the smallest cubes its samples are visited.
 */
template <typename T>
class DomainSearch
{
public:
  /** The least scale of diamonds with tetrahedra that fill cubes of the finest fits. */
  static constexpr int LeastScale = 3;

  /** @param samples of some slices, from firstSlice on
   *  @param fits to those: what lies in other slices is not looked at
   *  @param wanted of the range
   *  @param valueAt called with the diamond's vertices that are sampled */
  template <typename ValueAt>
  DomainSearch(const Grid& grid, const SampleView<T>& samples, int firstSlice,
    const BlockFits& fits, const WantedRange& wanted, const Place& place, const ValueAt& valueAt)
    : TheGrid(grid)
    , Samples(samples)
    , FirstSlice(firstSlice)
    , Fits(fits)
    , Wanted(wanted)
    , TopLevel(place.Scale - LeastScale)
    , SticksOut(grid.SticksOut(place.Position, place.Scale))
  {
    const TypeTable& shape = ShapeOf(place.Position);
    std::array<Corner, MaximumVertices> vertices;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      const Point vertex = VertexAt(place, shape.Offsets[i]);
      vertices[i] = { vertex, grid.IsSampled(vertex) ? valueAt(vertex) : 0.0 };
    }
    CutIntoPaths(shape, vertices, MiddleCorner,
      [&](const KuhnTetrahedron<Corner>& path)
      {
        Part root;
        root.Path = path;
        if (this->FindBound(root, this->TopLevel))
        {
          this->Roots.push_back(root);
        }
      });
  }

  /** Adds what it finds to what is already known. */
  SummaryBuilder Run(const SummaryBuilder& known)
  {
    this->Sums = this->SticksOut ? SummaryBuilder(known).AddError(SummaryBuilder::Infinity) : known;
    std::sort(this->Roots.begin(), this->Roots.end(), HasGreaterBound);
    for (const Part& root : this->Roots)
    {
      this->Search(root, this->TopLevel);
    }
    return this->Sums;
  }

private:
  static constexpr int FinestEdge = BlockFits::FinestEdge;

  struct Corner
  {
    Point Position{};
    double Value = 0.0; ///< the interpolant's
  };

  static Corner MiddleCorner(const Corner& a, const Corner& b)
  {
    return { MiddleOf(a.Position, b.Position), 0.5 * (a.Value + b.Value) };
  }

  /** A tetrahedron of the domain in a cube with a fit. */
  struct Part
  {
    KuhnTetrahedron<Corner> Path{};
    const BlockFit* Cube = nullptr;
    double Bound = 0.0; ///< of the error
  };

  static bool HasGreaterBound(const Part& a, const Part& b) { return a.Bound > b.Bound; }

  /** Finds a tetrahedron's cube and bound. @return whether it can hold samples that are its own,
   *  and the slab's: cubes that begin where the grid ends share theirs with others, unless the
   *  domain has no other part there. */
  bool FindBound(Part& part, int level) const
  {
    Point first{};
    Point cube{};
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = std::min(part.Path[0].Position[axis], part.Path[3].Position[axis]);
      const int last = this->TheGrid.Last(axis) - (this->SticksOut ? 0 : 1);
      if (first[axis] < 0 || first[axis] > last)
      {
        return false;
      }
      cube[axis] = std::min(first[axis], this->TheGrid.Last(axis) - 1) / (FinestEdge << level);
    }
    if (!this->Fits.Has(level, cube[2]))
    {
      return false;
    }
    part.Cube = &this->Fits(level, cube);
    double apart = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      const double fitted = part.Cube->At(part.Path[i].Position + -1 * first);
      apart = std::max(apart, std::fabs(fitted - part.Path[i].Value));
    }
    part.Bound = apart + part.Cube->Residual;
    return true;
  }

  /** Looks into a tetrahedron if that can matter. */
  void Search(const Part& part, int level)
  {
    const BlockFit& cube = *part.Cube;
    if (cube.IsFinite() && !this->Sums.CanGrow(cube.Range, part.Bound, this->Wanted))
    {
      return;
    }
    if (level == 0)
    {
      this->Visit(part);
      return;
    }
    std::array<Part, 8> eighths; // greatest bound first
    auto end = eighths.begin();
    ForEachEighth(part.Path, MiddleCorner,
      [&](const KuhnTetrahedron<Corner>& path)
      {
        end->Path = path;
        if (this->FindBound(*end, level - 1))
        {
          std::rotate(std::upper_bound(eighths.begin(), end, *end, HasGreaterBound), end, end + 1);
          ++end;
        }
      });
    std::for_each(
      eighths.begin(), end, [&](const Part& eighth) { this->Search(eighth, level - 1); });
  }

  /** A row of samples in a tetrahedron, along the third edge of its path. */
  struct Row
  {
    const T* First = nullptr;
    std::int64_t Stride = 0;
    int Count = 0;
    Point Position{}; ///< of the first
    Point Step{};
    double Start = 0.0; ///< the interpolant there
    double Slope = 0.0;

    double Sample(int i) const { return static_cast<double>(this->First[i * this->Stride]); }
    double Interpolated(int i) const { return this->Start + i * this->Slope; }
  };

  /** Calls body(row) for all rows of a tetrahedron in one of the smallest cubes: the sample that is
   *  a steps along the path's first edge, b along the second and c along the third has a >= b >= c.
   */
  template <typename Body>
  void ForEachRow(const KuhnTetrahedron<Corner>& path, const Body& body) const
  {
    std::array<Point, 3> steps{};
    std::array<std::int64_t, 3> strides{};
    std::array<double, 3> slopes{};
    for (int i = 0; i < 3; ++i)
    {
      const Point edge = path[i + 1].Position + -1 * path[i].Position;
      steps[i] = { edge[0] / FinestEdge, edge[1] / FinestEdge, edge[2] / FinestEdge };
      strides[i] = this->Samples.Index(steps[i]);
      slopes[i] = (path[i + 1].Value - path[i].Value) / FinestEdge;
    }
    const T* first = this->Samples.Pointer() +
      this->Samples.Index(path[0].Position + Point{ 0, 0, -this->FirstSlice });
    for (int a = 0; a <= FinestEdge; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        body(Row{ first + a * strides[0] + b * strides[1], strides[2], b + 1,
          path[0].Position + a * steps[0] + b * steps[1], steps[2],
          path[0].Value + a * slopes[0] + b * slopes[1], slopes[2] });
      }
    }
  }

  /** Visits the samples of a tetrahedron in one of the smallest cubes. */
  void Visit(const Part& part)
  {
    const bool isWhole = this->TheGrid.IsSampled(part.Path[0].Position) &&
      this->TheGrid.IsSampled(part.Path[3].Position);
    if (!isWhole || !part.Cube->IsFinite())
    {
      this->VisitAny(part.Path, isWhole);
    }
    else if (this->Sums.HasEnoughRange(this->Wanted))
    {
      this->VisitFinite(part.Path, std::false_type());
    }
    else
    {
      this->VisitFinite(part.Path, std::true_type());
    }
  }

  void VisitAny(const KuhnTetrahedron<Corner>& path, bool isWhole)
  {
    this->ForEachRow(path,
      [&](const Row& row)
      {
        for (int i = 0; i < row.Count; ++i)
        {
          if (isWhole || this->TheGrid.IsSampled(row.Position + i * row.Step))
          {
            this->Sums.Add(row.First[i * row.Stride], row.Interpolated(i));
          }
        }
      });
  }

  template <typename WithRange>
  void VisitFinite(const KuhnTetrahedron<Corner>& path, WithRange withRange)
  {
    // By turns: no maximum waits for the one before.
    FiniteExtremes even;
    FiniteExtremes odd;
    this->ForEachRow(path,
      [&](const Row& row)
      {
        even.Add(row.Sample(0), row.Start, withRange);
        for (int i = 1; i < row.Count; i += 2)
        {
          odd.Add(row.Sample(i), row.Interpolated(i), withRange);
          if (i + 1 < row.Count)
          {
            even.Add(row.Sample(i + 1), row.Interpolated(i + 1), withRange);
          }
        }
      });
    even.Add(odd);
    this->Sums.Add(even.Summary());
  }

  const Grid& TheGrid;
  const SampleView<T>& Samples;
  int FirstSlice;
  const BlockFits& Fits;
  const WantedRange& Wanted;
  int TopLevel;
  bool SticksOut; ///< then the error is infinite, and only the range is left to find
  SummaryBuilder Sums;
  std::vector<Part> Roots;
};

}

#endif
