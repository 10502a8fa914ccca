// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Simplification.h"

#include "Simplification/Covering.h"
#include "Simplification/SameTopology.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace isodiamond
{
namespace
{

constexpr std::uint32_t None = Connectivity::None;

/** Errors that decimation is told one after the other, in parts of what is allowed: what one of
 * them does wrong is put back as the one before left it. */
constexpr std::array<double, 4> Parts = { 0.25, 0.5, 0.75, 1.0 };

/** Of what is allowed at most: where less is, a triangle is not given away at once. */
constexpr double LeastPart = 0.25;

/** How often each is tried, with more that is kept each time; if that was in vain, larger blocks
 *  than this, in triangles, are cut in two. */
constexpr int MostTrials = 16;
constexpr std::size_t SmallestBlock = 250;

/** Pieces that are nearer than this part of what is allowed are not cut any further. */
constexpr double UncutPart = 0.3;

/** Triangles that are not given away. */
using Kept = std::vector<bool>;

Vector MiddleOf(const TriangleMesh& mesh, std::uint32_t triangle)
{
  return (1.0 / 3.0) *
    (mesh.Corner(triangle, 0) + mesh.Corner(triangle, 1) + mesh.Corner(triangle, 2));
}

std::array<Vector, 3> CornersOf(const TriangleMesh& mesh, std::uint32_t triangle)
{
  return { mesh.Corner(triangle, 0), mesh.Corner(triangle, 1), mesh.Corner(triangle, 2) };
}

/** A block of a mesh that is made simpler step by step. */
class Block
{
public:
  explicit Block(const AllowedMesh& original)
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
    const std::array<Vector, 3> corners = CornersOf(mesh, triangle);
    const Triangle& points = mesh.Triangles[triangle];
    const std::uint32_t start = this->Cover.NearestAt(points[0], MiddleOf(mesh, triangle));
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
    const auto count = static_cast<std::uint32_t>(original.Triangles.size());
    places.assign(count, None);
    std::vector<std::uint32_t> waiting;
    this->ReuseLone(next, places, waiting);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      for (const std::uint32_t point : original.Triangles[i])
      {
        if (places[i] == None && links.IsUsed(point))
        {
          places[i] = cover.NearestAt(point, MiddleOf(original, i));
          waiting.push_back(i);
        }
      }
    }
    bool areNear = true;
    for (std::size_t at = 0; at < waiting.size(); ++at)
    {
      const std::uint32_t i = waiting[at];
      if (!this->IsReused[i] && !this->IsNearForth(next, cover, i, places[i]))
      {
        areNear = false;
        this->Wrong[this->Places[i]] = true;
      }
      for (int edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t neighbour = this->Links.Neighbour(i, edge);
        if (neighbour != None && places[neighbour] == None)
        {
          places[neighbour] = places[i];
          waiting.push_back(neighbour);
        }
      }
    }
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
    const bool isNear =
      cover.Cut(CornersOf(this->Original.Mesh, triangle), place, UncutPart * allowed,
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

/** Chooses of allowances those to go by, one after the other. */
using Choose = std::vector<double> (*)(const std::vector<double>& allowances);

/** The least allowance in a block, if it is much less than the greatest, and that. */
std::vector<double> LeastAndMost(const std::vector<double>& allowances)
{
  const auto [least, most] = std::minmax_element(allowances.begin(), allowances.end());
  return *least < 0.5 * *most ? std::vector<double>{ *least, *most } : std::vector<double>{ *most };
}

/** The greatest. */
std::vector<double> Most(const std::vector<double>& allowances)
{
  return { *std::max_element(allowances.begin(), allowances.end()) };
}

/** The triangles of a mesh in blocks, in an order that depends on their positions alone. */
struct Blocks
{
  std::vector<std::uint32_t> Order; ///< of the triangles
  std::vector<std::size_t> First;   ///< in that order; and the number of all
};

/** @param shift of the blocks' corners, in their size */
Blocks CutIntoBlocks(const TriangleMesh& mesh, double size, double shift)
{
  using Key = std::array<std::int64_t, 3>;
  std::vector<Key> keys(mesh.Triangles.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const Vector middle = (1.0 / 3.0) * (mesh.Corner(i, 0) + mesh.Corner(i, 1) + mesh.Corner(i, 2));
    for (int axis = 0; axis < 3; ++axis)
    {
      keys[i][axis] = static_cast<std::int64_t>(std::floor(middle[axis] / size + shift));
    }
  }
  Blocks blocks;
  blocks.Order.resize(keys.size());
  std::iota(blocks.Order.begin(), blocks.Order.end(), 0U);
  std::sort(blocks.Order.begin(), blocks.Order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    if (i == 0 || keys[blocks.Order[i]] != keys[blocks.Order[i - 1]])
    {
      blocks.First.push_back(i);
    }
  }
  blocks.First.push_back(keys.size());
  return blocks;
}

/** Two halves along the axis that a mesh is longest on. */
Blocks CutInTwo(const TriangleMesh& mesh)
{
  const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
  Vector low = MiddleOf(mesh, 0);
  Vector high = low;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const Vector middle = MiddleOf(mesh, i);
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], middle[axis]);
      high[axis] = std::max(high[axis], middle[axis]);
    }
  }
  const Vector extent = high - low;
  const auto axis = std::max_element(extent.begin(), extent.end()) - extent.begin();
  Blocks halves;
  halves.Order.resize(count);
  std::iota(halves.Order.begin(), halves.Order.end(), 0U);
  const auto half = halves.Order.begin() + count / 2;
  std::nth_element(halves.Order.begin(), half, halves.Order.end(),
    [&](std::uint32_t a, std::uint32_t b)
    { return std::pair(MiddleOf(mesh, a)[axis], a) < std::pair(MiddleOf(mesh, b)[axis], b); });
  std::sort(halves.Order.begin(), half);
  std::sort(half, halves.Order.end());
  halves.First = { 0, count / 2, count };
  return halves;
}

