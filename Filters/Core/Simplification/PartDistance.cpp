// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/PartDistance.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isodiamond
{

PartDistance::PartDistance(MeshPart& part, bool isStartNear)
  : Part(part)
  , IsStartNear(isStartNear)
  , NearAtStart(part.Near)
  , Cover(part.Positions, part.Original)
  , Shadow(part.Positions, part.Original, part.Allowances)
  , OriginalAt(AnyTriangleAt(part.Positions.size(), part.Original))
{
}

/** Of one mesh. */
class PartDistance::Comparison
{
public:
  Comparison(PartDistance& all, const LinkedTriangles& simple,
    const std::vector<std::uint32_t>& homes, const std::vector<bool>& isTouched)
    : All(all)
    , Part(all.Part)
    , Cover(all.Cover)
    , Shadow(all.Shadow)
    , Simple(simple)
    , Homes(homes)
    , IsTouched(isTouched)
    , OriginalAt(all.OriginalAt)
    , SimpleCover(all.Part.Positions, simple)
    , AnyAt(AnyTriangleAt(all.Part.Positions.size(), simple))
  {
  }

  Faults Run()
  {
    this->GoForth();
    this->GoBack();
    return std::move(this->Found);
  }

private:
  /** Whether a triangle is what it was at the start. */
  bool IsAsAtStart(std::uint32_t number) const
  {
    const Triangle& start = this->Part.Simple.Triangles[number];
    Triangle now = this->Simple.Triangles[number];
    std::rotate(now.begin(), now.begin() + PlaceOf(now, start[0]), now.end());
    return this->Simple.IsThere(number) && now == start;
  }

  /** Whether all that a triangle of the original was near to at the start is there again. */
  bool IsNearAsAtStart(std::uint32_t original)
  {
    const IdRange near = this->All.NearAtStart[original];
    const bool isSo = this->All.IsStartNear && !near.empty() &&
      std::all_of(
        near.begin(), near.end(), [&](std::uint32_t number) { return this->IsAsAtStart(number); });
    if (isSo)
    {
      this->Part.Near.Begin(original);
      for (const std::uint32_t number : near)
      {
        this->Part.Near.Add(original, number);
      }
    }
    return isSo;
  }

  /** Each triangle of the original that was near to what is another one now. */
  void GoForth()
  {
    for (std::uint32_t i = 0; i < this->Part.Original.Triangles.size(); ++i)
    {
      const IdRange near = this->Part.Near[i];
      const bool isKnown = !near.empty() &&
        std::none_of(
          near.begin(), near.end(), [&](std::uint32_t number) { return this->IsTouched[number]; });
      if (!isKnown && !this->IsNearAsAtStart(i) && !this->IsNearForth(i))
      {
        this->MarkOriginal(i);
      }
    }
  }

  bool IsNearForth(std::uint32_t original)
  {
    const std::array<Vector, 3> corners =
      this->Part.Original.Corners(this->Part.Positions, original);
    const double allowance = this->Part.Allowances[original];
    // What is near to a triangle is convex: one that all corners are near to will do.
    std::uint32_t start = None;
    const auto isNear = [&](std::uint32_t number)
    {
      if (number == None || number == start || !this->Simple.IsThere(number))
      {
        return false;
      }
      start = number;
      return this->SimpleCover.IsNear(number, corners.data(), 3, allowance);
    };
    const Triangle& points = this->Part.Original.Triangles[original];
    const IdRange before = this->Part.Near[original];
    if (isNear(this->Homes[this->Part.Positions.size() + original]) ||
      std::any_of(points.begin(), points.end(),
        [&](std::uint32_t point) { return isNear(this->Homes[point]); }) ||
      std::any_of(points.begin(), points.end(),
        [&](std::uint32_t point) { return isNear(this->AnyAt[point]); }) ||
      std::any_of(before.begin(), before.end(), isNear))
    {
      this->Part.Near.Begin(original);
      this->Part.Near.Add(original, start);
      return true;
    }
    return start != None && this->IsNearInPieces(original, corners, allowance, start);
  }

  bool IsNearInPieces(std::uint32_t original, const std::array<Vector, 3>& corners,
    double allowance, std::uint32_t start)
  {
    this->Last = start;
    const bool isNear = this->SimpleCover.Covers(
      corners, start, allowance, [&] { this->NewNear.clear(); },
      [&](std::uint32_t simple, const Vector* piece, int count)
      {
        if (!this->SimpleCover.IsNear(simple, piece, count, allowance))
        {
          return false;
        }
        this->Last = simple;
        if (std::find(this->NewNear.begin(), this->NewNear.end(), simple) == this->NewNear.end())
        {
          this->NewNear.push_back(simple);
        }
        return true;
      });
    if (isNear)
    {
      this->Part.Near.Begin(original);
      for (const std::uint32_t number : this->NewNear)
      {
        this->Part.Near.Add(original, number);
      }
    }
    else
    {
      this->Found.Triangles.push_back(this->Last);
    }
    return isNear;
  }

  /** Nothing is near to a triangle of the original. */
  void MarkOriginal(std::uint32_t original)
  {
    const auto mark = [&](const IdRange& triangles) {
      this->Found.Triangles.insert(this->Found.Triangles.end(), triangles.begin(), triangles.end());
    };
    const IdRange near = this->Part.Near[original];
    mark(near);
    if (std::all_of(near.begin(), near.end(),
          [&](std::uint32_t number) { return this->IsAsAtStart(number); }))
    {
      mark(this->All.NearAtStart[original]); // of which something is another one
    }
    const Triangle& points = this->Part.Original.Triangles[original];
    std::copy_if(points.begin(), points.end(), std::back_inserter(this->Found.Points),
      [&](std::uint32_t point) { return this->AnyAt[point] == None; });
    this->Part.Near.Begin(original);
  }

  /** Each triangle that is another one now. */
  void GoBack()
  {
    // Those of the original that are near to each.
    const CellsAtPoints nearTo(this->Simple.Triangles.size(), this->Part.Original.Triangles.size(),
      [&](std::size_t original) { return this->Part.Near[original]; });
    for (std::uint32_t i = 0; i < this->Simple.Triangles.size(); ++i)
    {
      const bool isKnown = !this->IsTouched[i] || (this->All.IsStartNear && this->IsAsAtStart(i));
      if (this->Simple.IsThere(i) && !isKnown && !this->IsNearBack(i, nearTo))
      {
        this->Found.Triangles.push_back(i);
      }
    }
  }

  /** Whether a triangle of the simpler mesh is near to the original, and faces as that does. */
  bool IsNearBack(std::uint32_t simple, const CellsAtPoints& nearTo)
  {
    const std::array<Vector, 3> corners = this->Simple.Corners(this->Part.Positions, simple);
    const auto add = [&](std::uint32_t number)
    {
      const IdRange near = nearTo[number];
      this->Around.insert(this->Around.end(), near.begin(), near.end());
    };
    this->Around.clear();
    add(simple);
    for (const std::uint32_t neighbour : this->Simple.Neighbours[simple])
    {
      if (this->Around.empty() && neighbour != None)
      {
        add(neighbour); // all could be near to it, too
      }
    }
    for (const std::uint32_t point : this->Simple.Triangles[simple])
    {
      if (this->Around.empty() && this->OriginalAt[point] != None)
      {
        this->Around.push_back(this->OriginalAt[point]);
      }
    }
    if (this->Around.empty())
    {
      return false;
    }
    return this->IsInShadow(simple, corners) || this->IsNearBackInPieces(corners);
  }

  /** Whether the shadow of what is around a triangle of the simpler mesh tells that it is near.
   * Seen along its normal, or where the surface bends along that of the original, or of what is
   * beside it: one of these ways may be short where another one is not. */
  bool IsInShadow(std::uint32_t simple, const std::array<Vector, 3>& corners)
  {
    const Vector normal = this->SimpleCover.Normal(simple);
    Vector below{};
    for (const std::uint32_t original : this->Around)
    {
      below = below + this->Cover.Normal(original);
    }
    Vector beside = normal;
    for (const std::uint32_t neighbour : this->Simple.Neighbours[simple])
    {
      beside = beside + (neighbour != None ? this->SimpleCover.Normal(neighbour) : Vector{});
    }
    const std::array<Vector, 3> ways = { normal, Unit(below), Unit(beside) };
    return std::any_of(ways.begin(), ways.end(),
      [&](const Vector& way)
      {
        std::vector<std::uint32_t> triangles = this->Around;
        return this->Shadow.Covers(corners, way, triangles);
      });
  }

  bool IsNearBackInPieces(const std::array<Vector, 3>& corners)
  {
    const Vector middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    const std::uint32_t start = this->Cover.NearestOf(this->Around, middle);
    Vector mean{}; // of the normals
    const bool isNear = this->Cover.Covers(
      corners, start, this->Part.Allowances[start], [&] { mean = {}; },
      [&](std::uint32_t original, const Vector* piece, int count)
      {
        const bool isSo =
          this->Cover.IsNear(original, piece, count, this->Part.Allowances[original]);
        if (isSo)
        {
          mean = mean + Covering::AreaOf(piece, count) * this->Cover.Normal(original);
        }
        return isSo;
      });
    return isNear && Dot(mean, Cross(corners[1] - corners[0], corners[2] - corners[0])) >= 0.0;
  }

  const PartDistance& All;
  MeshPart& Part;
  Covering& Cover;
  ShadowTest& Shadow;
  const LinkedTriangles& Simple;
  const std::vector<std::uint32_t>& Homes;
  const std::vector<bool>& IsTouched;
  const std::vector<std::uint32_t>& OriginalAt;
  Covering SimpleCover;
  std::vector<std::uint32_t> AnyAt;   ///< by point: a triangle of the simpler mesh
  std::vector<std::uint32_t> NewNear; ///< of one triangle of the original
  std::vector<std::uint32_t> Around;  ///< one triangle of the simpler mesh
  std::uint32_t Last = None;          ///< where a way ended
  Faults Found;
};

PartDistance::Faults PartDistance::Find(const LinkedTriangles& simple,
  const std::vector<std::uint32_t>& homes, const std::vector<bool>& isTouched)
{
  return Comparison(*this, simple, homes, isTouched).Run();
}

}
