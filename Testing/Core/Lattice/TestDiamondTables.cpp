// SPDX-License-Identifier: BSD-3-Clause
// The tables against the rules of the lattice and against explicit bisection of tetrahedra.
#include "Lattice/DiamondTetrahedra.h"
#include "Tools/CoreTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace isodiamond;

namespace
{

/** The parents and children of a diamond, from the tables. */
struct Relations
{
  std::vector<Point> Parents;
  std::vector<Point> Children;
};

Relations RelationsOf(const Grid& grid, const Place& place)
{
  const TypeTable& shape = ShapeOf(place.Position);
  Relations relations;
  for (int i = 0; i < shape.ParentCount; ++i)
  {
    const Place parent = ParentPlace(shape, place, i);
    if (parent.Scale < grid.Depth() && grid.IsValid(parent.Position, parent.Scale))
    {
      relations.Parents.push_back(Centre(parent));
    }
  }
  for (int i = 0; i < shape.ChildCount; ++i)
  {
    const Place child = ChildPlace(shape, place, i);
    if (child.Scale >= 0 && grid.IsValid(child.Position, child.Scale))
    {
      relations.Children.push_back(Centre(child));
    }
  }
  std::sort(relations.Parents.begin(), relations.Parents.end());
  std::sort(relations.Children.begin(), relations.Children.end());
  return relations;
}

std::vector<Point> CentresOf(const reference::Hierarchy& hierarchy, const std::vector<int>& indices)
{
  std::vector<Point> centres;
  for (const int index : indices)
  {
    centres.push_back(hierarchy.At(index).Center);
  }
  std::sort(centres.begin(), centres.end());
  return centres;
}

const std::vector<std::array<int, 3>> Lattices = { { 2, 2, 2 }, { 3, 3, 3 }, { 9, 9, 9 },
  { 17, 17, 17 }, { 5, 4, 7 }, { 10, 6, 13 }, { 6, 4, 5 }, { 6, 8, 4 }, { 2, 4, 8 }, { 14, 4, 6 },
  { 2, 17, 3 } };

}

TEST(DiamondTables, HaveFiftySixTypesOfThreeClasses)
{
  std::array<int, 3> counts{};
  for (const TypeTable& shape : tables::Types)
  {
    if (shape.Valid)
    {
      ++counts[shape.DiamondClass];
      constexpr std::array<std::array<int, 4>, 3> expected = { { { 8, 12, 6, 3 }, { 6, 8, 4, 2 },
        { 10, 16, 8, 4 } } }; // vertices, half-tetrahedra, children, parents
      EXPECT_EQ(shape.VertexCount, expected[shape.DiamondClass][0]);
      EXPECT_EQ(shape.HalfTetrahedronCount, expected[shape.DiamondClass][1]);
      EXPECT_EQ(shape.ChildCount, expected[shape.DiamondClass][2]);
      EXPECT_EQ(shape.ParentCount, expected[shape.DiamondClass][3]);
    }
  }
  EXPECT_EQ(counts[0] + counts[1] + counts[2], 56);
}

TEST(DiamondTables, HalfTetrahedraArePositiveAndFillTheDiamond)
{
  for (const TypeTable& shape : tables::Types)
  {
    int volume = 0; // six times, in h^3
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      const HalfTetrahedron& half = shape.HalfTetrahedra[i];
      const int six = tables::Determinant(shape.Offsets[half.Vertices[0]],
        shape.Offsets[half.Vertices[1]], shape.Offsets[half.Vertices[2]]);
      EXPECT_GT(six, 0);
      volume += six;
    }
    // A cube of side 2h; two pyramids of height h over a square of side 2h.
    EXPECT_EQ(volume, shape.Valid ? (shape.DiamondClass == 0 ? 48 : 16) : 0);
  }
}

