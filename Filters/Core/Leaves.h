// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Leaves_h
#define isodiamond_Leaves_h

#include "HalfWords.h"
#include "RefinedSet.h"

#include <array>

/**
 * @file Leaves.h
 * The current mesh of a refined set.
 *
 * Its tetrahedra, the *leaves*, are the half-tetrahedra of refined diamonds whose child is not
 * refined and whose vertices all have samples. Its edges are the subdivision edges of refined
 * diamonds at whose midpoints no refined diamond is centred.
 */
namespace isodiamond
{

/** The diamonds of one scale in 27 bricks, at hand without a search. */
class MaskWindow
{
public:
  /** @param origin of the middle brick */
  MaskWindow(const BrickLevel& level, const Point& origin)
    : First(origin + Point{ -8, -8, -8 })
  {
    static constexpr BrickMask none{};
    const Point first = BrickOf(this->First);
    for (int i = 0; i < 27; ++i)
    {
      const Brick* brick = level.Find(level.Box.Index(first + Point{ i % 3, i / 3 % 3, i / 9 }));
      this->Masks[i] = brick != nullptr ? &brick->Occupancy : &none;
      this->Empty = this->Empty && brick == nullptr;
    }
  }

  bool IsEmpty() const { return this->Empty; }

  /** @param position in one of the 27 bricks */
  bool Contains(const Point& position) const
  {
    const int x = (position[0] - this->First[0]) >> 3;
    const int y = (position[1] - this->First[1]) >> 3;
    const int z = (position[2] - this->First[2]) >> 3;
    const std::uint64_t word = (*this->Masks[x + 3 * y + 9 * z])[position[2] & 7];
    return ((word >> BitOf(position)) & 1U) != 0;
  }

private:
  Point First; ///< the first position of the first brick
  std::array<const BrickMask*, 27> Masks{};
  bool Empty = true;
};

/** Tells what belongs to the current mesh of the diamonds of one brick. */
class LeafFinder
{
public:
  /** Whatever is centred on the diamonds' edges, or is a child of theirs, lies in a window of their
   *  own scale, or in one of the next finer scale around the doubled origin. */
  LeafFinder(const RefinedSet& refined, const RefinedBrick& brick)
    : Same(refined.Diamonds().Level(brick.Scale()), brick.Origin())
    , Finer(refined.Diamonds().Level(std::max(brick.Scale() - 1, 0)), 2 * brick.Origin())
    , HasFiner(brick.Scale() > 0 && !this->Finer.IsEmpty())
  {
  }

  /** Of a refined diamond's subdivision edges, those that are edges of the current mesh. */
  std::uint32_t AliveEdges(const Place& place, std::uint32_t edges) const
  {
    if (!this->HasFiner)
    {
      return edges;
    }
    const ParityTable& shape = tables::Parities[Parity(place.Position)];
    std::uint32_t alive = edges;
    ForEachBit(edges,
      [&](int edge)
      {
        const Point middle = 2 * place.Position + shape.Offsets[edge];
        alive ^= static_cast<std::uint32_t>(this->Finer.Contains(middle)) << edge;
      });
    return alive;
  }

  /** The children of a refined diamond that are not refined, as a mask.
   *  @param wanted edge mask: children with none of these edges do not count */
  std::uint32_t LeafChildren(const Place& place, std::uint32_t wanted) const
  {
    const int type = TypeOf(place.Position);
    const TypeTable& shape = tables::Types[type];
    const bool isFiner = shape.ChildStep != 0;
    std::uint32_t leaves = ChildrenOfHalves(HalvesWithAny(tables::WordsAsListed[type](wanted)));
    if (isFiner && !this->HasFiner)
    {
      return leaves;
    }
    const MaskWindow& window = isFiner ? this->Finer : this->Same;
    ForEachBit(leaves,
      [&](int child)
      {
        const Point position = ChildPlace(shape, place, child).Position;
        leaves ^= static_cast<std::uint32_t>(window.Contains(position)) << child;
      });
    return leaves;
  }

private:
  MaskWindow Same;
  MaskWindow Finer;
  bool HasFiner;
};

/** A refined diamond whose children are not all refined: the parent of leaves. */
struct LeafParent
{
  Place At;
  std::uint32_t Rank = 0; ///< among the stored diamonds
  int Type = 0;
  HalfWord Leaves = 0; ///< its half-tetrahedra that are leaves

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

/**
 * The parent of leaves at a place.
 *
 * @param children that are not refined
 * @param wanted edge mask: leaves with none of these edges do not count
 */
inline LeafParent MakeLeafParent(const RefinedBrick& brick, const Place& place, std::uint32_t rank,
  std::uint32_t children, std::uint32_t wanted)
{
  const int type = TypeOf(place.Position);
  const VertexWords& words = tables::WordsAsListed[type];
  const std::uint32_t unsampled = AllEdges & ~brick.Sampled(place, tables::Types[type]);
  return { place, rank, type,
    HalvesOfChildren(children) & HalvesWithAny(words(wanted)) & ~HalvesWithAny(words(unsampled)) };
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
 * @param crossed(rank) mask of the subdivision edges that make a half-tetrahedron wanted: it is
 *        visited if it has one of them
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
