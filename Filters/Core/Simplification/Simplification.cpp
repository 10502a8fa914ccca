// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Simplification.h"

#include "Simplification/SimplifiedMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace isodiamond
{
namespace
{

/** Allowances of less than this part of a triangle's length count as none. */
constexpr double LeastOfTypical = 1e-3;

/** The root of a triangle's mean area. */
double TypicalLength(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const Triangle& triangle : mesh.Triangles)
  {
    area += AreaOf(mesh.Positions, triangle);
  }
  return std::sqrt(area / static_cast<double>(mesh.Triangles.size()));
}

/** A pass, and where it cuts: what is at the border of parts in one is inside one in the next. */
struct Pass
{
  double Cut;
  double UsedPart; ///< of the allowances, by samples: where more was too much, less of it is tried
};

constexpr std::array<Pass, 2> Passes = { { { 0.5, 0.85 }, { 0.35, 0.75 } } };

/** In these, only what was held so far, or has something new around it, is tried: less, so parts
 *  can be this many times as large. */
constexpr std::size_t LargerOverSeams = 4;
constexpr std::array<Pass, 4> PassesOverSeams = { { { 0.62, 0.75 }, { 0.45, 0.75 }, { 0.7, 0.75 },
  { 0.3, 0.75 } } };

/** If it is less than this part of the triangles, that is not worth a pass. */
constexpr double LeastPartToTry = 0.005;

}

SimplerMesh Simplify(
  const AllowedMesh& mesh, const ParallelFor& parallelFor, std::size_t mostOfPart)
{
  if (mesh.Mesh.Triangles.empty() ||
    !(*std::max_element(mesh.Allowances.begin(), mesh.Allowances.end()) >
      LeastOfTypical * TypicalLength(mesh.Mesh)))
  {
    // There would be nothing to save, but much to try.
    return { mesh.Mesh, std::vector<std::uint32_t>(mesh.Mesh.Positions.size(), None) };
  }
  SimplifiedMesh simplified(mesh);
  for (const Pass& pass : Passes)
  {
    simplified.TryAllAgain();
    simplified.Simplify(mostOfPart, pass.Cut, pass.UsedPart, parallelFor);
  }
  for (const Pass& pass : PassesOverSeams)
  {
    if (simplified.PartToTry() < LeastPartToTry)
    {
      break;
    }
    simplified.Simplify(LargerOverSeams * mostOfPart, pass.Cut, pass.UsedPart, parallelFor);
  }
  return { { mesh.Mesh.Positions, simplified.Triangles() }, simplified.PointHomes() };
}

}
