// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SimplifiedMesh.h"

#include "Simplification/EdgeCollapses.h"
#include "Simplification/PartDistance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/** Numbers in order of what they belong to: first[i] to first[i + 1] are those of i. */
struct Groups
{
  std::vector<std::size_t> First;
  std::vector<std::uint32_t> Items;

  /** @param groupOf (number) -> group, or None */
  template <typename GroupOf>
  Groups(std::size_t groups, std::size_t count, GroupOf&& groupOf)
    : First(groups + 1)
  {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::uint32_t group = groupOf(i);
      if (group != None)
      {
        ++this->First[group + 1];
      }
    }
    std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
    this->Items.resize(this->First.back());
    std::vector<std::size_t> next(this->First.begin(), this->First.end() - 1);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::uint32_t group = groupOf(i);
      if (group != None)
      {
        this->Items[next[group]++] = i;
      }
    }
  }

  const std::uint32_t* begin(std::size_t group) const
  {
    return this->Items.data() + this->First[group];
  }
  const std::uint32_t* end(std::size_t group) const
  {
    return this->Items.data() + this->First[group + 1];
  }
};

}

/** The parts of a pass. */
struct SimplifiedMesh::Division
{
  std::vector<std::uint32_t> PartOf; ///< by triangle of the simpler mesh
  std::vector<std::uint32_t> Number; ///< in its part
  std::vector<bool> IsHeld;          ///< by triangle of the simpler mesh
  Groups Triangles;                  ///< of the simpler mesh, by part
  Groups Originals;                  ///< by part
  Groups Samples;                    ///< that lie over triangles, by part

  std::size_t Count() const { return this->Triangles.First.size() - 1; }
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
  const MeshBlocks blocks = CutIntoBlocks(middles, most, cut);
  std::vector<std::uint32_t> partOf(this->Simple.size());
  for (std::uint32_t part = 0; part < blocks.Count(); ++part)
  {
    for (std::size_t i = blocks.First[part]; i < blocks.First[part + 1]; ++i)
    {
      partOf[blocks.Order[i]] = part;
    }
  }
  // Original triangles that belong to more than one part hold all that they are near to.
  std::vector<bool> isHeld(this->Simple.size());
  std::vector<std::uint32_t> ownerOf(this->Original.Mesh.Triangles.size());
  for (std::size_t i = 0; i < ownerOf.size(); ++i)
  {
    const NearLists::List near = this->Near[i];
    ownerOf[i] = partOf[*near.begin()];
    if (std::any_of(near.begin(), near.end(),
          [&](std::uint32_t triangle) { return partOf[triangle] != ownerOf[i]; }))
    {
      ownerOf[i] = None;
      std::for_each(
        near.begin(), near.end(), [&](std::uint32_t triangle) { isHeld[triangle] = true; });
    }
  }
  const std::size_t count = blocks.Count();
  Groups triangles(count, partOf.size(), [&](std::uint32_t i) { return partOf[i]; });
  std::vector<std::uint32_t> numbers(partOf.size());
  for (std::size_t i = 0; i < triangles.Items.size(); ++i)
  {
    const std::uint32_t triangle = triangles.Items[i];
    numbers[triangle] = static_cast<std::uint32_t>(i - triangles.First[partOf[triangle]]);
  }
  Groups originals(count, ownerOf.size(), [&](std::uint32_t i) { return ownerOf[i]; });
  Groups samples(count, this->Samples.size(),
    [&](std::uint32_t i)
    {
      const std::uint32_t home = this->Samples[i].Home;
      return home == None ? None : partOf[home];
    });
  return { std::move(partOf), std::move(numbers), std::move(isHeld), std::move(triangles),
    std::move(originals), std::move(samples) };
}

MeshPart SimplifiedMesh::Take(
  const Division& division, std::size_t number, std::vector<std::uint32_t>& points) const
{
  const auto add = [&](const Triangle& triangle)
  { points.insert(points.end(), triangle.begin(), triangle.end()); };
  std::for_each(division.Triangles.begin(number), division.Triangles.end(number),
    [&](std::uint32_t triangle) { add(this->Simple[triangle]); });
  std::for_each(division.Originals.begin(number), division.Originals.end(number),
    [&](std::uint32_t triangle) { add(this->Original.Mesh.Triangles[triangle]); });
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
  std::for_each(division.Samples.begin(number), division.Samples.end(number),
    [&](std::uint32_t sample)
    {
      part.Samples.push_back(this->Samples[sample]);
      part.Samples.back().Home = division.Number[this->Samples[sample].Home];
    });
  for (const std::uint32_t* i = division.Triangles.begin(number);
       i != division.Triangles.end(number); ++i)
  {
    part.Triangles.push_back(rename(this->Simple[*i]));
    for (const std::uint32_t point : part.Triangles.back())
    {
      part.IsFixed[point] = part.IsFixed[point] || division.IsHeld[*i];
    }
  }
  const auto originals = division.Originals.end(number) - division.Originals.begin(number);
  part.Near = NearLists(originals);
  for (std::ptrdiff_t i = 0; i < originals; ++i)
  {
    const std::uint32_t original = division.Originals.begin(number)[i];
    part.Original.Mesh.Triangles.push_back(rename(this->Original.Mesh.Triangles[original]));
    part.Original.Allowances.push_back(this->Original.Allowances[original]);
    part.Near.Begin(i);
    for (const std::uint32_t near : this->Near[original])
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
  std::vector<Made> made(division.Count());
  ForEachIndex(parallelFor, made.size(), 1,
    [&](std::int64_t number)
    {
      std::vector<std::uint32_t> points;
      MeshPart part = this->Take(division, number, points);
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
            i < points.size() ? points[i] : division.Samples.begin(number)[i - points.size()],
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
        renamed[division.Triangles.begin(number)[i]] = static_cast<std::uint32_t>(simple.size());
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
    const std::uint32_t* const triangles = division.Triangles.begin(number);
    for (const auto& [sample, home] : made[number].Homes)
    {
      this->Samples[sample].Home = renamed[triangles[home]];
    }
    const std::uint32_t* original = division.Originals.begin(number);
    for (std::size_t i = 0; original != division.Originals.end(number); ++i, ++original)
    {
      isOwned[*original] = true;
      near.Begin(*original);
      for (const std::uint32_t triangle : made[number].Near[i])
      {
        near.Add(*original, renamed[triangles[triangle]]);
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
