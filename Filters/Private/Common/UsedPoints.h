// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_UsedPoints_h
#define vtkIsodiamond_UsedPoints_h

#include "Field/Vector.h"
#include "Mesh/KeptPoints.h"
#include "Private/Common/Cells.h"

#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

/**
 * @file UsedPoints.h
 * Meshes given to the core, which returns them with other cells that use some of the points.
 */
namespace vtkIsodiamond
{

inline std::vector<isodiamond::Vector> PositionsOf(vtkPoints* points)
{
  std::vector<isodiamond::Vector> positions(points->GetNumberOfPoints());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->GetPoint(static_cast<vtkIdType>(i), positions[i].data());
  }
  return positions;
}

/** The points that cells use, in their order. */
class UsedPoints
{
public:
  template <std::size_t Size>
  UsedPoints(const std::vector<std::array<std::uint32_t, Size>>& cells, std::size_t pointCount,
    const isodiamond::ParallelFor& parallelFor)
    : Points(static_cast<std::int64_t>(pointCount), cells.empty() ? nullptr : cells.front().data(),
        static_cast<std::int64_t>(Size * cells.size()), parallelFor)
  {
  }

  /** Their previous ids. */
  std::vector<vtkIdType> Ids() const { return this->Points.Ids<vtkIdType>(); }

  /** By previous id; -1 for points that no cell uses. */
  vtkIdType NewId(std::uint32_t point) const
  {
    return this->Points.Contains(point) ? this->Points.NewId(point) : -1;
  }

  /** The cells with the new ids. */
  template <std::size_t Size>
  vtkSmartPointer<vtkCellArray> Write(const std::vector<std::array<std::uint32_t, Size>>& cells,
    const isodiamond::ParallelFor& parallelFor) const
  {
    return WriteCells(static_cast<std::int64_t>(cells.size()), static_cast<int>(Size),
      this->Points.Count(), parallelFor,
      [&](auto* connectivity)
      {
        using Id = std::remove_pointer_t<decltype(connectivity)>;
        for (const std::array<std::uint32_t, Size>& points : cells)
        {
          connectivity = std::transform(points.begin(), points.end(), connectivity,
            [&](std::uint32_t point) { return static_cast<Id>(this->Points.NewId(point)); });
        }
      });
  }

private:
  isodiamond::KeptPoints Points;
};

}

#endif
