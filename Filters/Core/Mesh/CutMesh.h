// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CutMesh_h
#define isodiamond_CutMesh_h

#include "Field/GridGeometry.h"
#include "Field/HiddenCells.h"
#include "Mesh/ExtractionPasses.h"
#include "Mesh/PatchPoints.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace isodiamond
{

/**
 * The leaves of an interval volume before they are cut, for code that cuts them differently.
 *
 * Points are those of the interval volume's mesh (see IntervalExtraction): the vertices inside, and
 * the isovertices, where surfaces cut edges.
 */
struct CutMesh
{
  static constexpr std::uint32_t None = 0xffffffff;

  struct Vertex
  {
    Point Position{};             ///< in index space
    std::uint8_t Sign = 0;        ///< 0, 1, 2: below, inside, above
    bool IsFixed = false;         ///< whether it has to stay: the corners of hidden cells do
    std::uint8_t Pins = 0;        ///< see PinsOf()
    std::uint32_t PointId = None; ///< in the mesh; only for vertices inside
  };

  struct Tetrahedron
  {
    std::array<std::uint32_t, 4> Vertices{}; ///< from the youngest to the oldest
    /** For each edge, in the order of EdgeByAge(): the isovertices on the lower and the upper
     *  surface, as points of the mesh, or None. */
    std::array<std::array<std::uint32_t, 2>, 6> Cuts{};
    bool IsOdd = false; ///< whether this order is negatively oriented in index space
    std::int8_t Level = 0;
  };

  std::vector<Vertex> Vertices;
  std::vector<Tetrahedron> Tetrahedra;
};

/** The index in CutMesh::Tetrahedron::Cuts of the edge between two vertices. */
inline constexpr int CutEdge(int younger, int older)
{
  return EdgeByAge(younger, older) - EdgeByAge(0, 1);
}

/** Pins vertices. @param positions PackedPoint() of each, sorted, as often as it is pinned */
void Pin(CutMesh& mesh, const std::vector<std::uint64_t>& positions);

/** How often a leaf is pinned: as often as all of its vertices are. The more often, the less
 *  surfaces may move there. */
int PinsOf(const CutMesh& mesh, std::size_t leaf);

/** The world positions of the vertices. */
std::vector<Vector> VerticesInWorld(const CutMesh& mesh, const GridGeometry& world);

/** The diamond that a leaf lies in, around its longest edge; none at full resolution. */
std::optional<Place> DiamondOf(const CutMesh& mesh, std::size_t leaf, const Grid& grid);

/** Collects the leaves that carry something and are not hidden. @param passes of a volume */
CutMesh MakeCutMesh(const ExtractionPasses& passes, const HiddenCells* hidden);

}

#endif
