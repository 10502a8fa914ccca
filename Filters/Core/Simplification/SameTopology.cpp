// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SameTopology.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

constexpr std::uint32_t None = Connectivity::None;

/** The fans of triangles around a point at the border: each by the points at its two ends. */
struct Fans
{
  bool HasMore = false; ///< others that are closed
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Open;
};

int PlaceOf(const Triangle& triangle, std::uint32_t point)
{
  return triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
}

/** @param first is given the first triangle of each fan */
Fans FansAt(const TriangleMesh& mesh, const Connectivity& links, std::uint32_t point,
  std::vector<std::uint32_t>* first = nullptr)
{
  Fans fans;
  std::size_t seen = 0;
  const auto count = static_cast<std::size_t>(links.end(point) - links.begin(point));
  // Around the point, from an edge that leads to it on to the edge that leads away.
  const auto walk = [&](std::uint32_t start)
  {
    std::uint32_t at = start;
    std::uint32_t end = None;
    do
    {
      ++seen;
      const int place = PlaceOf(mesh.Triangles[at], point);
      end = mesh.Triangles[at][(place + 2) % 3];
      at = links.Neighbour(at, (place + 2) % 3);
    } while (at != None && at != start && seen <= count);
    return std::pair(at, end);
  };
  for (const std::uint32_t* i = links.begin(point); i != links.end(point); ++i)
  {
    const int place = PlaceOf(mesh.Triangles[*i], point);
    if (links.Neighbour(*i, place) == None)
    {
      const std::uint32_t begin = mesh.Triangles[*i][(place + 1) % 3];
      fans.Open.emplace_back(begin, walk(*i).second);
      if (first != nullptr)
      {
        first->push_back(*i);
      }
    }
  }
  fans.HasMore = seen < count;
  std::sort(fans.Open.begin(), fans.Open.end());
  return fans;
}

/** Whether a border edge begins or ends at a point. */
bool IsAtBorder(const TriangleMesh& mesh, const Connectivity& links, std::uint32_t point)
{
  return std::any_of(links.begin(point), links.end(point),
    [&](std::uint32_t triangle)
    {
      const int place = PlaceOf(mesh.Triangles[triangle], point);
      return links.Neighbour(triangle, place) == None ||
        links.Neighbour(triangle, (place + 2) % 3) == None;
    });
}

/** Whether the triangles at a point that is not at the border are one fan, all around it. */
bool IsOneFan(const TriangleMesh& mesh, const Connectivity& links, std::uint32_t point)
{
  const std::uint32_t start = *links.begin(point);
  const std::ptrdiff_t count = links.end(point) - links.begin(point);
  std::ptrdiff_t seen = 0;
  std::uint32_t at = start;
  do
  {
    ++seen;
    at = links.Neighbour(at, (PlaceOf(mesh.Triangles[at], point) + 2) % 3);
  } while (at != start && at != None && seen <= count);
  return seen == count && at == start;
}

/** The components of a surface, connected by edges. */
struct Components
{
  std::vector<std::uint32_t> Of; ///< by triangle
  std::vector<std::int64_t> Euler;
  std::vector<std::int64_t> BorderEdges;

  std::size_t Count() const { return this->Euler.size(); }
};

Components FindComponents(const TriangleMesh& mesh, const Connectivity& links)
{
  Components components;
  const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
  components.Of.assign(count, None);
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t start = 0; start < count; ++start)
  {
    if (components.Of[start] != None)
    {
      continue;
    }
    const auto number = static_cast<std::uint32_t>(components.Count());
    std::int64_t triangles = 0;
    std::int64_t border = 0;
    components.Of[start] = number;
    waiting.push_back(start);
    while (!waiting.empty())
    {
      const std::uint32_t at = waiting.back();
      waiting.pop_back();
      ++triangles;
      for (int edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t next = links.Neighbour(at, edge);
        if (next == None)
        {
          ++border;
        }
        else if (components.Of[next] == None)
        {
          components.Of[next] = number;
          waiting.push_back(next);
        }
      }
    }
    components.BorderEdges.push_back(border);
    components.Euler.push_back(triangles - (3 * triangles + border) / 2);
  }
  // A point counts as often as it has fans.
  std::vector<std::uint32_t> first;
  for (std::uint32_t point = 0; point < mesh.Positions.size(); ++point)
  {
    if (links.IsUsed(point) && !IsAtBorder(mesh, links, point))
    {
      ++components.Euler[components.Of[*links.begin(point)]];
    }
    else if (links.IsUsed(point))
    {
      first.clear();
      FansAt(mesh, links, point, &first);
      for (const std::uint32_t triangle : first)
      {
        ++components.Euler[components.Of[triangle]];
      }
    }
  }
  return components;
}

