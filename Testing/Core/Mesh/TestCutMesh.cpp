// SPDX-License-Identifier: BSD-3-Clause
// The leaves of an interval volume before they are cut, against the reference's lattice, the
// samples, and the volume's mesh.
#include "Tools/IntervalTestTools.h"

#include "Mesh/IntervalExtraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace isodiamond;

namespace
{

using Place3 = std::array<double, 3>;

Place3 InIndexSpace(const Point& point)
{
  return { 1.0 * point[0], 1.0 * point[1], 1.0 * point[2] };
}

/** The leaves of a query, and what they are compared with. */
struct Leaves
{
  test::Built Built;
  Query Asked;
  test::Volume Volume;
  CutMesh Mesh;

  Leaves(const test::Field& field, const std::array<double, 2>& range, double tolerance,
    const BuildOptions& options = {})
    : Built(
        BuildIsodiamonds(Model::Minimal, field.View(), { range[0], range[1] }, SerialFor, options),
        SerialFor)
  {
    this->Asked.Tolerance = tolerance;
    this->Volume = test::ExtractVolume(*this->Built.Hierarchy, this->Asked);
    this->Mesh = this->Read(options.Hidden);
  }

  CutMesh Read(const HiddenCells* hidden) const
  {
    const RefinedSet refined(*this->Built.Hierarchy, this->Asked, SerialFor);
    return IntervalExtraction(refined, SerialFor).Leaves(hidden);
  }

  const CutMesh::Vertex& Corner(const CutMesh::Tetrahedron& leaf, int i) const
  {
    return this->Mesh.Vertices[leaf.Vertices[i]];
  }
};

/** Fields of several sizes, with a range for each. */
std::vector<std::pair<test::Field, std::array<double, 2>>> Cases()
{
  return { { test::NoiseField({ 6, 7, 5 }, 2), { 2.5, 5.5 } },
    { test::NoiseField({ 5, 5, 5 }, 3), { 3.5, HUGE_VAL } },
    { test::SphereField({ 9, 9, 9 }), { 0.5, 2.0 } },
    { test::WaveField({ 12, 5, 17 }), { -HUGE_VAL, 0.3 } } };
}

/** Hides one cell in eight, at random. */
std::vector<std::uint8_t> SomeHidden(const std::array<int, 3>& cells, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::uint8_t> hidden(std::size_t{ 1 } * cells[0] * cells[1] * cells[2]);
  std::generate(hidden.begin(), hidden.end(), [&]() { return random() % 8 == 0 ? 1 : 0; });
  return hidden;
}

/** Checks that an edge has isovertices where its ends' signs say so, and that they lie on it. */
void CheckCut(const Leaves& leaves, const CutMesh::Tetrahedron& leaf, int younger, int older)
{
  const CutMesh::Vertex& a = leaves.Corner(leaf, younger);
  const CutMesh::Vertex& b = leaves.Corner(leaf, older);
  for (int surface = 0; surface < 2; ++surface)
  {
    const std::uint32_t point = leaf.Cuts[CutEdge(younger, older)][surface];
    const bool isCut = (a.Sign <= surface) != (b.Sign <= surface);
    ASSERT_EQ(point != CutMesh::None, isCut);
    if (!isCut)
    {
      continue;
    }
    ASSERT_LT(point, leaves.Volume.Points.size());
    EXPECT_EQ(leaves.Volume.Surfaces[point], surface == 0 ? -1 : 1);
    const Place3& at = leaves.Volume.Points[point];
    const auto distance = [&](const Point& end)
    { return std::hypot(at[0] - end[0], at[1] - end[1], at[2] - end[2]); };
    const Point way = b.Position + -1 * a.Position;
    EXPECT_NEAR(
      distance(a.Position) + distance(b.Position), std::hypot(way[0], way[1], way[2]), 1e-5);
  }
}

}

