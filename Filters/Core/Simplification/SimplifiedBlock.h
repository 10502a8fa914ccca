// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SimplifiedBlock_h
#define isodiamond_SimplifiedBlock_h

#include "Simplification/Covering.h"
#include "Simplification/SameTopology.h"
#include "Simplification/Simplification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isodiamond
{

/** Triangles that are not given away. */
using Kept = std::vector<bool>;

/** A block of a mesh that is made simpler step by step. */
class SimplifiedBlock
{
public:
  explicit SimplifiedBlock(const AllowedMesh& original)
    : Original(original)
    , Links(original.Mesh)
    , Cover(original.Mesh, this->Links)
    , Current(original)
    , CurrentLinks(this->Links)
    , Places(original.Mesh.Triangles.size())
  {
    std::iota(this->Places.begin(), this->Places.end(), 0U);
    this->IsAtBorder.resize(original.Mesh.Positions.size());
    for (std::uint32_t i = 0; i < original.Mesh.Triangles.size(); ++i)
    {
      const Triangle& triangle = original.Mesh.Triangles[i];
      for (int k = 0; k < 3; ++k)
      {
        if (this->Links.Neighbour(i, k) == None)
        {
          this->IsAtBorder[triangle[k]] = true;
          this->IsAtBorder[triangle[(k + 1) % 3]] = true;
        }
      }
    }
  }

  /** Whether there is anything to go by. */
  bool IsSound() const { return this->Links.FaultyPoints().empty(); }

  /** Has the triangles decimated that are not kept, again and again with more that are.
   *  @return whether that led to anything; else it is as it was */
  bool Decimate(const Decimation& decimate, double error, Kept kept)
  {
    for (int trial = 0; trial < MostTrials; ++trial)
    {
      const TriangleMesh& mesh = this->Current.Mesh;
      AllowedMesh next;
      next.Mesh.Positions = mesh.Positions;
      TriangleMesh given;
      given.Positions = mesh.Positions;
      for (std::size_t i = 0; i < kept.size(); ++i)
      {
        (kept[i] ? next.Mesh : given).Triangles.push_back(mesh.Triangles[i]);
      }
      if (given.Triangles.empty())
      {
        return true;
      }
      const std::vector<Triangle> fewer = decimate(given, error);
      next.Mesh.Triangles.insert(next.Mesh.Triangles.end(), fewer.begin(), fewer.end());
      this->Wrong.assign(kept.size(), false);
      if (this->Accept(next))
      {
        return true;
      }
      // More around it each time; at once where putting it back was not enough.
      const bool isKept = std::equal(this->Wrong.begin(), this->Wrong.end(), kept.begin(),
        [](bool wrong, bool known) { return !wrong || known; });
      for (int ring = 0; ring < trial / 4 + (isKept ? 1 : 0); ++ring)
      {
        this->GrowWrong();
      }
      std::transform(
        kept.begin(), kept.end(), this->Wrong.begin(), kept.begin(), std::logical_or<>());
    }
    return false;
  }

  const AllowedMesh& Result() const { return this->Current; }

private:
  static constexpr std::uint32_t None = Connectivity::None;
  /** How often an error is tried, with more that is kept each time. */
  static constexpr int MostTrials = 16;
  /** Pieces that are nearer than this part of what is allowed are not cut any further. */
  static constexpr double UncutPart = 0.3;

  /** Takes what was made of the current mesh, if all is well; else marks where it is not. */
  bool Accept(AllowedMesh& next)
  {
    if (!this->HasSoundTriangles(next.Mesh))
    {
      return false;
    }
    Connectivity links(next.Mesh);
    next.Allowances.assign(next.Mesh.Triangles.size(), HUGE_VAL);
    std::vector<std::uint32_t> places;
    // Each by its price, and the dearest last, when all else is well.
    const bool hasTopology = this->HasTopology(next.Mesh, links);
    if (!this->MeasureBack(next) || !hasTopology || !this->MeasureForth(next, links, places))
    {
      return false;
    }
    this->Current = std::move(next);
    this->CurrentLinks = std::move(links);
    this->Places = std::move(places);
    return true;
  }

  bool WasEdge(std::uint32_t from, std::uint32_t to) const
  {
    return std::any_of(this->Links.begin(from), this->Links.end(from),
      [&](std::uint32_t triangle)
      {
        const Triangle& points = this->Original.Mesh.Triangles[triangle];
        return std::find(points.begin(), points.end(), to) != points.end();
      });
  }

  /** Whether no new edge leads from border to border: the next block might make the same. */
  bool HasBordersOfItsOwn(const TriangleMesh& next)
  {
    bool isSo = true;
    for (const Triangle& triangle : next.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::uint32_t from = triangle[k];
        const std::uint32_t to = triangle[(k + 1) % 3];
        if (this->IsAtBorder[from] && this->IsAtBorder[to] && !this->WasEdge(from, to))
        {
          isSo = false;
          this->MarkAt(from);
          this->MarkAt(to);
        }
      }
    }
    return isSo;
  }

  bool HasTopology(const TriangleMesh& next, const Connectivity& links)
  {
    if (!links.FaultyPoints().empty())
    {
      std::for_each(links.FaultyPoints().begin(), links.FaultyPoints().end(),
        [&](std::uint32_t point) { this->MarkAt(point); });
      return false;
    }
    if (!this->HasBordersOfItsOwn(next))
    {
      return false;
    }
    const std::vector<bool> other =
      FindOtherTopology(this->Current.Mesh, this->CurrentLinks, next, links);
    std::transform(
      other.begin(), other.end(), this->Wrong.begin(), this->Wrong.begin(), std::logical_or<>());
    return other.empty();
  }

  bool HasSoundTriangles(const TriangleMesh& mesh)
  {
    const std::size_t points = mesh.Positions.size();
    bool areSound = true;
    for (const Triangle& t : mesh.Triangles)
    {
      if (t[0] >= points || t[1] >= points || t[2] >= points)
      {
        this->Wrong.assign(this->Wrong.size(), true);
        return false;
      }
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      {
        this->MarkAt(t[0]);
        areSound = false;
      }
    }
    return areSound;
  }

  void MarkAt(std::uint32_t point)
  {
    for (const std::uint32_t* i = this->CurrentLinks.begin(point);
         i != this->CurrentLinks.end(point); ++i)
    {
      this->Wrong[*i] = true;
    }
  }

  /** Marks all that have a point in common with what is marked. */
  void GrowWrong()
  {
    const Kept before = this->Wrong;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      if (before[i])
      {
        const Triangle& points = this->Current.Mesh.Triangles[i];
        std::for_each(
          points.begin(), points.end(), [&](std::uint32_t point) { this->MarkAt(point); });
      }
    }
  }

  /** From the new triangles to the original ones. What was found to be near once is so always. */
  bool MeasureBack(AllowedMesh& next)
  {
    bool areNear = true;
    const auto count = static_cast<std::uint32_t>(next.Mesh.Triangles.size());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const Triangle& points = next.Mesh.Triangles[i];
      const auto known = this->Near.find(points);
      if (known != this->Near.end())
      {
        next.Allowances[i] = known->second;
        continue;
      }
      next.Allowances[i] = this->LeftBack(next.Mesh, i);
      if (next.Allowances[i] >= 0.0)
      {
        this->Near.emplace(points, next.Allowances[i]);
      }
      areNear = areNear && next.Allowances[i] >= 0.0;
    }
    return areNear;
  }

  /** What is left of the allowances where a new triangle is; less than 0, and marked, if it is too
   *  far away. */
  double LeftBack(const TriangleMesh& mesh, std::uint32_t triangle)
  {
    const std::array<Vector, 3> corners = mesh.Corners(triangle);
    const Triangle& points = mesh.Triangles[triangle];
    const std::uint32_t start = this->Cover.NearestAt(points[0], mesh.Middle(triangle));
    double least = HUGE_VAL;
    Vector mean{}; // of the normals
    bool isMarked = false;
    const bool isCovered =
      this->Cover.Cut(corners, start, UncutPart * this->Original.Allowances[start],
        [&](std::uint32_t original, double distance, double area)
        {
          const double left = this->Original.Allowances[original] - distance;
          least = std::min(least, left);
          mean = mean + area * this->Cover.Normal(original);
          if (left < 0.0)
          {
            this->Wrong[this->Places[original]] = true;
            isMarked = true;
          }
          return left >= 0.0;
        });
    const bool isFolded = Dot(Cross(corners[1] - corners[0], corners[2] - corners[0]), mean) < 0.0;
    if (isCovered && !isFolded)
    {
      return least;
    }
    if (!isMarked)
    {
      std::for_each(
        points.begin(), points.end(), [&](std::uint32_t point) { this->MarkAt(point); });
    }
    return -1.0;
  }

  /** From the original triangles to the new ones: those at points that stayed first, then their
   *  neighbours, each beginning where the one before ended. @param places is given where */
  bool MeasureForth(
    AllowedMesh& next, const Connectivity& links, std::vector<std::uint32_t>& places)
  {
    const Covering cover(next.Mesh, links);
    const TriangleMesh& original = this->Original.Mesh;
    places.assign(original.Triangles.size(), None);
    std::vector<std::uint32_t> waiting;
    this->ReuseLone(next, places, waiting);
    bool areNear = true;
    ForEachFromPlace(original, this->Links, links, cover, places, waiting,
      [&](std::uint32_t i, std::uint32_t& place)
      {
        if (!this->IsReused[i] && !this->IsNearForth(next, cover, i, place))
        {
          areNear = false;
          this->Wrong[this->Places[i]] = true;
        }
      });
    return areNear; // each piece of the original has a point that stayed: their topology is one
  }

  /** What was near to one triangle that is still there need not be measured again. */
  void ReuseLone(
    AllowedMesh& next, std::vector<std::uint32_t>& places, std::vector<std::uint32_t>& waiting)
  {
    const auto count = static_cast<std::uint32_t>(places.size());
    this->IsReused.assign(count, false);
    this->Lone.resize(count);
    TriangleMap<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < next.Mesh.Triangles.size(); ++i)
    {
      numbers.emplace(next.Mesh.Triangles[i], i);
    }
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const auto found =
        this->Lone[i].Left >= 0.0 ? numbers.find(this->Lone[i].Points) : numbers.end();
      if (found != numbers.end())
      {
        this->IsReused[i] = true;
        places[i] = found->second;
        double& allowed = next.Allowances[places[i]];
        allowed = std::min(allowed, this->Lone[i].Left);
        waiting.push_back(i);
      }
    }
  }

  /** @param place where to begin, and where it ended */
  bool IsNearForth(
    AllowedMesh& next, const Covering& cover, std::uint32_t triangle, std::uint32_t& place)
  {
    const double allowed = this->Original.Allowances[triangle];
    int pieces = 0;
    const bool isNear = cover.Cut(this->Original.Mesh.Corners(triangle), place, UncutPart * allowed,
      [&](std::uint32_t at, double distance, double /*area*/)
      {
        const double left = allowed - distance;
        next.Allowances[at] = std::min(next.Allowances[at], left);
        this->Lone[triangle] = { next.Mesh.Triangles[at], left };
        ++pieces;
        place = at;
        return left >= 0.0;
      });
    if (pieces != 1 || !isNear)
    {
      this->Lone[triangle].Left = -1.0;
    }
    return isNear;
  }

  struct TriangleHash
  {
    std::size_t operator()(const Triangle& t) const
    {
      const std::uint64_t mixed = (t[0] * 0x9e3779b97f4a7c15ULL) ^ (t[1] * 0xc2b2ae3d27d4eb4fULL) ^
        (t[2] * 0x165667b19e3779f9ULL);
      return mixed ^ (mixed >> 32);
    }
  };
  template <typename Value>
  using TriangleMap = std::unordered_map<Triangle, Value, TriangleHash>;

  /** The one new triangle that an original one was found near to, and what was left there; less
   *  than 0 for none. */
  struct LoneTriangle
  {
    Triangle Points{};
    double Left = -1.0;
  };

  const AllowedMesh& Original;
  Connectivity Links;
  Covering Cover;
  std::vector<bool> IsAtBorder; ///< by point, of the original
  AllowedMesh Current;
  Connectivity CurrentLinks;
  std::vector<std::uint32_t> Places; ///< near each original triangle, in the current mesh
  Kept Wrong;                        ///< of the current mesh
  TriangleMap<double> Near;          ///< what is left where triangles are that were tried
  std::vector<LoneTriangle> Lone;    ///< by original triangle
  std::vector<bool> IsReused;        ///< by original triangle
};

}

#endif
