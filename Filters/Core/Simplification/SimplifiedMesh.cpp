// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SimplifiedMesh.h"

#include "Simplification/PartBorders.h"
#include "Simplification/SimplerPart.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

/** How many rings of triangles around those with something to try are taken along. */
constexpr int RingsAround = 4;

/** Triangles with the numbers that each has in its part. @param numbers by triangle
 *  @param isHere (triangle) -> whether it is in the part, too */
template <typename IsHere>
LinkedTriangles Linked(const LinkedTriangles& all, IdRange triangles,
  const std::vector<std::uint32_t>& numbers, const PointNumbers& points, IsHere&& isHere)
{
  LinkedTriangles linked;
  linked.Triangles.reserve(triangles.size());
  linked.Neighbours.reserve(triangles.size());
  for (const std::uint32_t triangle : triangles)
  {
    linked.Triangles.push_back(points.Of(all.Triangles[triangle]));
    Triangle neighbours = all.Neighbours[triangle];
    for (std::uint32_t& neighbour : neighbours)
    {
      neighbour = neighbour != None && isHere(neighbour) ? numbers[neighbour] : None;
    }
    linked.Neighbours.push_back(neighbours);
  }
  return linked;
}

}

SimplifiedMesh::SimplifiedMesh(const AllowedMesh& original)
  : Original(original)
  , IsFaulty(original.Mesh.Positions.size())
  , IsPinched(original.Mesh.Positions.size())
  , Homes(original.Mesh.Positions.size(), None)
  , PointAllowances(original.Mesh.Positions.size(), HUGE_VAL)
  , Near(original.Mesh.Triangles.size())
{
  const std::size_t points = original.Mesh.Positions.size();
  Connectivity links(points, original.Mesh.Triangles);
  for (const std::uint32_t point : links.FaultyPoints())
  {
    this->IsFaulty[point] = true;
  }
  for (std::uint32_t point = 0; point < points; ++point)
  {
    this->IsPinched[point] = !this->IsFaulty[point] && links.IsPinched(point);
  }
  this->TryAllAgain();
  this->OriginalLinks = std::move(links).Linked();
  this->Simple = this->OriginalLinks;
  this->Homes.resize(points + original.Mesh.Triangles.size());
  for (std::uint32_t i = 0; i < original.Mesh.Triangles.size(); ++i)
  {
    for (const std::uint32_t point : original.Mesh.Triangles[i])
    {
      double& least = this->PointAllowances[point];
      least = std::min(least, original.Allowances[i]);
    }
    this->Homes[points + i] = i;
    this->Near.Begin(i);
    this->Near.Add(i, i);
  }
}

double SimplifiedMesh::PartToTry() const
{
  const std::vector<Triangle>& simple = this->Triangles();
  const auto count = std::count_if(simple.begin(), simple.end(),
    [&](const Triangle& triangle)
    {
      return std::any_of(triangle.begin(), triangle.end(),
        [&](std::uint32_t point) { return !this->IsSettled[point]; });
    });
  return static_cast<double>(count) / static_cast<double>(simple.size());
}

SurfaceSample SimplifiedMesh::SampleOf(std::size_t id) const
{
  const TriangleMesh& mesh = this->Original.Mesh;
  const std::size_t points = mesh.Positions.size();
  return id < points
    ? SurfaceSample{ mesh.Positions[id], this->PointAllowances[id], this->Homes[id] }
    : SurfaceSample{ mesh.Middle(id - points), this->Original.Allowances[id - points],
        this->Homes[id] };
}

/** The triangles where there is anything to try, and some rings around these. */
std::vector<std::uint32_t> SimplifiedMesh::TrianglesToTry() const
{
  const std::vector<Triangle>& simple = this->Triangles();
  std::vector<bool> isIn(this->IsSettled);
  isIn.flip();
  for (int ring = 0; ring < RingsAround; ++ring)
  {
    std::vector<bool> isNext = isIn;
    for (const Triangle& triangle : simple)
    {
      if (std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t p) { return isIn[p]; }))
      {
        std::for_each(triangle.begin(), triangle.end(), [&](std::uint32_t p) { isNext[p] = true; });
      }
    }
    if (isNext == isIn)
    {
      break; // as where all is to be tried
    }
    isIn = std::move(isNext);
  }
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i < simple.size(); ++i)
  {
    const Triangle& points = simple[i];
    if (std::all_of(points.begin(), points.end(), [&](std::uint32_t p) { return isIn[p]; }))
    {
      triangles.push_back(i);
    }
  }
  return triangles;
}

