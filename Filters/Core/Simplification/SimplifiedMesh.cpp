// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SimplifiedMesh.h"

#include "Simplification/CellsAtPoints.h"
#include "Simplification/EdgeCollapses.h"
#include "Simplification/MeshBlocks.h"
#include "Simplification/PartDistance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isodiamond
{
namespace
{

constexpr std::uint32_t None = Connectivity::None;

/** Makes a part simpler: collapses edges, measures, and undoes what leads too far, until nothing
 *  does. @return by number of its triangles: what they are now; the first point is None if gone */
std::vector<Triangle> SimplifyPart(MeshPart& part, double usedPart)
{
  const Connectivity links({ part.Original.Mesh.Positions, part.Triangles });
  PartDistance distance(part);
  if (!links.FaultyPoints().empty() || !distance.IsSound())
  {
    return part.Triangles;
  }
  const NearLists nearBefore = part.Near;
  EdgeCollapses collapses(part, links, usedPart);
  std::vector<bool> isTouched = collapses.Run();
  for (;;)
  {
    std::vector<std::uint32_t> numbers;
    const std::vector<Triangle> simple = collapses.Result(numbers);
    const PartDistance::Faults faults = distance.Find(simple, numbers, isTouched);
    if (!faults.Any())
    {
      break;
    }
    isTouched = collapses.Undo(faults.Triangles, faults.Points);
    if (std::find(isTouched.begin(), isTouched.end(), true) == isTouched.end())
    {
      part.Near = nearBefore; // nothing is left that could be wrong
      return part.Triangles;
    }
  }
  for (std::size_t i = 0; i < part.Samples.size(); ++i)
  {
    part.Samples[i].Home = collapses.SampleHomes()[i];
  }
  return collapses.All();
}

/** What belongs to each part. @param partOf (number) -> part, or None */
template <typename PartOf>
CellsAtPoints ByPart(std::size_t parts, std::size_t count, PartOf&& partOf)
{
  std::uint32_t part = None;
  return { parts, count,
    [&](std::size_t number) -> IdRange
    {
      part = partOf(static_cast<std::uint32_t>(number));
      return { &part, part == None ? &part : &part + 1 };
    } };
}

}

/** The parts of a pass. */
struct SimplifiedMesh::Division
{
  MeshBlocks Triangles;              ///< of the simpler mesh, by part
  std::vector<std::uint32_t> PartOf; ///< by triangle of the simpler mesh
  std::vector<std::uint32_t> Number; ///< in its part
  std::vector<bool> IsHeld;          ///< by triangle of the simpler mesh
  CellsAtPoints Originals;           ///< by part
  CellsAtPoints Samples;             ///< that lie over triangles, by part
};

SimplifiedMesh::SimplifiedMesh(const AllowedMesh& original)
  : Original(original)
  , Simple(original.Mesh.Triangles)
  , Samples(original.Mesh.Positions.size() + original.Mesh.Triangles.size())
  , Near(original.Mesh.Triangles.size())
{
  const std::size_t points = original.Mesh.Positions.size();
  for (std::size_t i = 0; i < points; ++i)
  {
    this->Samples[i] = { original.Mesh.Positions[i], HUGE_VAL, None };
  }
  for (std::uint32_t i = 0; i < original.Mesh.Triangles.size(); ++i)
  {
    const double allowance = original.Allowances[i];
    this->Samples[points + i] = { original.Mesh.Middle(i), allowance, i };
    for (const std::uint32_t point : original.Mesh.Triangles[i])
    {
      double& least = this->Samples[point].Allowance;
      least = std::min(least, allowance);
    }
    this->Near.Begin(i);
    this->Near.Add(i, i);
  }
}

SimplifiedMesh::Division SimplifiedMesh::Divide(std::size_t most, double cut) const
{
  std::vector<Vector> middles;
  middles.reserve(this->Simple.size());
  for (const Triangle& triangle : this->Simple)
  {
    const std::vector<Vector>& positions = this->Original.Mesh.Positions;
    middles.push_back(
      (1.0 / 3.0) * (positions[triangle[0]] + positions[triangle[1]] + positions[triangle[2]]));
  }
  MeshBlocks blocks = CutIntoBlocks(middles, most, cut);
  std::vector<std::uint32_t> partOf(this->Simple.size());
  std::vector<std::uint32_t> numbers(this->Simple.size());
  for (std::uint32_t part = 0; part < blocks.Count(); ++part)
  {
    const IdRange triangles = blocks[part];
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      partOf[triangles[i]] = part;
      numbers[triangles[i]] = i;
    }
  }
  // Original triangles that belong to more than one part hold all that they are near to.
  std::vector<bool> isHeld(this->Simple.size());
  std::vector<std::uint32_t> ownerOf(this->Original.Mesh.Triangles.size());
  for (std::size_t i = 0; i < ownerOf.size(); ++i)
  {
    const IdRange near = this->Near[i];
    ownerOf[i] = partOf[*near.begin()];
    if (std::any_of(near.begin(), near.end(),
          [&](std::uint32_t triangle) { return partOf[triangle] != ownerOf[i]; }))
    {
      ownerOf[i] = None;
      std::for_each(
        near.begin(), near.end(), [&](std::uint32_t triangle) { isHeld[triangle] = true; });
    }
  }
  CellsAtPoints originals =
    ByPart(blocks.Count(), ownerOf.size(), [&](std::uint32_t i) { return ownerOf[i]; });
  CellsAtPoints samples = ByPart(blocks.Count(), this->Samples.size(),
    [&](std::uint32_t i)
    {
      const std::uint32_t home = this->Samples[i].Home;
      return home == None ? None : partOf[home];
    });
  return { std::move(blocks), std::move(partOf), std::move(numbers), std::move(isHeld),
    std::move(originals), std::move(samples) };
}