TEST(DiamondTables, AgreeWithBisectedTetrahedra)
{
  for (const std::array<int, 3>& dims : Lattices)
  {
    const Grid grid(dims);
    const reference::Hierarchy hierarchy(dims);
    ASSERT_EQ(grid.Depth(), hierarchy.BaseExponent());
    for (const reference::Diamond& diamond : hierarchy.Diamonds())
    {
      const Place place = test::PlaceOf(grid, diamond.Center);
      const TypeTable& shape = ShapeOf(place.Position);
      ASSERT_EQ(Centre(place), diamond.Center);
      ASSERT_TRUE(grid.IsValid(place.Position, place.Scale));
      EXPECT_EQ(shape.DiamondClass, diamond.Class());
      EXPECT_EQ(grid.Depth() - 1 - place.Scale, diamond.Level());
      EXPECT_EQ(grid.SticksOut(place.Position, place.Scale), diamond.SticksOut);
      const Relations relations = RelationsOf(grid, place);
      EXPECT_EQ(relations.Parents, CentresOf(hierarchy, diamond.Parents));
      EXPECT_EQ(relations.Children, CentresOf(hierarchy, diamond.Children));
      for (const Point& end : diamond.Spine)
      {
        const Point first = Centre({ place.Scale, place.Position + shape.Offsets[shape.Spine[0]] });
        const Point second =
          Centre({ place.Scale, place.Position + shape.Offsets[shape.Spine[1]] });
        EXPECT_TRUE(end == first || end == second);
      }
    }
  }
}

TEST(DiamondTables, ValidPlacesAreTheDiamondsOfBisection)
{
  for (const std::array<int, 3>& dims : Lattices)
  {
    const Grid grid(dims);
    const reference::Hierarchy hierarchy(dims);
    int count = 0;
    for (int scale = 0; scale < grid.Depth(); ++scale)
    {
      const std::array<int, 3> positions = grid.Positions(scale);
      for (int z = 0; z < positions[2]; ++z)
      {
        for (int y = 0; y < positions[1]; ++y)
        {
          for (int x = 0; x < positions[0]; ++x)
          {
            const Place place{ scale, { x, y, z } };
            if (Parity(place.Position) != 0)
            {
              ++count;
              EXPECT_GE(hierarchy.Find(Centre(place)), 0);
            }
          }
        }
      }
    }
    EXPECT_EQ(count, hierarchy.Size());
  }
}

TEST(DiamondTables, ParentsOfChildrenAreSelf)
{
  const Grid grid({ 17, 17, 17 });
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    const std::array<int, 3> positions = grid.Positions(scale);
    for (int code = 0; code < positions[0] * positions[1] * positions[2]; ++code)
    {
      const Place place{ scale,
        { code % positions[0], code / positions[0] % positions[1],
          code / positions[0] / positions[1] } };
      if (Parity(place.Position) == 0)
      {
        continue;
      }
      for (const Point& child : RelationsOf(grid, place).Children)
      {
        const std::vector<Point> parents = RelationsOf(grid, test::PlaceOf(grid, child)).Parents;
        EXPECT_EQ(std::count(parents.begin(), parents.end(), Centre(place)), 1);
      }
      for (const Point& parent : RelationsOf(grid, place).Parents)
      {
        const std::vector<Point> children = RelationsOf(grid, test::PlaceOf(grid, parent)).Children;
        EXPECT_EQ(std::count(children.begin(), children.end(), Centre(place)), 1);
      }
    }
  }
}