MeshPart SimplifiedMesh::Take(const MeshDivision& division, std::uint32_t number,
  const std::vector<Triangle>& others, std::vector<std::uint32_t>& ids) const
{
  const IdRange triangles = division.Triangles[number];
  const IdRange originals = division.Originals[number];
  const PointNumbers numbers(
    [&](auto&& visit)
    {
      for (const std::uint32_t triangle : triangles)
      {
        visit(this->Triangles()[triangle]);
      }
      for (const std::uint32_t original : originals)
      {
        visit(this->Original.Mesh.Triangles[original]);
      }
      std::for_each(others.begin(), others.end(), visit);
    });
  MeshPart part;
  part.Simple = Linked(this->Simple, triangles, division.Number, numbers,
    [&](std::uint32_t triangle) { return division.PartOf[triangle] == number; });
  part.Original = Linked(this->OriginalLinks, originals, division.OriginalNumber, numbers,
    [&](std::uint32_t original) { return division.OwnerOf[original] == number; });
  part.Near = NearLists(originals.size());
  part.Allowances.reserve(originals.size());
  for (std::size_t i = 0; i < originals.size(); ++i)
  {
    part.Allowances.push_back(this->Original.Allowances[originals[i]]);
    part.Near.Begin(i);
    for (const std::uint32_t near : this->Near[originals[i]])
    {
      part.Near.Add(i, division.Number[near]);
    }
  }
  part.LeastSine = std::sin(this->Original.LeastAngle / DegreesOfRadian);
  for (const Triangle& other : others)
  {
    part.Others.push_back(numbers.Of(other));
  }
  this->AddPoints(division, number, numbers, ids, part);
  return part;
}

/** The points of a part, and its samples: these points, the middles of its original triangles, and
 * what else lies over its own triangles. */
void SimplifiedMesh::AddPoints(const MeshDivision& division, std::uint32_t number,
  const PointNumbers& numbers, std::vector<std::uint32_t>& ids, MeshPart& part) const
{
  ids = numbers.Points();
  const std::size_t points = ids.size();
  const std::size_t middles = this->Original.Mesh.Positions.size(); // the first one's id
  const auto isThere = [&](std::size_t sample)
  {
    return sample < middles ? numbers.Has(static_cast<std::uint32_t>(sample))
                            : division.OwnerOf[sample - middles] == number;
  };
  const IdRange originals = division.Originals[number];
  std::transform(originals.begin(), originals.end(), std::back_inserter(ids),
    [&](std::uint32_t original) { return static_cast<std::uint32_t>(middles + original); });
  const IdRange over = division.Samples[number];
  std::copy_if(over.begin(), over.end(), std::back_inserter(ids),
    [&](std::uint32_t sample) { return !isThere(sample); });
  part.Samples.reserve(ids.size());
  for (const std::uint32_t id : ids)
  {
    SurfaceSample sample = this->SampleOf(id);
    const bool isOver = sample.Home != None && division.PartOf[sample.Home] == number;
    sample.Home = isOver ? division.Number[sample.Home] : None;
    part.Samples.push_back(sample);
  }
  part.Positions.reserve(points);
  part.OnWalls.resize(points);
  for (std::size_t i = 0; i < points; ++i)
  {
    part.Positions.push_back(part.Samples[i].Position);
    part.OnWalls[i] = this->Original.OnWalls.empty() ? 0 : this->Original.OnWalls[ids[i]];
  }
  part.IsFixed = this->FixedPoints(division, number, ids, part);
  part.IsSettled.reserve(points);
  for (std::size_t i = 0; i < points; ++i)
  {
    part.IsSettled.push_back(this->IsSettled[ids[i]]);
  }
}

