// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/PartDistance.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isodiamond
{
namespace
{

/** This many triangles are worth a thread. */
constexpr std::size_t GroupSize = 1024;

/** How many triangles are looked at for something that is near. */
constexpr std::size_t MostSeen = 64;

std::size_t GroupsOf(std::size_t count)
{
  return (count + GroupSize - 1) / GroupSize;
}

/** Calls look(i) for all of a group. @param count of all groups */
template <typename Look>
void ForEachOfGroup(std::size_t group, std::size_t count, const Look& look)
{
  const std::size_t end = std::min(count, (group + 1) * GroupSize);
  for (std::size_t i = group * GroupSize; i < end; ++i)
  {
    look(static_cast<std::uint32_t>(i));
  }
}

void Append(const std::vector<std::uint32_t>& more, std::vector<std::uint32_t>& all)
{
  all.insert(all.end(), more.begin(), more.end());
}

}

PartDistance::PartDistance(MeshPart& part, bool isStartNear, bool mayTurnOver)
  : Part(part)
  , IsStartNear(isStartNear)
  , MayTurnOver(mayTurnOver)
  , NearAtStart(part.Near)
  , OriginalSpaces([&part] { return std::make_unique<OriginalSpace>(part); })
  , OriginalAt(AnyTriangleAt(part.Positions.size(), part.Original))
{
}

/** What the threads that look at one mesh share. */
class PartDistance::Comparison
{
public:
  Comparison(PartDistance& all, const LinkedTriangles& simple,
    const std::vector<std::uint32_t>& homes, const std::vector<bool>& isTouched)
    : All(all)
    , Simple(simple)
    , Homes(homes)
    , IsTouched(isTouched)
    , SimpleCovers(
        [this] { return std::make_unique<Covering>(this->All.Part.Positions, this->Simple); })
    , AnyAt(AnyTriangleAt(all.Part.Positions.size(), simple))
  {
  }

  Faults Run(const ParallelFor& parallelFor)
  {
    this->GoForth(parallelFor);
    this->GoBack(parallelFor);
    return std::move(this->Found);
  }

private:
  class Forth;
  class Back;

  void GoForth(const ParallelFor& parallelFor);
  void GoBack(const ParallelFor& parallelFor);

  /** Whether a triangle is what it was at the start. */
  bool IsAsAtStart(std::uint32_t number) const
  {
    return this->Simple.IsThere(number) &&
      AreSame(this->All.Part.Simple.Triangles[number], this->Simple.Triangles[number]);
  }

  PartDistance& All;
  const LinkedTriangles& Simple;
  const std::vector<std::uint32_t>& Homes;
  const std::vector<bool>& IsTouched;
  WorkSpaces<Covering> SimpleCovers;
  std::vector<std::uint32_t> AnyAt; ///< by point: a triangle of the simpler mesh
  Faults Found;
};

/** From some triangles of the original to the simpler mesh. */
class PartDistance::Comparison::Forth
{
public:
  /** @param cover over the simpler mesh */
  Forth(const Comparison& whole, Covering& cover)
    : Whole(whole)
    , Part(whole.All.Part)
    , Cover(cover)
  {
  }

  struct Result
  {
    /** New near lists: the triangle of the original, and an item; None where a list begins. */
    std::vector<std::pair<std::uint32_t, std::uint32_t>> Near;
    Faults Found;
  };

  /** @return what has been found of all that was looked at */
  Result Take() { return std::move(this->Made); }

  /** Looks at a triangle of the original, if what it was near to has changed. */
  void Look(std::uint32_t original)
  {
    const IdRange near = this->Part.Near[original];
    const bool isKnown = !near.empty() &&
      std::none_of(near.begin(), near.end(),
        [&](std::uint32_t number) { return this->Whole.IsTouched[number]; });
    if (!isKnown && !this->IsNearAsAtStart(original) && !this->IsNear(original))
    {
      this->Mark(original);
    }
  }

private:
  template <typename Numbers>
  void SetNear(std::uint32_t original, const Numbers& numbers)
  {
    this->Made.Near.emplace_back(original, None);
    for (const std::uint32_t number : numbers)
    {
      this->Made.Near.emplace_back(original, number);
    }
  }

  /** Whether all that a triangle of the original was near to at the start is there again. */
  bool IsNearAsAtStart(std::uint32_t original)
  {
    const IdRange near = this->Whole.All.NearAtStart[original];
    const bool isSo = this->Whole.All.IsStartNear && !near.empty() &&
      std::all_of(near.begin(), near.end(),
        [&](std::uint32_t number) { return this->Whole.IsAsAtStart(number); });
    if (isSo)
    {
      this->SetNear(original, near);
    }
    return isSo;
  }

  bool IsNear(std::uint32_t original)
  {
    const std::array<Vector, 3> corners =
      this->Part.Original.Corners(this->Part.Positions, original);
    const double allowance = this->Part.Allowances[original];
    // The region near a triangle is convex: one that all corners are near to will do.
    std::uint32_t start = None;
    const auto isNear = [&](std::uint32_t number)
    {
      if (number == None || number == start || !this->Whole.Simple.IsThere(number))
      {
        return false;
      }
      start = number;
      return this->Cover.IsNear(number, corners.data(), 3, allowance);
    };
    const Triangle& points = this->Part.Original.Triangles[original];
    const IdRange before = this->Part.Near[original];
    const std::vector<std::uint32_t>& homes = this->Whole.Homes;
    if (isNear(homes[this->Part.Positions.size() + original]) ||
      std::any_of(
        points.begin(), points.end(), [&](std::uint32_t point) { return isNear(homes[point]); }) ||
      std::any_of(points.begin(), points.end(),
        [&](std::uint32_t point) { return isNear(this->Whole.AnyAt[point]); }) ||
      std::any_of(before.begin(), before.end(), isNear))
    {
      this->SetNear(original, std::array<std::uint32_t, 1>{ start });
      return true;
    }
    return start != None && this->IsNearInPieces(original, corners, allowance, start);
  }

  bool IsNearInPieces(std::uint32_t original, const std::array<Vector, 3>& corners,
    double allowance, std::uint32_t start)
  {
    std::uint32_t last = start; // where the way ended
    const bool isNear = this->Cover.Covers(
      corners, start, allowance, [&] { this->NewNear.clear(); },
      [&](std::uint32_t simple, const Vector* piece, int count)
      {
        if (!this->Cover.IsNear(simple, piece, count, allowance))
        {
          return false;
        }
        last = simple;
        if (std::find(this->NewNear.begin(), this->NewNear.end(), simple) == this->NewNear.end())
        {
          this->NewNear.push_back(simple);
        }
        return true;
      });
    if (isNear)
    {
      this->SetNear(original, this->NewNear);
    }
    else
    {
      this->Made.Found.Triangles.push_back(last);
    }
    return isNear;
  }

  /** Marks what is at fault if nothing is near to a triangle of the original. */
  void Mark(std::uint32_t original)
  {
    const auto mark = [&](const IdRange& triangles)
    {
      std::vector<std::uint32_t>& found = this->Made.Found.Triangles;
      found.insert(found.end(), triangles.begin(), triangles.end());
    };
    const IdRange near = this->Part.Near[original];
    mark(near);
    if (std::all_of(near.begin(), near.end(),
          [&](std::uint32_t number) { return this->Whole.IsAsAtStart(number); }))
    {
      mark(this->Whole.All.NearAtStart[original]); // something of which has changed
    }
    const Triangle& points = this->Part.Original.Triangles[original];
    std::copy_if(points.begin(), points.end(), std::back_inserter(this->Made.Found.Points),
      [&](std::uint32_t point) { return this->Whole.AnyAt[point] == None; });
    this->SetNear(original, std::array<std::uint32_t, 0>{});
  }

  const Comparison& Whole;
  const MeshPart& Part;
  Covering& Cover;
  std::vector<std::uint32_t> NewNear; ///< of one triangle
  Result Made;
};

/** From triangles of the simpler mesh to the original. */
class PartDistance::Comparison::Back
{
public:
  /** @param nearTo the triangles of the original that are near to each
   *  @param simple,original over the two meshes */
  Back(
    const Comparison& whole, const CellsAtPoints& nearTo, Covering& simple, OriginalSpace& original)
    : Whole(whole)
    , Part(whole.All.Part)
    , NearTo(nearTo)
    , SimpleCover(simple)
    , Cover(original.Cover)
    , Shadow(original.Shadow)
  {
  }

  /** Whether a triangle of the simpler mesh is gone, known, or near to the original and faces as
   *  that does, if it has to. */
  bool IsFine(std::uint32_t simple)
  {
    const bool isKnown = !this->Whole.IsTouched[simple] ||
      (this->Whole.All.IsStartNear && this->Whole.IsAsAtStart(simple));
    return !this->Whole.Simple.IsThere(simple) || isKnown || this->IsNear(simple);
  }

private:
  bool IsNear(std::uint32_t simple)
  {
    const std::array<Vector, 3> corners = this->Whole.Simple.Corners(this->Part.Positions, simple);
    this->FindAround(simple);
    return !this->Around.empty() &&
      (this->IsInShadow(simple, corners) || this->IsNearInPieces(corners));
  }

  /** Finds which triangles of the original may be near to a triangle. */
  void FindAround(std::uint32_t simple)
  {
    const auto add = [&](std::uint32_t number)
    {
      const IdRange near = this->NearTo[number];
      this->Around.insert(this->Around.end(), near.begin(), near.end());
    };
    this->Around.clear();
    add(simple);
    for (const std::uint32_t neighbour : this->Whole.Simple.Neighbours[simple])
    {
      if (this->Around.empty() && neighbour != None)
      {
        add(neighbour); // all could be near to it, too
      }
    }
    for (const std::uint32_t point : this->Whole.Simple.Triangles[simple])
    {
      if (this->Around.empty() && this->Whole.All.OriginalAt[point] != None)
      {
        this->Around.push_back(this->Whole.All.OriginalAt[point]);
      }
    }
    // Around new points there may be none: go on until something is near.
    std::vector<std::uint32_t> seen(this->Around.empty() ? 1 : 0, simple);
    for (std::size_t at = 0; this->Around.empty() && at < std::min(seen.size(), MostSeen); ++at)
    {
      for (const std::uint32_t neighbour : this->Whole.Simple.Neighbours[seen[at]])
      {
        if (neighbour != None && std::find(seen.begin(), seen.end(), neighbour) == seen.end())
        {
          seen.push_back(neighbour);
          add(neighbour);
        }
      }
    }
  }

  /** Whether the shadow of what is around a triangle of the simpler mesh shows that it is near.
   * Seen along its normal or, where the surface bends, along that of the original or of what is
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
    for (const std::uint32_t neighbour : this->Whole.Simple.Neighbours[simple])
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

  bool IsNearInPieces(const std::array<Vector, 3>& corners)
  {
    const std::vector<double>& allowances = this->Part.Allowances;
    const Vector middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    const std::uint32_t start = this->Cover.NearestOf(this->Around, middle);
    Vector mean{}; // of the normals
    const bool isNear = this->Cover.Covers(
      corners, start, allowances[start], [&] { mean = {}; },
      [&](std::uint32_t original, const Vector* piece, int count)
      {
        const bool isSo = this->Cover.IsNear(original, piece, count, allowances[original]);
        if (isSo)
        {
          mean = mean + Covering::AreaOf(piece, count) * this->Cover.Normal(original);
        }
        return isSo;
      });
    return isNear &&
      (this->Whole.All.MayTurnOver ||
        Dot(mean, Cross(corners[1] - corners[0], corners[2] - corners[0])) >= 0.0);
  }

  const Comparison& Whole;
  const MeshPart& Part;
  const CellsAtPoints& NearTo;
  Covering& SimpleCover;
  Covering& Cover;
  ShadowTest& Shadow;
  std::vector<std::uint32_t> Around; ///< around one triangle
};

/** Looks at all triangles of the original. Lists are in these triangles' order, whoever found them.
 */
void PartDistance::Comparison::GoForth(const ParallelFor& parallelFor)
{
  MeshPart& part = this->All.Part;
  const std::size_t count = part.Original.Triangles.size();
  std::vector<Forth::Result> results(GroupsOf(count));
  ForEachIndex(parallelFor, results.size(), 1,
    [&](std::size_t group)
    {
      this->SimpleCovers.Lend(
        [&](Covering& cover)
        {
          Forth forth(*this, cover);
          ForEachOfGroup(group, count, [&](std::uint32_t i) { forth.Look(i); });
          results[group] = forth.Take();
        });
    });
  for (const Forth::Result& result : results)
  {
    for (const auto& [original, number] : result.Near)
    {
      if (number == None)
      {
        part.Near.Begin(original);
      }
      else
      {
        part.Near.Add(original, number);
      }
    }
    Append(result.Found.Triangles, this->Found.Triangles);
    Append(result.Found.Points, this->Found.Points);
  }
}

/** Looks at all triangles that have changed. */
void PartDistance::Comparison::GoBack(const ParallelFor& parallelFor)
{
  const std::size_t count = this->Simple.Triangles.size();
  const CellsAtPoints nearTo(count, this->All.Part.Original.Triangles.size(),
    [&](std::size_t original) { return this->All.Part.Near[original]; });
  std::vector<std::vector<std::uint32_t>> results(GroupsOf(count));
  const auto look = [&](std::size_t group, Covering& simple, OriginalSpace& original)
  {
    Back back(*this, nearTo, simple, original);
    ForEachOfGroup(group, count,
      [&](std::uint32_t i)
      {
        if (!back.IsFine(i))
        {
          results[group].push_back(i);
        }
      });
  };
  ForEachIndex(parallelFor, results.size(), 1,
    [&](std::size_t group)
    {
      this->SimpleCovers.Lend(
        [&](Covering& simple)
        {
          this->All.OriginalSpaces.Lend(
            [&](OriginalSpace& original) { look(group, simple, original); });
        });
    });
  for (const std::vector<std::uint32_t>& result : results)
  {
    Append(result, this->Found.Triangles);
  }
}

PartDistance::Faults PartDistance::Find(const LinkedTriangles& simple,
  const std::vector<std::uint32_t>& homes, const std::vector<bool>& isTouched,
  const ParallelFor& parallelFor)
{
  return Comparison(*this, simple, homes, isTouched).Run(parallelFor);
}

}