MeshPart SimplifiedMesh::Take(
  const Division& division, std::uint32_t number, std::vector<std::uint32_t>& points) const
{
  const IdRange triangles = division.Triangles[number];
  const IdRange originals = division.Originals[number];
  const auto add = [&](const Triangle& triangle)
  { points.insert(points.end(), triangle.begin(), triangle.end()); };
  for (const std::uint32_t triangle : triangles)
  {
    add(this->Simple[triangle]);
  }
  for (const std::uint32_t original : originals)
  {
    add(this->Original.Mesh.Triangles[original]);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const auto rename = [&](Triangle triangle)
  {
    for (std::uint32_t& point : triangle)
    {
      point = static_cast<std::uint32_t>(
        std::lower_bound(points.begin(), points.end(), point) - points.begin());
    }
    return triangle;
  };
  MeshPart part;
  part.IsFixed.resize(points.size());
  for (const std::uint32_t point : points)
  {
    part.Original.Mesh.Positions.push_back(this->Original.Mesh.Positions[point]);
    part.Samples.push_back({ this->Samples[point].Position, this->Samples[point].Allowance, None });
  }
  for (const std::uint32_t sample : division.Samples[number])
  {
    part.Samples.push_back(this->Samples[sample]);
    part.Samples.back().Home = division.Number[this->Samples[sample].Home];
  }
  for (const std::uint32_t triangle : triangles)
  {
    part.Triangles.push_back(rename(this->Simple[triangle]));
    for (const std::uint32_t point : part.Triangles.back())
    {
      part.IsFixed[point] = part.IsFixed[point] || division.IsHeld[triangle];
    }
  }
  part.Near = NearLists(originals.size());
  for (std::size_t i = 0; i < originals.size(); ++i)
  {
    part.Original.Mesh.Triangles.push_back(rename(this->Original.Mesh.Triangles[originals[i]]));
    part.Original.Allowances.push_back(this->Original.Allowances[originals[i]]);
    part.Near.Begin(i);
    for (const std::uint32_t near : this->Near[originals[i]])
    {
      part.Near.Add(i, division.Number[near]);
    }
  }
  return part;
}

/** What a part has become. */
struct SimplifiedMesh::Made
{
  std::vector<Triangle> Triangles; ///< by number; the first point is None if one is gone
  NearLists Near{ 0 };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Homes; ///< samples, and numbers
};

void SimplifiedMesh::Simplify(
  std::size_t most, double cut, double usedPart, const ParallelFor& parallelFor)
{
  const Division division = this->Divide(most, cut);
  std::vector<Made> made(division.Triangles.Count());
  ForEachIndex(parallelFor, made.size(), 1,
    [&](std::int64_t number)
    {
      std::vector<std::uint32_t> points;
      MeshPart part = this->Take(division, static_cast<std::uint32_t>(number), points);
      made[number].Triangles = SimplifyPart(part, usedPart);
      for (Triangle& triangle : made[number].Triangles)
      {
        for (std::uint32_t& point : triangle)
        {
          point = point == None ? None : points[point];
        }
      }
      made[number].Near = std::move(part.Near);
      for (std::size_t i = 0; i < part.Samples.size(); ++i)
      {
        if (part.Samples[i].Home != None)
        {
          made[number].Homes.emplace_back(
            i < points.size() ? points[i] : division.Samples[number][i - points.size()],
            part.Samples[i].Home);
        }
      }
    });
  this->PutTogether(division, made);
}

/** Triangles that are left get new numbers, by which all else goes. */
void SimplifiedMesh::PutTogether(const Division& division, const std::vector<Made>& made)
{
  std::vector<std::uint32_t> renamed(this->Simple.size(), None);
  std::vector<Triangle> simple;
  for (std::size_t number = 0; number < made.size(); ++number)
  {
    for (std::size_t i = 0; i < made[number].Triangles.size(); ++i)
    {
      if (made[number].Triangles[i][0] != None)
      {
        renamed[division.Triangles[number][i]] = static_cast<std::uint32_t>(simple.size());
        simple.push_back(made[number].Triangles[i]);
      }
    }
  }
  this->Simple = std::move(simple);
  const std::size_t originals = this->Original.Mesh.Triangles.size();
  NearLists near(originals);
  std::vector<bool> isOwned(originals);
  for (std::size_t number = 0; number < made.size(); ++number)
  {
    const IdRange triangles = division.Triangles[number];
    const IdRange ids = division.Originals[number];
    for (const auto& [sample, home] : made[number].Homes)
    {
      this->Samples[sample].Home = renamed[triangles[home]];
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      isOwned[ids[i]] = true;
      near.Begin(ids[i]);
      for (const std::uint32_t triangle : made[number].Near[i])
      {
        near.Add(ids[i], renamed[triangles[triangle]]);
      }
    }
  }
  for (std::size_t i = 0; i < originals; ++i)
  {
    if (!isOwned[i])
    {
      near.Begin(i);
      for (const std::uint32_t triangle : this->Near[i])
      {
        near.Add(i, renamed[triangle]);
      }
    }
  }
  this->Near = std::move(near);
}

}
