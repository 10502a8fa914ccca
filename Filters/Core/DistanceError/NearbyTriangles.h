// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_NearbyTriangles_h
#define isodiamond_NearbyTriangles_h

#include "DistanceError/FineSurface.h"
#include "Patches/PatchDistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace isodiamond
{

/** The triangle that is nearest to some point. */
struct NearestTriangle
{
  double Squared = std::numeric_limits<double>::infinity();
  TriangleDistance Triangle;
};

/** A 32-bit number for each of eight things: loops over them become vector instructions. */
using Eight = std::array<float, 8>;

/** Eight axis-aligned boxes. */
struct EightBoxes
{
  std::array<Eight, 3> Middle{};
  std::array<Eight, 3> Half{}; ///< of the lengths

  /** Lower bounds of the squared distances, times four. @param slack what rounding can change */
  Eight Away(const std::array<float, 3>& from, float slack) const
  {
    const float x = from[0];
    const float y = from[1];
    const float z = from[2];
    Eight away;
    for (int i = 0; i < 8; ++i)
    {
      const float dx = std::abs(this->Middle[0][i] - x) - this->Half[0][i] - slack;
      const float dy = std::abs(this->Middle[1][i] - y) - this->Half[1][i] - slack;
      const float dz = std::abs(this->Middle[2][i] - z) - this->Half[2][i] - slack;
      // Twice what is positive, without a branch.
      const float twiceX = dx + std::abs(dx);
      const float twiceY = dy + std::abs(dy);
      const float twiceZ = dz + std::abs(dz);
      away[i] = twiceX * twiceX + twiceY * twiceY + twiceZ * twiceZ;
    }
    return away;
  }
};

/** Eight triangles, each given by its plane and three that stand on its sides. */
struct EightTriangles
{
  /** The signed distance from a plane is a dot product with a normal, less an offset. */
  struct Planes
  {
    std::array<Eight, 3> Normal{};
    Eight Offset{};

    void Set(int index, const Vector& normal, double offset)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Normal[axis][index] = static_cast<float>(normal[axis]);
      }
      this->Offset[index] = static_cast<float>(offset);
    }
  };

  Planes Flat;
  std::array<Planes, 3> Walls; ///< outward

  /** As for boxes: by how far it is from the plane, and how far beyond a side. */
  Eight Away(const std::array<float, 3>& from, float slack) const
  {
    const float x = from[0];
    const float y = from[1];
    const float z = from[2];
    const auto height = [=](const Planes& planes, int i)
    {
      return planes.Normal[0][i] * x + planes.Normal[1][i] * y + planes.Normal[2][i] * z -
        planes.Offset[i];
    };
    Eight away;
    for (int i = 0; i < 8; ++i)
    {
      const float above = std::abs(height(this->Flat, i)) - slack;
      const float first = height(this->Walls[0], i);
      const float second = height(this->Walls[1], i);
      const float third = height(this->Walls[2], i);
      // Maxima, and what is positive, without a branch.
      const float both = 0.5F * (first + second + std::abs(first - second));
      const float beside = 0.5F * (both + third + std::abs(both - third)) - slack;
      const float twiceAbove = above + std::abs(above);
      const float twiceBeside = beside + std::abs(beside);
      away[i] = twiceAbove * twiceAbove + twiceBeside * twiceBeside;
    }
    return away;
  }
};

/**
 * The triangles of full resolution in some cells, gathered once for many searches for the nearest.
 *
 * A box around every eight tells whether these may be nearer than what was found; if so, their
 * planes tell which. That is done in 32-bit numbers. Few triangles are left to be measured.
 */
template <typename Lengths>
class NearbyTriangles
{
public:
  /** Lengths must outlive it. */
  explicit NearbyTriangles(const Lengths& lengths)
    : InWorld(lengths)
    , PerUnit(1.0 / lengths.TypicalStep())
  {
  }

  /** Forgets all. */
  void Clear()
  {
    this->From = {};
    this->GroupCount = 0;
  }

  /** Replaces all by the triangles in some cells. */
  void Gather(const FineSurface& fine, const CellBox& cells)
  {
    this->Clear();
    this->From = cells;
    this->Origin = this->InWorld(FineUnits * cells.Low);
    fine.ForEachCell(cells,
      [&](const Point& /*cell*/, const auto& triangles)
      {
        this->AddGroup();
        triangles([&](const FineSurface::Triangle& triangle) { this->Add(triangle); });
        return true;
      });
    this->MakeBoxes();
  }

  /** The cells that were looked at. */
  const CellBox& Cells() const { return this->From; }

  /** Replaces a triangle by one of these, if that is nearer: the nearest, or one that is near
   *  enough. */
  void FindNearer(const Vector& point, double squaredEnough, NearestTriangle& nearest)
  {
    if (this->GroupCount == 0)
    {
      return;
    }
    const Place from = this->InUnits(point);
    const float slack =
      1e-6F * (this->Extent + std::abs(from[0]) + std::abs(from[1]) + std::abs(from[2]));
    std::size_t first = 0; // the group that seems to be the nearest
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < this->GroupCount; i += 8)
    {
      const Eight away = this->Boxes[i / 8].Away(from, slack);
      for (std::size_t j = i; j < std::min(i + 8, this->GroupCount); ++j)
      {
        this->Away[j] = away[j - i];
        first = away[j - i] < least ? j : first;
        least = std::min(least, away[j - i]);
      }
    }
    Search search{ point, from, slack, this->SquaredInUnits(nearest.Squared), nearest.Squared,
      nullptr };
    this->LookAt(first, search);
    for (std::size_t i = 0; i < this->GroupCount && search.Squared > squaredEnough; ++i)
    {
      if (!(this->Away[i] > search.Limit) && i != first)
      {
        this->LookAt(i, search);
      }
    }
    if (search.Found != nullptr)
    {
      nearest = { search.Squared, *search.Found };
    }
  }

