// SPDX-License-Identifier: BSD-3-Clause
#ifndef TopologyTestTools_h
#define TopologyTestTools_h

#include "Field/HiddenCells.h"
#include "Tools/RandomTestTools.h"

#include <iosfwd>
#include <tuple>
#include <vector>

/** Counts of what homeomorphisms of a mesh preserve. */
namespace test
{

/** A connected piece of triangles or tetrahedra. As it is one component, these numbers give a
 *  surface's Betti numbers, and tell what it is; of a volume, they give its handles less its
 *  cavities. */
struct PieceTopology
{
  int EulerNumber = 0;   ///< vertices less edges plus triangles less tetrahedra
  int BoundaryParts = 0; ///< components of the edges, or faces, of only one cell

  bool operator<(const PieceTopology& other) const
  {
    return std::tie(this->EulerNumber, this->BoundaryParts) <
      std::tie(other.EulerNumber, other.BoundaryParts);
  }
  bool operator==(const PieceTopology& other) const
  {
    return this->EulerNumber == other.EulerNumber && this->BoundaryParts == other.BoundaryParts;
  }
};

/** Of all pieces, sorted. */
using PiecesTopology = std::vector<PieceTopology>;
PiecesTopology TopologyOf(const std::vector<std::array<std::int32_t, 3>>& triangles);
PiecesTopology TopologyOf(const std::vector<std::array<std::int32_t, 4>>& tetrahedra);

/** Of a mesh: all pieces of the isosurface, or of the interval volume and of its two surfaces. */
struct Topology
{
  PiecesTopology Interval;
  std::array<PiecesTopology, 2> Surfaces;

  explicit Topology(const AnyMesh& mesh);

  bool operator==(const Topology& other) const
  {
    return this->Interval == other.Interval && this->Surfaces == other.Surfaces;
  }
  std::size_t PieceCount() const { return this->Surfaces[0].size() + this->Surfaces[1].size(); }
};
/** In brief, for messages. */
std::ostream& operator<<(std::ostream& stream, const Topology& topology);

/** The mesh without what lies in hidden cells; none of its cells may lie in one only partly. */
AnyMesh WithoutHidden(AnyMesh mesh, const isodiamond::HiddenCells& hidden);

}

#endif
