// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_UsedPoints_h
#define vtkIsodiamond_UsedPoints_h

#include "Field/Vector.h"
#include "Private/Cells.h"

#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

/**
 * @file UsedPoints.h
 * Meshes that the core was given, and gives back with other cells of some of the points.
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

/** The points that cells have, in their order. */
struct UsedPoints
{
  std::vector<vtkIdType> NewIds; ///< by id before; -1 of those that no cell has
  std::vector<vtkIdType> Kept;   ///< ids before

  template <std::size_t Size>
  UsedPoints(const std::vector<std::array<std::uint32_t, Size>>& cells, std::size_t pointCount)
    : NewIds(pointCount, -1)
  {
    for (const std::array<std::uint32_t, Size>& points : cells)
    {
      std::for_each(
        points.begin(), points.end(), [&](std::uint32_t point) { this->NewIds[point] = 0; });
    }
    for (std::size_t i = 0; i < pointCount; ++i)
    {
      if (this->NewIds[i] == 0)
      {
        this->NewIds[i] = static_cast<vtkIdType>(this->Kept.size());
        this->Kept.push_back(static_cast<vtkIdType>(i));
      }
    }
  }

  /** The cells with the new ids. */
  template <std::size_t Size>
  vtkSmartPointer<vtkCellArray> Write(const std::vector<std::array<std::uint32_t, Size>>& cells,
    const isodiamond::ParallelFor& parallelFor) const
  {
    return WriteCells(static_cast<std::int64_t>(cells.size()), static_cast<int>(Size), parallelFor,
      [&](auto* connectivity)
      {
        using Id = std::remove_pointer_t<decltype(connectivity)>;
        for (const std::array<std::uint32_t, Size>& points : cells)
        {
          connectivity = std::transform(points.begin(), points.end(), connectivity,
            [&](std::uint32_t point) { return static_cast<Id>(this->NewIds[point]); });
        }
      });
  }
};

}

#endif
