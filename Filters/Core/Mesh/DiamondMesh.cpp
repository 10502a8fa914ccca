// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/DiamondMesh.h"

#include "Mesh/CurrentMesh.h"

#include <map>

namespace isodiamond
{

DiamondMesh ExtractDiamondMesh(const RefinedSet& refined)
{
  const IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  const bool onlyCrossed = hierarchy.Header().TheModel == Model::Minimal;
  DiamondMesh mesh;
  std::map<Point, std::int64_t> ids;
  const auto idOf = [&](const Point& point)
  {
    const auto [entry, isNew] = ids.emplace(point, static_cast<std::int64_t>(mesh.Points.size()));
    if (isNew)
    {
      mesh.Points.push_back(point);
    }
    return entry->second;
  };
  for (const BrickPlace& brick : AllBricks(refined.Diamonds()))
  {
    ForEachLeaf(
      refined, brick,
      [&](std::uint32_t rank) { return onlyCrossed ? hierarchy.CarryingEdges(rank) : AllEdges; },
      [&](const Leaf& leaf)
      {
        const int h = 1 << leaf.Parent.Scale;
        const Point centre = h * leaf.Parent.Position;
        if (!hierarchy.SampleGrid().IsSampled(centre))
        {
          return;
        }
        std::array<std::int64_t, 4> ends = { idOf(centre), 0, 0, 0 };
        for (int i = 0; i < 3; ++i)
        {
          ends[i + 1] = idOf(centre + h * leaf.Shape.Offsets[leaf.Half.Vertices[i]]);
        }
        mesh.Tetrahedra.push_back(ends);
        mesh.Levels.push_back(
          static_cast<std::int8_t>(hierarchy.SampleGrid().Depth() - 1 - leaf.Scale));
        mesh.Classes.push_back(static_cast<std::int8_t>((leaf.Shape.DiamondClass + 1) % 3));
      });
  }
  return mesh;
}

}
