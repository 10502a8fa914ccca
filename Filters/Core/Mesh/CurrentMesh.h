// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CurrentMesh_h
#define isodiamond_CurrentMesh_h

#include "Lattice/HalfTetrahedronMasks.h"
#include "Lattice/OccupancyWindow.h"
#include "Refinement/RefinedSet.h"

#include <array>

/**
 * @file CurrentMesh.h
 * The current mesh of a refined set.
 *
 * Its tetrahedra, the *leaves*, are the half-tetrahedra of refined diamonds whose child is not
 * refined and whose vertices all have samples. Its edges are the subdivision edges of refined
 * diamonds at whose midpoints no refined diamond is centred.
 */
namespace isodiamond
{

/** The diamonds of a brick's scale in the brick and just after it: the position of a child of the
 *  same scale is even on the axes where it differs from its parent's, which is odd there. */
using SameScaleWindow = OccupancyWindow<9>;

/** The diamonds of the next finer scale, around the doubled positions. */
inline constexpr int FinerWidth = 17;
using FinerWindow = OccupancyWindow<FinerWidth>;

namespace tables
{

inline constexpr std::array<std::array<std::int16_t, MaximumChildren>, 64> MakeChildDistances()
{
  std::array<std::array<std::int16_t, MaximumChildren>, 64> distances{};
  for (std::size_t type = 0; type < distances.size(); ++type)
  {
    const TypeTable& shape = Types[type];
    for (int i = 0; i < shape.ChildCount; ++i)
    {
      const Point& offset = shape.ChildOffsets[i];
      distances[type][i] = static_cast<std::int16_t>(
        shape.ChildStep == 0 ? SameScaleWindow::Distance(offset) : FinerWindow::Distance(offset));
    }
  }
  return distances;
}

/** In a FinerWindow, by parity: from a diamond to the middles of its edges. */
inline constexpr auto MiddleDistances = MakeVertexDistances<FinerWidth>();

/** By type: from a diamond to its children, in the window of their scale. */
inline constexpr auto ChildDistances = MakeChildDistances();

}

/** Finds what belongs to the current mesh among the edges and children of a brick's diamonds. */
class LeafFinder
{
public:
  LeafFinder(const RefinedSet& refined, const RefinedBrick& brick)
    : Same(refined.Diamonds().Level(brick.Scale()), brick.Origin())
    , HasFiner(brick.Scale() > 0)
  {
    if (this->HasFiner)
    {
      this->Finer.Fill(
        refined.Diamonds().Level(brick.Scale() - 1), 2 * brick.Origin() + Point{ -1, -1, -1 });
    }
  }

  /** Of a refined diamond's subdivision edges, those that are edges of the current mesh. */
  std::uint32_t AliveEdges(const Place& place, std::uint32_t edges) const
  {
    return this->HasFiner ? edges &
        ~this->Finer.Around(2 * place.Position, tables::MiddleDistances[Parity(place.Position)])
                          : edges;
  }

  /** The children of a refined diamond that are not refined, as a mask.
   *  @param wanted edge mask: children with none of these edges do not count */
  std::uint32_t LeafChildren(const Place& place, std::uint32_t wanted) const
  {
    const int type = TypeOf(place.Position);
    const std::uint32_t children =
      ChildrenOfHalves(HalvesWithAny(tables::MasksAsListed[type](wanted)));
    if (tables::Types[type].ChildStep == 0)
    {
      return children & ~this->Same.Around(place.Position, tables::ChildDistances[type]);
    }
    return this->HasFiner
      ? children & ~this->Finer.Around(2 * place.Position, tables::ChildDistances[type])
      : children;
  }

private:
  /** Children of classes 0 and 1. */
  SameScaleWindow Same;
  /** Diamonds centred on edges, and the children of class 2; scale 0 has none of these. */
  bool HasFiner;
  FinerWindow Finer;
};

/** A refined diamond whose children are not all refined: the parent of leaves. */
struct LeafParent
{
  Place At;
  std::uint32_t Rank = 0; ///< among the stored diamonds
  int Type = 0;
  HalfTetrahedronMask Leaves = 0; ///< its half-tetrahedra that are leaves

  const TypeTable& Shape() const { return tables::Types[this->Type]; }

  /** The scale of the diamonds that the leaves lie in; -1 at full resolution. */
  int LeafScale() const { return this->At.Scale - this->Shape().ChildStep; }

  /** Calls body(index of the half-tetrahedron) for every leaf. */
  template <typename Body>
  void ForEachLeaf(Body&& body) const
  {
    ForEachBit(this->Leaves, [&](int bit) { body(bit / 4); });
  }
};

/** The parent of leaves at a place, if none of its children is refined.
 *  @param wanted edge mask: leaves with none of these edges do not count */
inline LeafParent MakeLeafParent(
  const RefinedBrick& brick, const Place& place, std::uint32_t rank, std::uint32_t wanted)
{
  const int type = TypeOf(place.Position);
  const VertexMasks& masks = tables::MasksAsListed[type];
  HalfTetrahedronMask leaves = HalvesWithAny(masks(wanted));
  if (!brick.IsInner(place))
  {
    const std::uint32_t sampled = SampledVertices(brick.Hierarchy().SampleGrid(), place);
    leaves &= ~HalvesWithAny(masks(AllEdges & ~sampled));
  }
  return { place, rank, type, leaves };
}

/**
 * The same if some of its children are refined.
 *
 * @param children those that are not refined
 * @param wanted edge mask: leaves with none of these edges do not count
 */
inline LeafParent MakeLeafParent(const RefinedBrick& brick, const Place& place, std::uint32_t rank,
  std::uint32_t children, std::uint32_t wanted)
{
  LeafParent parent = MakeLeafParent(brick, place, rank, wanted);
  parent.Leaves &= HalvesOfChildren(children);
  return parent;
}

/** A leaf of the current mesh. */
struct Leaf
{
  Place Parent;           ///< the refined diamond, whose centre is the leaf's youngest vertex
  std::uint32_t Rank = 0; ///< of the parent, among the stored diamonds
  const TypeTable& Shape; ///< of the parent
  const HalfTetrahedron& Half;
  int Scale = 0; ///< scale of the diamond that the leaf lies in; -1 at full resolution
};

/**
 * Calls body(leaf) for the leaves of one brick's refined diamonds.
 *
 * @param place of a brick of refined.Diamonds()
 * @param crossed (rank) -> mask of subdivision edges: a half-tetrahedron is visited if it has one
 *        of them
 */
template <typename Crossed, typename Body>
void ForEachLeaf(const RefinedSet& refined, const BrickPlace& place, Crossed&& crossed, Body&& body)
{
  const RefinedBrick brick(refined, place);
  const LeafFinder finder(refined, brick);
  brick.ForEachDiamond(
    [&](const Place& at, std::uint32_t rank, std::uint32_t /*refinedRank*/)
    {
      const std::uint32_t wanted = crossed(rank);
      const LeafParent parent =
        MakeLeafParent(brick, at, rank, finder.LeafChildren(at, wanted), wanted);
      const TypeTable& shape = parent.Shape();
      parent.ForEachLeaf(
        [&](int half) {
          body(Leaf{ at, rank, shape, shape.HalfTetrahedra[half], parent.LeafScale() });
        });
    });
}

}

#endif