private:
  using Place = std::array<float, 3>;

  struct Search
  {
    const Vector& Point;
    Place From;
    float Slack;
    float Limit; ///< what is more is farther, except what is not a number
    double Squared;
    const TriangleDistance* Found;
  };

  /** Eight triangles, or fewer. What is needed to measure them is made when first asked for. */
  struct Group
  {
    int Count = 0;
    bool HasPlanes = false;
    std::array<std::array<Vector, 3>, 8> Corners;
    std::array<TriangleDistance, 8> Distances;
    EightTriangles Planes;
  };

  void LookAt(std::size_t index, Search& search)
  {
    Group& group = this->Groups[index];
    this->MakePlanes(group);
    const Eight away = group.Planes.Away(search.From, search.Slack);
    for (int i = 0; i < group.Count; ++i)
    {
      if (!(away[i] > search.Limit))
      {
        const double squared = group.Distances[i].Squared(search.Point);
        if (squared < search.Squared)
        {
          search.Squared = squared;
          search.Limit = this->SquaredInUnits(squared);
          search.Found = &group.Distances[i];
        }
      }
    }
  }

  void MakePlanes(Group& group) const
  {
    if (group.HasPlanes)
    {
      return;
    }
    group.HasPlanes = true;
    for (int i = 0; i < group.Count; ++i)
    {
      const std::array<Vector, 3>& corners = group.Corners[i];
      const TriangleDistance& triangle =
        group.Distances[i] = { corners[0], corners[1], corners[2] };
      this->SetPlane(group.Planes.Flat, i, triangle.Across(), corners[0]);
      for (int side = 0; side < 3; ++side)
      {
        const TriangleDistance::Wall wall = triangle.WallOf(side);
        this->SetPlane(group.Planes.Walls[side], i, wall.Outward, wall.Point);
      }
    }
  }

  /** Without a direction, nothing counts as far from the plane. */
  void SetPlane(
    EightTriangles::Planes& planes, int index, const Vector& across, const Vector& point) const
  {
    const double length = std::sqrt(Dot(across, across));
    const Vector normal = length > 0.0 ? (1.0 / length) * across : Vector{};
    planes.Set(index, normal, this->PerUnit * Dot(point - this->Origin, normal));
  }

  Place InUnits(const Vector& point) const
  {
    const Vector offset = this->PerUnit * (point - this->Origin);
    return { static_cast<float>(offset[0]), static_cast<float>(offset[1]),
      static_cast<float>(offset[2]) };
  }
  /** Four times a squared length, like the bounds, and a little more. */
  float SquaredInUnits(double squared) const
  {
    return static_cast<float>(4.00004 * squared * this->PerUnit * this->PerUnit);
  }

  void AddGroup()
  {
    if (this->GroupCount == this->Groups.size())
    {
      this->Groups.resize(this->GroupCount + 64);
    }
    Group& next = this->Groups[this->GroupCount++];
    next.Count = 0;
    next.HasPlanes = false;
  }

  void Add(const FineSurface::Triangle& triangle)
  {
    if (this->Groups[this->GroupCount - 1].Count == 8)
    {
      this->AddGroup();
    }
    Group& group = this->Groups[this->GroupCount - 1];
    group.Corners[group.Count++] = { this->InWorld(triangle[0]), this->InWorld(triangle[1]),
      this->InWorld(triangle[2]) };
  }

  void MakeBoxes()
  {
    this->Boxes.resize((this->GroupCount + 7) / 8);
    this->Away.resize(this->GroupCount);
    this->Extent = 0.0F;
    for (std::size_t i = 0; i < this->GroupCount; ++i)
    {
      const Group& group = this->Groups[i];
      Vector low = group.Corners[0][0];
      Vector high = low;
      for (int j = 0; j < group.Count; ++j)
      {
        for (const Vector& corner : group.Corners[j])
        {
          for (int axis = 0; axis < 3; ++axis)
          {
            low[axis] = std::min(low[axis], corner[axis]);
            high[axis] = std::max(high[axis], corner[axis]);
          }
        }
      }
      const Place from = this->InUnits(low);
      const Place to = this->InUnits(high);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Boxes[i / 8].Middle[axis][i % 8] = 0.5F * (from[axis] + to[axis]);
        this->Boxes[i / 8].Half[axis][i % 8] = 0.5F * (to[axis] - from[axis]);
        this->Extent = std::max({ this->Extent, std::abs(from[axis]), std::abs(to[axis]) });
      }
    }
  }

  const Lengths& InWorld;
  double PerUnit; ///< boxes are in units of about one step of the lattice
  CellBox From;
  Vector Origin{};
  std::size_t GroupCount = 0;
  std::vector<Group> Groups;     ///< the first GroupCount; memory is kept
  std::vector<EightBoxes> Boxes; ///< of the groups
  std::vector<float> Away;       ///< how far from the groups a point is
  float Extent = 0.0F;           ///< the greatest coordinate
};

}

#endif
