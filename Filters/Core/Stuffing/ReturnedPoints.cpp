// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/ReturnedPoints.h"

#include "Stuffing/LocalMesh.h"
#include "Stuffing/SurfaceChanges.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** Whether a point on a surface can be replaced by the one that it was before it moved. */
bool CanReturn(const LocalMesh& mesh, std::uint32_t point, std::uint32_t source, double wanted)
{
  const LocalMesh::Star star = mesh.StarOf(point);
  return star.begin() != star.end() &&
    std::all_of(star.begin(), star.end(),
      [&](std::uint32_t tetrahedron)
      {
        Corners corners = mesh.CornersOf(tetrahedron);
        std::replace(corners.begin(), corners.end(), point, source);
        return mesh.SineOf(corners) >= wanted;
      }) &&
    CanShift(mesh, point, mesh.At(source));
}

}

TetrahedronMesh ReturnPoints(TetrahedronMesh mesh, double wanted)
{
  std::vector<std::uint32_t> moved;
  for (const BlendedPoint& blended : mesh.Blended)
  {
    if (mesh.Surfaces[blended.Point] != 0)
    {
      moved.push_back(blended.Point);
    }
  }
  if (moved.empty())
  {
    return mesh;
  }
  LocalMesh local(std::move(mesh));
  std::vector<std::uint32_t> changed;
  for (const std::uint32_t point : moved)
  {
    const std::uint32_t source = local.SourceOf(point);
    if (CanReturn(local, point, source, wanted))
    {
      local.Exchange(point, source, changed);
    }
  }
  return local.Take();
}

}
