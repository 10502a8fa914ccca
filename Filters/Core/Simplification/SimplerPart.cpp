// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SimplerPart.h"

#include "Simplification/EdgeCollapses.h"
#include "Simplification/PartDistance.h"
#include "Simplification/SelfIntersections.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace isodiamond
{
namespace
{

/** Where more than this part of what collapses have saved had to be undone, less is tried. */
constexpr double MuchUndone = 0.05;
constexpr double LessOfUsedPart = 0.85;

std::size_t CountThere(const LinkedTriangles& mesh)
{
  return std::count_if(mesh.Triangles.begin(), mesh.Triangles.end(),
    [](const Triangle& triangle) { return triangle[0] != None; });
}

/** @return whether much had to be undone: with a collapse goes all that builds on it */
bool CollapseEdges(MeshPart& part, double usedPart)
{
  PartDistance distance(part, true);
  const SelfIntersections intersections(part);
  EdgeCollapses collapses(part, usedPart);
  std::vector<bool> isTouched = collapses.Run();
  const std::size_t tried = CountThere(collapses.Mesh());
  if (!UndoWhatIsWrong(intersections, distance, std::move(isTouched), collapses, SerialFor))
  {
    throw std::logic_error("What is wrong of a simpler mesh is as it was.");
  }
  for (std::size_t i = 0; i < part.Samples.size(); ++i)
  {
    part.Samples[i].Home = collapses.SampleHomes()[i];
  }
  const std::size_t before = CountThere(part.Simple);
  part.Simple = collapses.Mesh();
  const std::size_t undone = CountThere(part.Simple) - tried;
  return static_cast<double>(undone) > MuchUndone * static_cast<double>(before - tried);
}

}

bool UndoWhatIsWrong(const SelfIntersections& intersections, PartDistance& distance,
  std::vector<bool> isTouched, EdgeCollapses& collapses, const ParallelFor& parallelFor)
{
  for (;;)
  {
    intersections.Undo(collapses, isTouched);
    const PartDistance::Faults faults =
      distance.Find(collapses.Mesh(), collapses.SampleHomes(), isTouched, parallelFor);
    if (!faults.Any())
    {
      return true;
    }
    isTouched = collapses.Undo(faults.Triangles, faults.Points);
    if (std::find(isTouched.begin(), isTouched.end(), true) == isTouched.end())
    {
      return false;
    }
  }
}

void Simplify(MeshPart& part, double usedPart)
{
  if (CollapseEdges(part, usedPart))
  {
    CollapseEdges(part, LessOfUsedPart * usedPart);
  }
}

}
