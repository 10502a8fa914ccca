// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Simplification.h"

#include "Simplification/MeshBlocks.h"
#include "Simplification/SimplifiedBlock.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isodiamond
{
namespace
{

/** Errors that decimation is told one after the other, in parts of what is allowed: what one of
 * them does wrong is put back as the one before left it. */
constexpr std::array<double, 4> Parts = { 0.25, 0.5, 0.75, 1.0 };

/** Of what is allowed at most: where less is, a triangle is not given away at once. */
constexpr double LeastPart = 0.25;

/** Blocks have about so many triangles on average. */
constexpr double TrianglesOfBlock = 16000.0;

/** Allowances of less than this part of a triangle's length are none. */
constexpr double LeastOfTypical = 1e-3;

/** Larger blocks than this, in triangles, are cut in two where all trials were in vain. */
constexpr std::size_t SmallestBlock = 250;

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

/** Simplifies the blocks of a mesh, each on its own. */
AllowedMesh SimplifyEach(const AllowedMesh& mesh, const MeshBlocks& blocks,
  const Decimation& decimate, Choose choose, const ParallelFor& parallelFor)
{
  std::vector<AllowedMesh> made(blocks.Count());
  ForEachIndex(parallelFor, made.size(), 1,
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

/** A block's triangles, or fewer. */
AllowedMesh SimplifyBlock(const AllowedMesh& original, const Decimation& decimate, Choose choose)
{
  SimplifiedBlock block(original);
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
        // Where much goes wrong, less of it is tried again.
        const AllowedMesh& rest = block.Result();
        return rest.Mesh.Triangles.size() > SmallestBlock
          ? SimplifyEach(
              rest, CutInTwo(rest.Mesh), decimate, part == Parts[0] ? choose : Most, SerialFor)
          : rest;
      }
    }
  }
  return block.Result();
}

/** The root of a triangle's mean area. */
double TypicalLength(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const Vector normal =
      Cross(mesh.Corner(i, 1) - mesh.Corner(i, 0), mesh.Corner(i, 2) - mesh.Corner(i, 0));
    area += 0.5 * std::sqrt(Dot(normal, normal));
  }
  return std::sqrt(area / static_cast<double>(mesh.Triangles.size()));
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
  // A surface that goes through a cube once has about its face's area there.
  const double typical = TypicalLength(mesh.Mesh);
  const double size = std::sqrt(TrianglesOfBlock) * typical;
  if (!(Most(mesh.Allowances).front() > LeastOfTypical * typical))
  {
    return mesh; // nothing to be saved, but much to be tried
  }
  AllowedMesh result = mesh;
  for (const Pass& pass : passes)
  {
    const MeshBlocks blocks = CutIntoBlocks(result.Mesh, pass.Size * size, pass.Shift);
    result = SimplifyEach(result, blocks, decimate, pass.ChooseAllowances, parallelFor);
  }
  return result;
}

}
