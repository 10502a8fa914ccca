// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/TopologyTestTools.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

namespace test
{
namespace
{

/** Disjoint sets of numbers from 0 on. */
class Groups
{
public:
  explicit Groups(std::size_t count)
    : Next(count)
  {
    std::iota(this->Next.begin(), this->Next.end(), 0);
  }
  std::int32_t Of(std::int32_t member)
  {
    while (this->Next[member] != member)
    {
      member = this->Next[member] = this->Next[this->Next[member]];
    }
    return member;
  }
  void Join(std::int32_t a, std::int32_t b) { this->Next[this->Of(a)] = this->Of(b); }

private:
  std::vector<std::int32_t> Next;
};

template <std::size_t Corners>
using Simplices = std::vector<std::array<std::int32_t, Corners>>;

/** All simplices on corners of cells, each as often as there are cells with it; sorted. */
template <std::size_t Corners, std::size_t CellCorners>
Simplices<Corners> SimplicesOf(const Simplices<CellCorners>& cells)
{
  Simplices<Corners> simplices;
  for (std::array<std::int32_t, CellCorners> cell : cells)
  {
    std::sort(cell.begin(), cell.end());
    std::array<bool, CellCorners> isChosen{};
    std::fill_n(isChosen.begin(), Corners, true);
    do
    {
      std::array<std::int32_t, Corners> simplex{};
      std::size_t size = 0;
      for (std::size_t i = 0; i < CellCorners; ++i)
      {
        if (isChosen[i])
        {
          simplex[size++] = cell[i];
        }
      }
      simplices.push_back(simplex);
    } while (std::prev_permutation(isChosen.begin(), isChosen.end()));
  }
  std::sort(simplices.begin(), simplices.end());
  return simplices;
}

/** Counts simplices and joins boundaries, by piece. */
template <std::size_t CellCorners>
class Counter
{
public:
  explicit Counter(const Simplices<CellCorners>& cells)
    : Cells(cells)
    , Vertices(SimplicesOf<1>(cells))
    , Sides(SimplicesOf<CellCorners - 1>(cells))
    , PieceOf(this->Vertices.empty() ? 0 : this->Vertices.back()[0] + 1)
    , PartOf(this->Vertices.empty() ? 0 : this->Vertices.back()[0] + 1)
    , Pieces(this->Vertices.empty() ? 0 : this->Vertices.back()[0] + 1)
  {
    for (const auto& cell : cells)
    {
      for (const std::int32_t corner : cell)
      {
        this->PieceOf.Join(corner, cell[0]);
      }
    }
    this->Vertices.erase(
      std::unique(this->Vertices.begin(), this->Vertices.end()), this->Vertices.end());
  }

  PiecesTopology Count()
  {
    this->Add(this->Vertices);
    if constexpr (CellCorners == 4)
    {
      this->Add(SimplicesOf<2>(this->Cells));
    }
    this->Add(this->Sides);
    this->Add(this->Cells);
    this->CountBoundaryParts();
    PiecesTopology pieces;
    for (const auto& [vertex] : this->Vertices)
    {
      if (this->PieceOf.Of(vertex) == vertex)
      {
        pieces.push_back(this->Pieces[vertex]);
      }
    }
    std::sort(pieces.begin(), pieces.end());
    return pieces;
  }

private:
  /** Adds simplices of one dimension to the Euler numbers. */
  template <std::size_t Corners>
  void Add(Simplices<Corners> simplices)
  {
    simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
    for (const auto& simplex : simplices)
    {
      this->Pieces[this->PieceOf.Of(simplex[0])].EulerNumber += Corners % 2 == 1 ? 1 : -1;
    }
  }

  void CountBoundaryParts()
  {
    const Simplices<CellCorners - 1>& sides = this->Sides;
    std::vector<std::int32_t> onBoundary;
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      const bool isShared =
        (i > 0 && sides[i - 1] == sides[i]) || (i + 1 < sides.size() && sides[i + 1] == sides[i]);
      for (const std::int32_t corner : sides[i])
      {
        if (!isShared)
        {
          this->PartOf.Join(corner, sides[i][0]);
          onBoundary.push_back(corner);
        }
      }
    }
    std::sort(onBoundary.begin(), onBoundary.end());
    onBoundary.erase(std::unique(onBoundary.begin(), onBoundary.end()), onBoundary.end());
    for (const std::int32_t vertex : onBoundary)
    {
      this->Pieces[this->PieceOf.Of(vertex)].BoundaryParts +=
        this->PartOf.Of(vertex) == vertex ? 1 : 0;
    }
  }

  const Simplices<CellCorners>& Cells;
  Simplices<1> Vertices;
  Simplices<CellCorners - 1> Sides; ///< each as often as there are cells with it
  Groups PieceOf;
  Groups PartOf;
  PiecesTopology Pieces; ///< by vertex; a piece's is at the vertex that stands for it
};

/** Removes the cells of a mesh whose middle is in a hidden cell of the grid, and their levels. */
template <typename Point, std::size_t Corners>
void RemoveHidden(const std::vector<Point>& points, const isodiamond::HiddenCells& hidden,
  Simplices<Corners>& cells, std::vector<std::int16_t>& levels)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    isodiamond::Point at{};
    for (int axis = 0; axis < 3; ++axis)
    {
      double sum = 0.0;
      for (const std::int32_t corner : cells[i])
      {
        sum += points[corner][axis];
      }
      at[axis] = static_cast<int>(std::floor(sum / Corners));
    }
    if (!hidden(at))
    {
      cells[kept] = cells[i];
      levels[kept++] = levels[i];
    }
  }
  cells.resize(kept);
  levels.resize(kept);
}

void Write(std::ostream& stream, const char* name, const PiecesTopology& pieces)
{
  stream << name << ":";
  for (std::size_t i = 0; i < pieces.size();)
  {
    const auto end = std::upper_bound(pieces.begin(), pieces.end(), pieces[i]);
    const auto count = static_cast<std::size_t>(end - pieces.begin()) - i;
    stream << ' ' << count << " of (" << pieces[i].EulerNumber << ", " << pieces[i].BoundaryParts
           << ')';
    i += count;
  }
  stream << "; ";
}

}

PiecesTopology TopologyOf(const std::vector<std::array<std::int32_t, 3>>& triangles)
{
  return Counter<3>(triangles).Count();
}

PiecesTopology TopologyOf(const std::vector<std::array<std::int32_t, 4>>& tetrahedra)
{
  return Counter<4>(tetrahedra).Count();
}

Topology::Topology(const AnyMesh& mesh)
{
  if (!mesh.Interval.Tetrahedra.empty())
  {
    this->Interval = TopologyOf(mesh.Interval.Tetrahedra);
    this->Surfaces = { TopologyOf(SurfaceFaces(mesh.Interval, -1)),
      TopologyOf(SurfaceFaces(mesh.Interval, 1)) };
  }
  else
  {
    this->Surfaces[0] = TopologyOf(mesh.Surface.Triangles);
  }
}

std::ostream& operator<<(std::ostream& stream, const Topology& topology)
{
  Write(stream, "volume", topology.Interval);
  Write(stream, "surface", topology.Surfaces[0]);
  Write(stream, "upper surface", topology.Surfaces[1]);
  return stream;
}

AnyMesh WithoutHidden(AnyMesh mesh, const isodiamond::HiddenCells& hidden)
{
  RemoveHidden(mesh.Surface.Points, hidden, mesh.Surface.Triangles, mesh.Surface.Levels);
  RemoveHidden(mesh.Interval.Points, hidden, mesh.Interval.Tetrahedra, mesh.Interval.Levels);
  return mesh;
}

}