/** What is held stays, and so does what other parts also have: where sheets meet at a point, a part
 *  may have only one of them. */
std::vector<bool> SimplifiedMesh::FixedPoints(const MeshDivision& division, std::uint32_t number,
  const std::vector<std::uint32_t>& ids, const MeshPart& part) const
{
  std::vector<bool> isFixed(part.Positions.size());
  for (std::size_t point = 0; point < isFixed.size(); ++point)
  {
    isFixed[point] = this->IsPinched[ids[point]];
  }
  std::size_t i = 0;
  for (const std::uint32_t triangle : division.Triangles[number])
  {
    const Triangle& points = part.Simple.Triangles[i];
    for (int k = 0; k < 3; ++k)
    {
      const bool isCut =
        part.Simple.Neighbours[i][k] == None && this->Simple.Neighbours[triangle][k] != None;
      if (isCut || division.IsHeld[triangle])
      {
        isFixed[points[k]] = true;
        isFixed[points[(k + 1) % 3]] = true;
      }
    }
    ++i;
  }
  return isFixed;
}

/** What a part has become. */
struct SimplifiedMesh::Made
{
  std::vector<Triangle> Triangles; ///< by number; the first point is None if one is gone
  NearLists Near{ 0 };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Homes; ///< samples, and numbers
  std::vector<std::uint32_t> Tried;                           ///< points that might have gone
};

SimplifiedMesh::Made SimplifiedMesh::SimplifyPart(const MeshDivision& division,
  std::uint32_t number, const std::vector<Triangle>& others, double usedPart) const
{
  std::vector<std::uint32_t> ids;
  MeshPart part = this->Take(division, number, others, ids);
  const auto isSound = [&](const Triangle& triangle)
  {
    return std::none_of(triangle.begin(), triangle.end(),
      [&](std::uint32_t point) { return this->IsFaulty[ids[point]]; });
  };
  if (std::all_of(part.Simple.Triangles.begin(), part.Simple.Triangles.end(), isSound) &&
    std::all_of(part.Original.Triangles.begin(), part.Original.Triangles.end(), isSound))
  {
    isodiamond::Simplify(part, usedPart);
  }
  Made made{ std::move(part.Simple.Triangles), std::move(part.Near), {}, {} };
  for (Triangle& triangle : made.Triangles)
  {
    if (triangle[0] == None)
    {
      continue;
    }
    for (std::uint32_t& point : triangle)
    {
      if (!part.IsFixed[point])
      {
        part.IsFixed[point] = true; // once is enough
        made.Tried.push_back(ids[point]);
      }
      point = ids[point];
    }
  }
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (part.Samples[i].Home != None)
    {
      made.Homes.emplace_back(ids[i], part.Samples[i].Home);
    }
  }
  return made;
}

void SimplifiedMesh::Simplify(
  std::size_t most, double cut, double usedPart, const ParallelFor& parallelFor)
{
  const MeshDivision division(
    { this->Original.Mesh.Positions, this->Triangles(), this->Near, this->Homes },
    this->TrianglesToTry(), most, cut);
  if (division.Triangles.Order.empty())
  {
    return;
  }
  std::vector<Made> made(division.Triangles.Count());
  std::vector<std::uint32_t> parts(made.size());
  std::iota(parts.begin(), parts.end(), 0U);
  std::vector<std::vector<Triangle>> triangles(made.size() + 1); // the last ones are in no part
  for (std::size_t i = 0; i < division.PartOf.size(); ++i)
  {
    const std::uint32_t part = division.PartOf[i];
    triangles[part == None ? made.size() : part].push_back(this->Triangles()[i]);
  }
  PartBorders borders(this->Original.Mesh.Positions, std::move(triangles));
  while (!parts.empty())
  {
    const std::vector<std::vector<Triangle>> others = borders.Others(parts);
    ForEachIndex(parallelFor, parts.size(), 1,
      [&](std::int64_t i)
      { made[parts[i]] = this->SimplifyPart(division, parts[i], others[i], usedPart); });
    for (const std::uint32_t part : parts)
    {
      borders.Set(part, made[part].Triangles);
    }
    parts = borders.Meeting(parts);
  }
  this->PutTogether(division, made);
}

