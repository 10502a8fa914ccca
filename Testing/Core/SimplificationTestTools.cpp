// SPDX-License-Identifier: BSD-3-Clause
#include "SimplificationTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace isodiamond;

namespace test
{

std::vector<Field> SurfacesToSimplify()
{
  std::vector<Field> fields = { WaveField({ 21, 18, 13 }), SphereField({ 17, 17, 17 }),
    NoiseField({ 9, 8, 9 }, 3) };
  return fields;
}

AllowedMesh MeshOf(const Field& field, double tolerance, double allowed)
{
  BuildOptions options = Distance();
  options.PreserveTopology = true;
  const Built built = Build(Model::Minimal, field, options);
  const Mesh mesh = Extract(*built.Hierarchy, tolerance);
  AllowedMesh result;
  for (const std::array<float, 3>& point : mesh.Points)
  {
    result.Mesh.Positions.push_back({ point[0], point[1], point[2] });
    result.OnWalls.push_back(Walls::At(result.Mesh.Positions.back(), Grid(field.Dims)));
  }
  for (const std::array<std::int32_t, 3>& t : mesh.Triangles)
  {
    result.Mesh.Triangles.push_back({ static_cast<std::uint32_t>(t[0]),
      static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2]) });
    result.Allowances.push_back(allowed);
  }
  return result;
}

SurfaceTriangles TrianglesOf(const TriangleMesh& mesh)
{
  SurfaceTriangles triangles;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    triangles.push_back({ { mesh.Corner(i, 0), mesh.Corner(i, 1), mesh.Corner(i, 2) } });
  }
  return triangles;
}

std::vector<std::array<std::int32_t, 3>> IdsOf(const TriangleMesh& mesh)
{
  std::vector<std::array<std::int32_t, 3>> ids;
  for (const Triangle& t : mesh.Triangles)
  {
    ids.push_back({ static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
      static_cast<std::int32_t>(t[2]) });
  }
  return ids;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> BorderOf(const TriangleMesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++edges[{ t[k], t[(k + 1) % 3] }];
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> border;
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1) << "two triangles on one side of an edge";
    if (edges.count({ edge.second, edge.first }) == 0)
    {
      border.push_back(edge);
    }
  }
  return border;
}

bool HasTwins(const TriangleMesh& mesh)
{
  std::set<Triangle> all;
  return !std::all_of(mesh.Triangles.begin(), mesh.Triangles.end(),
    [&](Triangle triangle)
    {
      std::sort(triangle.begin(), triangle.end());
      return all.insert(triangle).second;
    });
}

void ExpectBorder(const AllowedMesh& before, const TriangleMesh& after)
{
  const auto was = BorderOf(before.Mesh);
  for (const auto& edge : BorderOf(after))
  {
    const bool isOnWall =
      !before.OnWalls.empty() && (before.OnWalls[edge.first] & before.OnWalls[edge.second]) != 0;
    EXPECT_TRUE(isOnWall || std::binary_search(was.begin(), was.end(), edge))
      << edge.first << " - " << edge.second;
  }
}

MeshPart WholePart(const AllowedMesh& mesh)
{
  MeshPart part;
  part.Positions = mesh.Mesh.Positions;
  part.Original = Connectivity(part.Positions.size(), mesh.Mesh.Triangles).Linked();
  part.Allowances = mesh.Allowances;
  part.Simple = part.Original;
  part.IsFixed.resize(part.Positions.size());
  part.OnWalls = mesh.OnWalls;
  part.OnWalls.resize(part.Positions.size());
  for (const Vector& position : part.Positions)
  {
    part.Samples.push_back({ position, mesh.Allowances.front() });
  }
  for (std::uint32_t i = 0; i < mesh.Mesh.Triangles.size(); ++i)
  {
    part.Samples.push_back({ mesh.Mesh.Middle(i), mesh.Allowances[i], i });
  }
  part.Near = NearLists(mesh.Mesh.Triangles.size());
  return part;
}

std::vector<Triangle> TrianglesLeft(
  const LinkedTriangles& mesh, std::vector<std::uint32_t>* numbers)
{
  std::vector<Triangle> left;
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    if (mesh.IsThere(i))
    {
      left.push_back(mesh.Triangles[i]);
      if (numbers != nullptr)
      {
        numbers->push_back(i);
      }
    }
  }
  return left;
}

void ExpectLinks(const LinkedTriangles& mesh)
{
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (int k = 0; k < 3 && mesh.IsThere(i); ++k)
    {
      const std::uint32_t beyond = mesh.Neighbours[i][k];
      if (beyond != None)
      {
        const int place =
          isodiamond::PlaceOf(mesh.Triangles[beyond], mesh.Triangles[i][(k + 1) % 3]);
        ASSERT_EQ(mesh.Triangles[beyond][place], mesh.Triangles[i][(k + 1) % 3]);
        ASSERT_EQ(mesh.Triangles[beyond][(place + 1) % 3], mesh.Triangles[i][k]);
        ASSERT_EQ(mesh.Neighbours[beyond][place], i);
      }
    }
  }
}

}
