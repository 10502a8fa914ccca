// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_VertexPlaces_h
#define isodiamond_VertexPlaces_h

#include "Patches/IntervalPatches.h"
#include "Stuffing/Background.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/** Where the vertices of a background mesh are: where they were, or moved to an isovertex. */
struct VertexPlaces
{
  explicit VertexPlaces(const CutMesh& leaves)
    : Goals(leaves.Vertices.size(), CutMesh::None)
  {
    this->States.reserve(leaves.Vertices.size());
    for (const CutMesh::Vertex& vertex : leaves.Vertices)
    {
      this->States.push_back(static_cast<std::uint8_t>(2 * vertex.Sign));
    }
  }

  std::vector<std::uint8_t> States; ///< by vertex, see VertexState
  std::vector<std::uint32_t> Goals; ///< by vertex: the point that it was moved to, or None
};

/** A view of places; one vertex may be seen elsewhere, as it would be if it was moved. */
class PlacesView
{
public:
  /** @param places must outlive it */
  PlacesView(const VertexPlaces& places) // NOLINT(google-explicit-constructor): the same
    : Places(places)
  {
  }
  /** @param goal the point that a vertex would be at, on a surface */
  PlacesView(const VertexPlaces& places, std::uint32_t vertex, int state, std::uint32_t goal)
    : Places(places)
    , Vertex(vertex)
    , State(state)
    , Goal(goal)
  {
  }

  int StateOf(std::uint32_t vertex) const
  {
    return vertex == this->Vertex ? this->State : this->Places.States[vertex];
  }
  std::uint32_t GoalOf(std::uint32_t vertex) const
  {
    return vertex == this->Vertex ? this->Goal : this->Places.Goals[vertex];
  }
  const Vector& PositionOf(const Background& mesh, std::uint32_t vertex) const
  {
    const std::uint32_t goal = this->GoalOf(vertex);
    return goal == CutMesh::None ? mesh.PositionOf(vertex) : mesh.PointAt(goal);
  }

  /** Whether a surface crosses an edge of leaves between its ends. */
  bool IsCut(std::uint32_t first, std::uint32_t second, int surface) const
  {
    const int a = this->StateOf(first);
    const int b = this->StateOf(second);
    const int on = StateOn(surface);
    return (a < on && b > on) || (a > on && b < on);
  }

private:
  const VertexPlaces& Places;
  std::uint32_t Vertex = CutMesh::None;
  int State = 0;
  std::uint32_t Goal = CutMesh::None;
};

}

#endif