/** Puts the triangles of all parts together, and all else follows their new numbers. */
void SimplifiedMesh::PutTogether(const MeshDivision& division, const std::vector<Made>& made)
{
  this->Settle(division, made);
  std::vector<Triangle> simple;
  const std::vector<std::uint32_t> renamed = this->NewNumbers(division, made, simple);
  this->Simple = Connectivity(this->Original.Mesh.Positions.size(), std::move(simple)).Linked();
  this->MoveHomes(division, made, renamed);
  this->Near = this->NewNear(division, made, renamed);
}

/** A point around which something has changed is to be tried, unless it was free to go in its part,
 *  which has seen the change. */
void SimplifiedMesh::Settle(const MeshDivision& division, const std::vector<Made>& made)
{
  for (std::size_t number = 0; number < made.size(); ++number)
  {
    std::size_t i = 0;
    for (const std::uint32_t triangle : division.Triangles[number])
    {
      const Triangle& before = this->Triangles()[triangle];
      if (!AreSame(before, made[number].Triangles[i++]))
      {
        for (const std::uint32_t point : before)
        {
          this->IsSettled[point] = this->IsPinched[point];
        }
      }
    }
  }
  for (const Made& part : made)
  {
    for (const std::uint32_t point : part.Tried)
    {
      this->IsSettled[point] = true;
    }
  }
}

/** Those of parts come first, part by part, then those that are in none.
 *  @param simple receives the triangles that are left
 *  @return by triangle so far: its new number, or None if it is gone */
std::vector<std::uint32_t> SimplifiedMesh::NewNumbers(
  const MeshDivision& division, const std::vector<Made>& made, std::vector<Triangle>& simple) const
{
  std::vector<std::uint32_t> renamed(this->Triangles().size(), None);
  const auto keep = [&](std::uint32_t number, const Triangle& triangle)
  {
    renamed[number] = static_cast<std::uint32_t>(simple.size());
    simple.push_back(triangle);
  };
  for (std::size_t number = 0; number < made.size(); ++number)
  {
    std::size_t i = 0;
    for (const std::uint32_t triangle : division.Triangles[number])
    {
      const Triangle& after = made[number].Triangles[i++];
      if (after[0] != None)
      {
        keep(triangle, after);
      }
    }
  }
  for (std::uint32_t triangle = 0; triangle < renamed.size(); ++triangle)
  {
    if (division.PartOf[triangle] == None)
    {
      keep(triangle, this->Triangles()[triangle]);
    }
  }
  return renamed;
}

void SimplifiedMesh::MoveHomes(const MeshDivision& division, const std::vector<Made>& made,
  const std::vector<std::uint32_t>& renamed)
{
  for (std::uint32_t& home : this->Homes)
  {
    home = home != None && division.PartOf[home] == None ? renamed[home] : home;
  }
  for (std::size_t number = 0; number < made.size(); ++number)
  {
    const IdRange triangles = division.Triangles[number];
    for (const auto& [sample, home] : made[number].Homes)
    {
      this->Homes[sample] = renamed[triangles[home]];
    }
    for (const std::uint32_t point : made[number].Tried)
    {
      this->Homes[point] = None; // may have been removed before
    }
  }
}

NearLists SimplifiedMesh::NewNear(const MeshDivision& division, const std::vector<Made>& made,
  const std::vector<std::uint32_t>& renamed) const
{
  NearLists near(this->Near.Count());
  for (std::size_t number = 0; number < made.size(); ++number)
  {
    const IdRange triangles = division.Triangles[number];
    std::size_t i = 0;
    for (const std::uint32_t original : division.Originals[number])
    {
      near.Begin(original);
      for (const std::uint32_t triangle : made[number].Near[i++])
      {
        near.Add(original, renamed[triangles[triangle]]);
      }
    }
  }
  for (std::size_t original = 0; original < near.Count(); ++original)
  {
    if (division.OwnerOf[original] == None)
    {
      near.Begin(original);
      for (const std::uint32_t triangle : this->Near[original])
      {
        near.Add(original, renamed[triangle]);
      }
    }
  }
  return near;
}

}