TEST(CutMesh, HasTheReferencesTetrahedra)
{
  for (const auto& [field, range] : Cases())
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const Grid grid(field.Dims);
    for (const double tolerance : { 0.0, 0.4, 3.0 })
    {
      const Leaves leaves(field, range, tolerance);
      ASSERT_FALSE(leaves.Mesh.Tetrahedra.empty());
      for (std::size_t i = 0; i < leaves.Mesh.Tetrahedra.size(); ++i)
      {
        const CutMesh::Tetrahedron& leaf = leaves.Mesh.Tetrahedra[i];
        reference::Tetrahedron tetrahedron{};
        for (int j = 0; j < 4; ++j)
        {
          tetrahedron.Vertices[j] = leaves.Corner(leaf, j).Position;
        }
        const auto& v = tetrahedron.Vertices;
        const int diamond = hierarchy.DiamondOf(tetrahedron);
        const auto found = DiamondOf(leaves.Mesh, i, grid);
        ASSERT_EQ(found.has_value(), diamond >= 0);
        if (found)
        {
          EXPECT_EQ(Centre(*found), hierarchy.At(diamond).Center);
          EXPECT_EQ(found->Scale, test::PlaceOf(grid, hierarchy.At(diamond).Center).Scale);
          EXPECT_EQ(found->Position, test::PlaceOf(grid, hierarchy.At(diamond).Center).Position);
        }
        EXPECT_EQ(
          leaf.Level, diamond >= 0 ? hierarchy.At(diamond).Level() : hierarchy.BaseExponent());
        for (int j = 0; j < 3; ++j)
        {
          EXPECT_GE(hierarchy.Age(v[j]), hierarchy.Age(v[j + 1]));
        }
        EXPECT_EQ(leaf.IsOdd,
          tables::Determinant(v[1] + -1 * v[0], v[2] + -1 * v[0], v[3] + -1 * v[0]) < 0);
      }
    }
  }
}

TEST(CutMesh, HasTheVolumesPoints)
{
  for (const auto& [field, range] : Cases())
  {
    SCOPED_TRACE(field.Name);
    for (const double tolerance : { 0.0, 0.4, 3.0 })
    {
      const Leaves leaves(field, range, tolerance);
      std::set<Point> positions;
      for (const CutMesh::Vertex& vertex : leaves.Mesh.Vertices)
      {
        EXPECT_TRUE(positions.insert(vertex.Position).second) << "twice";
        EXPECT_FALSE(vertex.IsFixed);
        ASSERT_EQ(vertex.PointId != CutMesh::None, vertex.Sign == 1);
        if (vertex.Sign == 1)
        {
          EXPECT_EQ(leaves.Volume.Points[vertex.PointId], InIndexSpace(vertex.Position));
          EXPECT_EQ(leaves.Volume.Surfaces[vertex.PointId], 0);
        }
      }
      double inside = 0.0; // six times the volume of whole leaves
      for (const CutMesh::Tetrahedron& leaf : leaves.Mesh.Tetrahedra)
      {
        std::array<Point, 4> v{};
        bool isWhole = true;
        for (int i = 0; i < 4; ++i)
        {
          v[i] = leaves.Corner(leaf, i).Position;
          isWhole = isWhole && leaves.Corner(leaf, i).Sign == 1;
          for (int j = i + 1; j < 4; ++j)
          {
            CheckCut(leaves, leaf, i, j);
          }
        }
        inside += isWhole
          ? std::abs(tables::Determinant(v[1] + -1 * v[0], v[2] + -1 * v[0], v[3] + -1 * v[0]))
          : 0.0;
      }
      double expected = 0.0;
      for (const std::array<std::int32_t, 4>& tetrahedron : leaves.Volume.Tetrahedra)
      {
        const bool isWhole = std::all_of(tetrahedron.begin(), tetrahedron.end(),
          [&](std::int32_t point) { return leaves.Volume.Surfaces[point] == 0; });
        expected += isWhole ? test::Determinant(leaves.Volume, tetrahedron) : 0.0;
      }
      EXPECT_NEAR(inside, expected, 1e-9);
    }
  }
}

