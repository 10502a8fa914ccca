// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/PartBorders.h"

#include "Simplification/TriangleIntersection.h"

#include <utility>

namespace isodiamond
{
namespace
{

std::vector<Bounds> BoundsOfParts(
  const std::vector<Vector>& positions, const std::vector<PartBorders::Triangles>& parts)
{
  std::vector<Bounds> bounds(parts.size());
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    for (const Triangle& triangle : parts[part])
    {
      bounds[part].Add(BoundsOf(positions, triangle));
    }
  }
  return bounds;
}

}

PartBorders::PartBorders(const std::vector<Vector>& positions, std::vector<Triangles> parts)
  : Positions(positions)
  , Start(std::move(parts))
  , Now(this->Start)
  , Reach(BoundsOfParts(positions, this->Start))
{
}

/** Calls visit(part) for all other parts in whose bounds a part's triangle is. */
template <typename Visit>
void PartBorders::ForEachPartAt(std::uint32_t part, const Triangle& triangle, Visit&& visit) const
{
  this->Reach.ForEachAt(BoundsOf(this->Positions, triangle),
    [&](std::uint32_t other)
    {
      if (other != part)
      {
        visit(other);
      }
    });
}

std::vector<PartBorders::Triangles> PartBorders::Others(
  const std::vector<std::uint32_t>& parts) const
{
  std::vector<std::uint32_t> places(this->Now.size(), None); // of the parts
  for (std::uint32_t i = 0; i < parts.size(); ++i)
  {
    places[parts[i]] = i;
  }
  std::vector<Triangles> others(parts.size());
  for (std::uint32_t part = 0; part < this->Now.size(); ++part)
  {
    for (const Triangle& triangle : this->Now[part])
    {
      if (triangle[0] != None)
      {
        this->ForEachPartAt(part, triangle,
          [&](std::uint32_t other)
          {
            if (places[other] != None)
            {
              others[places[other]].push_back(triangle);
            }
          });
      }
    }
  }
  return others;
}

std::vector<PartBorders::Stray> PartBorders::Strays(const std::vector<std::uint32_t>& parts) const
{
  std::vector<Stray> strays;
  for (const std::uint32_t part : parts)
  {
    for (std::size_t i = 0; i < this->Now[part].size(); ++i)
    {
      const Triangle& triangle = this->Now[part][i];
      if (triangle[0] != None && !AreSame(this->Start[part][i], triangle))
      {
        bool isStray = false;
        this->ForEachPartAt(part, triangle, [&](std::uint32_t /*other*/) { isStray = true; });
        if (isStray)
        {
          strays.push_back({ part, triangle });
        }
      }
    }
  }
  return strays;
}

std::vector<std::uint32_t> PartBorders::Meeting(const std::vector<std::uint32_t>& parts)
{
  const std::vector<Stray> strays = this->Strays(parts);
  std::vector<Bounds> bounds;
  bounds.reserve(strays.size());
  for (const Stray& stray : strays)
  {
    bounds.push_back(BoundsOf(this->Positions, stray.Points));
  }
  const BoundsTree tree(bounds);
  std::vector<bool> doesMeet(this->Now.size());
  for (std::uint32_t i = 0; i < strays.size(); ++i)
  {
    tree.ForEachAt(bounds[i],
      [&](std::uint32_t other)
      {
        if (strays[other].Part < strays[i].Part && !doesMeet[strays[i].Part] &&
          Intersect(this->Positions, strays[i].Points, strays[other].Points))
        {
          doesMeet[strays[i].Part] = true;
        }
      });
  }
  std::vector<std::uint32_t> meeting;
  for (const std::uint32_t part : parts)
  {
    if (doesMeet[part])
    {
      meeting.push_back(part);
      this->Now[part] = this->Start[part];
    }
  }
  return meeting;
}

}