TEST(DiamondTables, EveryEdgeIsOwnedAtItsYoungerEnd)
{
  // The outer edges of all half-tetrahedra, with the owners that the tables name.
  const Grid grid({ 9, 9, 9 });
  const reference::Hierarchy hierarchy({ 9, 9, 9 });
  for (const reference::Diamond& diamond : hierarchy.Diamonds())
  {
    const Place place = test::PlaceOf(grid, diamond.Center);
    const TypeTable& shape = ShapeOf(place.Position);
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      const HalfTetrahedron& half = shape.HalfTetrahedra[i];
      for (int opposite = 0; opposite < 3; ++opposite)
      {
        const auto vertex = [&](int v) {
          return Centre({ place.Scale, place.Position + shape.Offsets[v] });
        };
        const Point a = vertex(half.Vertices[(opposite + 1) % 3]);
        const Point b = vertex(half.Vertices[(opposite + 2) % 3]);
        if (!grid.IsSampled(a) || !grid.IsSampled(b))
        {
          continue;
        }
        const OuterEdge& edge = half.OuterEdges[opposite];
        const std::array<Point, 2> expected = hierarchy.YoungerFirst(a, b);
        const Point owner = vertex(edge.OwnerVertex);
        EXPECT_EQ(owner, expected[0]);
        const int scale = place.Scale + edge.OwnerStep;
        EXPECT_EQ(grid.Scale(owner), scale);
        const Point position = { owner[0] >> scale, owner[1] >> scale, owner[2] >> scale };
        const ParityTable& ownerShape = tables::Parities[Parity(position)];
        EXPECT_EQ(Centre({ scale, position + ownerShape.Offsets[edge.OwnerEdge] }), expected[1]);
      }
    }
  }
}

namespace
{

using Corners = std::array<Point, 4>;

/** Corners relative to a position of scale 0, sorted. */
Corners CornersAround(const Point& position, const HalfPlace& tetrahedron)
{
  const Place& parent = tetrahedron.Parent;
  Corners corners{ Centre(parent) };
  for (int i = 0; i < 3; ++i)
  {
    corners[i + 1] = (1 << parent.Scale) *
      (parent.Position + tetrahedron.Shape().Offsets[tetrahedron.Half->Vertices[i]]);
  }
  for (Point& corner : corners)
  {
    corner = corner + -1 * position;
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::vector<Corners> TetrahedraAround(const Point& position)
{
  std::vector<Corners> tetrahedra;
  ForEachParentHalf({ 0, position },
    [&](int number, const Place& parent, const HalfTetrahedron& half)
    {
      EXPECT_EQ(number, static_cast<int>(tetrahedra.size()));
      tetrahedra.push_back(CornersAround(position, { parent, 0, &half }));
      EXPECT_EQ(CornersAround(position, TetrahedronOf({ 0, position }, number)), tetrahedra.back());
    });
  return tetrahedra;
}

}

TEST(DiamondTables, NumbersMeanTheSameTetrahedraForAllDiamondsOfAType)
{
  // Parents of class 0 also depend on the next two bits of a position, which its type leaves out.
  for (int code = 0; code < 16 * 16 * 16; ++code)
  {
    const Point position = { 16 + code % 16, 16 + code / 16 % 16, 16 + code / 256 };
    if (ShapeOf(position).Valid)
    {
      EXPECT_EQ(TetrahedraAround(position), TetrahedraAround(PositionOfType(TypeOf(position))));
    }
  }
}

TEST(DiamondTables, AHalfIsHalfOfItsWhole)
{
  for (int type = 0; type < 64; ++type)
  {
    const Point position = PositionOfType(type);
    const TypeTable& shape = ShapeOf(position);
    ASSERT_EQ(TypeOf(position), type);
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      const HalfTetrahedron& half = shape.HalfTetrahedra[i];
      const int number = NumberOfWhole(position, half);
      const Corners whole = CornersAround(position, TetrahedronOf({ 0, position }, number));
      const auto isCorner = [&](const Point& offset)
      { return std::find(whole.begin(), whole.end(), offset) != whole.end(); };
      // The whole has the half's outer corners and the spine, whose middle is the centre.
      for (const std::uint8_t vertex : half.Vertices)
      {
        EXPECT_TRUE(isCorner(shape.Offsets[vertex]));
      }
      EXPECT_TRUE(isCorner(shape.Offsets[shape.Spine[0]]));
      EXPECT_TRUE(isCorner(shape.Offsets[shape.Spine[1]]));
    }
  }
}
