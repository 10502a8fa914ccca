// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Background.h"

namespace isodiamond
{

std::vector<Crossing> Background::FindCrossings(const CutMesh& cut, std::size_t pointCount)
{
  std::vector<Crossing> crossings(pointCount);
  for (const CutMesh::Tetrahedron& leaf : cut.Tetrahedra)
  {
    for (int younger = 0; younger < 3; ++younger)
    {
      for (int older = younger + 1; older < 4; ++older)
      {
        const auto& cuts = leaf.Cuts[CutEdge(younger, older)];
        for (int surface = 0; surface < 2; ++surface)
        {
          if (cuts[surface] != CutMesh::None)
          {
            crossings[cuts[surface]] = { { leaf.Vertices[younger], leaf.Vertices[older] },
              static_cast<std::int8_t>(surface) };
          }
        }
      }
    }
  }
  return crossings;
}

}
