// SPDX-License-Identifier: BSD-3-Clause
// Compiled only if meshoptimizer is found.
#include "OtherContestants.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <meshoptimizer.h>

namespace benchmark
{
namespace
{

using Indices = std::vector<unsigned int>;

/** The vertex ids of a surface's triangles, as meshoptimizer needs them. */
Indices IndicesOf(vtkPolyData* surface)
{
  Indices indices;
  surface->GetPolys()->Visit(
    [&](auto& triangles)
    {
      auto* ids = triangles.GetConnectivity();
      indices.assign(ids->Begin(), ids->End());
    });
  return indices;
}

/** The triangles of a simplified surface, on the points of the original; down to the goal if
 *  possible. */
Indices Simplify(vtkPolyData* surface, double goal)
{
  const Indices indices = IndicesOf(surface);
  auto* points = vtkFloatArray::SafeDownCast(surface->GetPoints()->GetData());
  const auto target = 3 * static_cast<std::size_t>(goal);
  Indices simplified(indices.size());
  simplified.resize(meshopt_simplify(simplified.data(), indices.data(), indices.size(),
    points->Begin(), surface->GetNumberOfPoints(), 3 * sizeof(float), target,
    1e10F /* whatever the error */, 0, nullptr));
  return simplified;
}

}

std::vector<Contestant> MeshOptimizerContestants(const Task& task, const Goal& triangles)
{
  const auto contour = MakeFlyingEdges(task);
  const auto simplified = std::make_shared<Indices>();
  Contestant contestant;
  contestant.Name = "flying edges + meshopt_simplify";
  contestant.Run = [contour, simplified, triangles]
  {
    contour->Modified();
    contour->Update();
    vtkPolyData* surface = contour->GetOutput();
    if (surface->GetNumberOfCells() > 0)
    {
      const double tenth = 0.1 * surface->GetNumberOfCells();
      *simplified = Simplify(surface, *triangles > 0.0 ? *triangles : tenth);
    }
  };
  contestant.Describe = [simplified](Figures& figures)
  { figures.Set("cells", simplified->size() / 3); };
  contestant.Release = [contour, simplified]
  {
    contour->GetOutput()->Initialize();
    *simplified = {};
  };
  contestant.StartsFromVolume = true;
  return { contestant };
}

}