/** Whether a point has the fans in one surface that it has in another, or is gone from its inside.
 */
bool HasSameFans(const TriangleMesh& before, const Connectivity& beforeLinks,
  const TriangleMesh& after, const Connectivity& afterLinks, std::uint32_t point)
{
  const bool wasAtBorder = IsAtBorder(before, beforeLinks, point);
  if (!afterLinks.IsUsed(point) || !beforeLinks.IsUsed(point))
  {
    return !afterLinks.IsUsed(point) && !wasAtBorder;
  }
  if (!wasAtBorder)
  {
    return !IsAtBorder(after, afterLinks, point) && IsOneFan(after, afterLinks, point);
  }
  const Fans was = FansAt(before, beforeLinks, point);
  const Fans is = FansAt(after, afterLinks, point);
  return is.Open == was.Open && !is.HasMore && !was.HasMore;
}

/** The component of the first surface that a triangle of the second belongs to, told by an edge at
 *  the border or a point inside; None if the triangle has neither. */
std::uint32_t Ancestor(const TriangleMesh& before, const Connectivity& beforeLinks,
  const Components& components, const Triangle& triangle)
{
  for (int k = 0; k < 3; ++k)
  {
    const std::uint32_t from = triangle[k];
    bool isInside = true;
    for (const std::uint32_t* i = beforeLinks.begin(from); i != beforeLinks.end(from); ++i)
    {
      const int place = PlaceOf(before.Triangles[*i], from);
      const bool atBorder = beforeLinks.Neighbour(*i, place) == None;
      if (atBorder && before.Triangles[*i][(place + 1) % 3] == triangle[(k + 1) % 3])
      {
        return components.Of[*i];
      }
      isInside = isInside && !atBorder;
    }
    if (isInside && beforeLinks.IsUsed(from))
    {
      return components.Of[*beforeLinks.begin(from)];
    }
  }
  return None;
}

}

std::vector<bool> FindOtherTopology(const TriangleMesh& before, const Connectivity& beforeLinks,
  const TriangleMesh& after, const Connectivity& afterLinks)
{
  std::vector<bool> wrong(before.Triangles.size());
  bool anyWrong = false;
  // Fans around points.
  for (std::uint32_t point = 0; point < before.Positions.size(); ++point)
  {
    if (!HasSameFans(before, beforeLinks, after, afterLinks, point))
    {
      anyWrong = true;
      for (const std::uint32_t* i = beforeLinks.begin(point); i != beforeLinks.end(point); ++i)
      {
        wrong[*i] = true;
      }
    }
  }
  if (anyWrong)
  {
    return wrong; // components make no sense yet
  }
  const Components were = FindComponents(before, beforeLinks);
  const Components are = FindComponents(after, afterLinks);
  std::vector<std::uint32_t> descendants(were.Count(), None);
  std::vector<bool> isWrong(were.Count());
  std::vector<std::uint32_t> ancestors(are.Count(), None);
  for (std::uint32_t i = 0; i < after.Triangles.size(); ++i)
  {
    const std::uint32_t component = are.Of[i];
    if (ancestors[component] == None)
    {
      ancestors[component] = Ancestor(before, beforeLinks, were, after.Triangles[i]);
    }
  }
  for (std::uint32_t i = 0; i < are.Count(); ++i)
  {
    const std::uint32_t ancestor = ancestors[i];
    if (ancestor == None)
    {
      return std::vector<bool>(before.Triangles.size(), true);
    }
    isWrong[ancestor] = isWrong[ancestor] || descendants[ancestor] != None ||
      are.Euler[i] != were.Euler[ancestor] || are.BorderEdges[i] != were.BorderEdges[ancestor];
    descendants[ancestor] = i;
  }
  for (std::uint32_t i = 0; i < before.Triangles.size(); ++i)
  {
    const std::uint32_t component = were.Of[i];
    wrong[i] = isWrong[component] || descendants[component] == None;
    anyWrong = anyWrong || wrong[i];
  }
  return anyWrong ? wrong : std::vector<bool>();
}

}