/** A block with points of its own. @param points is given their ids in the mesh */
AllowedMesh TakeBlock(const AllowedMesh& mesh, const Blocks& blocks, std::size_t number,
  std::vector<std::uint32_t>& points)
{
  const auto begin = blocks.Order.begin() + static_cast<std::ptrdiff_t>(blocks.First[number]);
  const auto end = blocks.Order.begin() + static_cast<std::ptrdiff_t>(blocks.First[number + 1]);
  for (auto i = begin; i != end; ++i)
  {
    const Triangle& triangle = mesh.Mesh.Triangles[*i];
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  AllowedMesh block;
  for (const std::uint32_t point : points)
  {
    block.Mesh.Positions.push_back(mesh.Mesh.Positions[point]);
  }
  for (auto i = begin; i != end; ++i)
  {
    Triangle triangle = mesh.Mesh.Triangles[*i];
    for (std::uint32_t& point : triangle)
    {
      point = static_cast<std::uint32_t>(
        std::lower_bound(points.begin(), points.end(), point) - points.begin());
    }
    block.Mesh.Triangles.push_back(triangle);
    block.Allowances.push_back(mesh.Allowances[*i]);
  }
  return block;
}

AllowedMesh SimplifyBlock(const AllowedMesh& original, const Decimation& decimate, Choose choose);

/** Gives triangles of a part of a mesh the points of the mesh. */
void Rename(TriangleMesh& mesh, const std::vector<std::uint32_t>& points)
{
  for (Triangle& triangle : mesh.Triangles)
  {
    for (std::uint32_t& point : triangle)
    {
      point = points[point];
    }
  }
}

void Append(const AllowedMesh& part, AllowedMesh& mesh)
{
  mesh.Mesh.Triangles.insert(
    mesh.Mesh.Triangles.end(), part.Mesh.Triangles.begin(), part.Mesh.Triangles.end());
  mesh.Allowances.insert(mesh.Allowances.end(), part.Allowances.begin(), part.Allowances.end());
}

/** The same in parts: where much goes wrong, less of it is tried again then. */
AllowedMesh SimplifyInParts(const AllowedMesh& original, const Decimation& decimate, Choose choose)
{
  AllowedMesh result;
  result.Mesh.Positions = original.Mesh.Positions;
  const Blocks parts = CutInTwo(original.Mesh);
  for (std::size_t i = 0; i + 1 < parts.First.size(); ++i)
  {
    std::vector<std::uint32_t> points;
    const AllowedMesh part = TakeBlock(original, parts, i, points);
    AllowedMesh made = SimplifyBlock(part, decimate, choose);
    Rename(made.Mesh, points);
    Append(made, result);
  }
  return result;
}

/** A block's triangles, or fewer. */
AllowedMesh SimplifyBlock(const AllowedMesh& original, const Decimation& decimate, Choose choose)
{
  Block block(original);
  if (!block.IsSound())
  {
    return original;
  }
  for (const double allowed : choose(original.Allowances))
  {
    for (const double part : Parts)
    {
      Kept kept(block.Result().Mesh.Triangles.size());
      for (std::size_t i = 0; i < kept.size(); ++i)
      {
        kept[i] = block.Result().Allowances[i] < LeastPart * allowed;
      }
      if (allowed > 0.0 && !block.Decimate(decimate, part * allowed, std::move(kept)))
      {
        return block.Result().Mesh.Triangles.size() > SmallestBlock
          ? SimplifyInParts(block.Result(), decimate, part == Parts[0] ? choose : Most)
          : block.Result();
      }
    }
  }
  return block.Result();
}

/** One pass over all blocks. */
AllowedMesh SimplifyBlocks(const AllowedMesh& mesh, const Decimation& decimate, double size,
  double shift, Choose choose, const ParallelFor& parallelFor)
{
  const Blocks blocks = CutIntoBlocks(mesh.Mesh, size, shift);
  const std::size_t count = blocks.First.size() - 1;
  std::vector<AllowedMesh> made(count);
  ForEachIndex(parallelFor, count, 1,
    [&](std::int64_t number)
    {
      std::vector<std::uint32_t> points;
      const AllowedMesh block = TakeBlock(mesh, blocks, number, points);
      made[number] = SimplifyBlock(block, decimate, choose);
      made[number].Mesh.Positions.clear();
      Rename(made[number].Mesh, points);
    });
  AllowedMesh result;
  result.Mesh.Positions = mesh.Mesh.Positions;
  for (const AllowedMesh& block : made)
  {
    Append(block, result);
  }
  return result;
}

/** The size of blocks that have about so many triangles on average. */
double BlockSize(const TriangleMesh& mesh)
{
  constexpr double triangles = 16000.0;
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const Vector normal =
      Cross(mesh.Corner(i, 1) - mesh.Corner(i, 0), mesh.Corner(i, 2) - mesh.Corner(i, 0));
    area += 0.5 * std::sqrt(Dot(normal, normal));
  }
  // A surface that goes through a cube once has about its face's area there.
  return std::sqrt(area * triangles / static_cast<double>(mesh.Triangles.size()));
}

}

AllowedMesh Simplify(
  const AllowedMesh& mesh, const Decimation& decimate, const ParallelFor& parallelFor)
{
  if (mesh.Mesh.Triangles.empty())
  {
    return mesh;
  }
  // Each pass cuts its blocks where the ones before had insides.
  struct Pass
  {
    double Size;
    double Shift;
    Choose ChooseAllowances;
  };
  constexpr std::array<Pass, 3> passes = { { { 1.0, 0.0, LeastAndMost }, { 1.0, 0.5, Most },
    { 1.6, 0.3, Most } } };
  const double size = BlockSize(mesh.Mesh);
  AllowedMesh result = mesh;
  for (const Pass& pass : passes)
  {
    result = SimplifyBlocks(
      result, decimate, pass.Size * size, pass.Shift, pass.ChooseAllowances, parallelFor);
  }
  return result;
}

}