TEST(CutMesh, HasTheSidesOfTheSamples)
{
  for (const auto& [field, range] : Cases())
  {
    const Leaves leaves(field, range, 0.0);
    for (const CutMesh::Vertex& vertex : leaves.Mesh.Vertices)
    {
      const Point& at = vertex.Position;
      if (Grid(field.Dims).IsSampled(at))
      {
        const double value =
          field.Samples[(std::size_t{ 1 } * at[2] * field.Dims[1] + at[1]) * field.Dims[0] + at[0]];
        EXPECT_EQ(vertex.Sign, value < range[0] ? 0 : value > range[1] ? 2 : 1);
      }
    }
  }
}

TEST(CutMesh, IsInTheWorldWhatItIsInIndexSpace)
{
  const auto [field, range] = Cases()[0];
  const Leaves leaves(field, range, 0.0);
  AffineMap world;
  world.Rows = { { { 2.0, 0.5, 0.0, 7.0 }, { 0.0, -1.0, 0.25, 3.0 }, { 1.0, 0.0, 4.0, -5.0 } } };
  const std::vector<Vector> found = VerticesInWorld(leaves.Mesh, world);
  ASSERT_EQ(found.size(), leaves.Mesh.Vertices.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const Place3 at = InIndexSpace(leaves.Mesh.Vertices[i].Position);
    for (int row = 0; row < 3; ++row)
    {
      const auto& r = world.Rows[row];
      EXPECT_NEAR(found[i][row], r[0] * at[0] + r[1] * at[1] + r[2] * at[2] + r[3], 1e-12);
    }
  }
}

TEST(CutMesh, LeavesOutHiddenCellsAndTellsTheirCorners)
{
  for (const auto& [field, range] : Cases())
  {
    SCOPED_TRACE(field.Name);
    const std::array<int, 3> cells = { field.Dims[0] - 1, field.Dims[1] - 1, field.Dims[2] - 1 };
    const std::vector<std::uint8_t> isHidden = SomeHidden(cells, 5);
    const HiddenCells hidden(isHidden, cells);
    BuildOptions options;
    options.Hidden = &hidden;
    const Leaves leaves(field, range, 3.0, options);
    const auto is = [&](const Point& cell)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        if (cell[axis] < 0 || cell[axis] >= cells[axis])
        {
          return false;
        }
      }
      return isHidden[(std::size_t{ 1 } * cell[2] * cells[1] + cell[1]) * cells[0] + cell[0]] != 0;
    };
    for (const CutMesh::Vertex& vertex : leaves.Mesh.Vertices)
    {
      bool isCorner = false;
      for (int i = 0; i < 8; ++i)
      {
        isCorner = isCorner ||
          is({ vertex.Position[0] - i % 2, vertex.Position[1] - i / 2 % 2,
            vertex.Position[2] - i / 4 });
      }
      EXPECT_EQ(vertex.IsFixed, isCorner);
    }
    // The cell of a leaf is that of its middle.
    const auto isInHidden = [&](const CutMesh& mesh, const CutMesh::Tetrahedron& leaf)
    {
      Point sum{};
      for (const std::uint32_t vertex : leaf.Vertices)
      {
        sum = sum + mesh.Vertices[vertex].Position;
      }
      return is({ sum[0] / 4, sum[1] / 4, sum[2] / 4 });
    };
    const CutMesh all = leaves.Read(nullptr);
    std::size_t left = 0;
    for (const CutMesh::Tetrahedron& leaf : all.Tetrahedra)
    {
      left += isInHidden(all, leaf) ? 0 : 1;
    }
    EXPECT_EQ(leaves.Mesh.Tetrahedra.size(), left);
    EXPECT_LT(left, all.Tetrahedra.size());
    for (const CutMesh::Tetrahedron& leaf : leaves.Mesh.Tetrahedra)
    {
      EXPECT_FALSE(isInHidden(leaves.Mesh, leaf));
    }
  }
}
