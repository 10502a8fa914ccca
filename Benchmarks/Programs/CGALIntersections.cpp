// SPDX-License-Identifier: BSD-3-Clause
// Counts the pairs of a mesh's triangles that intersect, by CGAL's exact predicates, for
// deviation.py.
//
//   IsodiamondCGALIntersections MESH
//
// MESH is a file of 64-bit numbers: how many points and triangles, the points' coordinates
// (floating point), and three ids of points for each triangle. Pairs count that have more in common
// than corners and an edge; triangles without an area are left out.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::int64_t, 3>;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Triangle*>;

struct Mesh
{
  std::vector<Point> Points;
  std::vector<Triangle> Triangles;

  Kernel::Triangle_3 Placed(const Triangle& triangle) const
  {
    return { this->Points[triangle[0]], this->Points[triangle[1]], this->Points[triangle[2]] };
  }
};

template <typename T>
std::vector<T> Numbers(std::istream& input, std::size_t count)
{
  static_assert(sizeof(T) == 8, "the file's numbers");
  std::vector<T> numbers(count);
  if (!input.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(8 * count)))
  {
    throw std::runtime_error("cannot read the mesh");
  }
  return numbers;
}

Mesh Read(const std::string& file)
{
  std::ifstream input(file, std::ios::binary);
  const auto sizes = Numbers<std::int64_t>(input, 2);
  const auto coordinates = Numbers<double>(input, 3 * sizes[0]);
  const auto ids = Numbers<std::int64_t>(input, 3 * sizes[1]);
  Mesh mesh;
  for (std::int64_t i = 0; i < sizes[0]; ++i)
  {
    mesh.Points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
  }
  for (std::int64_t i = 0; i < sizes[1]; ++i)
  {
    mesh.Triangles.push_back({ ids[3 * i], ids[3 * i + 1], ids[3 * i + 2] });
  }
  return mesh;
}

/** The corners that two triangles share, by their numbers in each. */
std::vector<std::pair<int, int>> Shared(const Triangle& a, const Triangle& b)
{
  std::vector<std::pair<int, int>> shared;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      if (a[i] == b[j])
      {
        shared.emplace_back(i, j);
      }
    }
  }
  return shared;
}

/** Whether two triangles have more in common than the corners that they share, and their edge. */
bool Intersect(const Mesh& mesh, const Triangle& a, const Triangle& b)
{
  const auto point = [&](const Triangle& triangle, int corner) -> const Point&
  { return mesh.Points[triangle[corner % 3]]; };
  const auto shared = Shared(a, b);
  if (shared.empty())
  {
    return CGAL::do_intersect(mesh.Placed(a), mesh.Placed(b));
  }
  if (shared.size() == 1)
  {
    const auto [i, j] = shared[0];
    const Kernel::Segment_3 acrossA(point(a, i + 1), point(a, i + 2));
    const Kernel::Segment_3 acrossB(point(b, j + 1), point(b, j + 2));
    return CGAL::do_intersect(mesh.Placed(b), acrossA) ||
      CGAL::do_intersect(mesh.Placed(a), acrossB);
  }
  if (shared.size() == 2) // on one side of their edge, in one plane
  {
    const Point& p = point(a, shared[0].first);
    const Point& q = point(a, shared[1].first);
    const Point& ofA = point(a, 3 - shared[0].first - shared[1].first);
    const Point& ofB = point(b, 3 - shared[0].second - shared[1].second);
    return CGAL::coplanar(p, q, ofA, ofB) &&
      CGAL::coplanar_orientation(p, q, ofA, ofB) == CGAL::POSITIVE;
  }
  return true; // the same triangle twice
}

std::int64_t Count(const Mesh& mesh)
{
  std::vector<Box> boxes;
  for (const Triangle& triangle : mesh.Triangles)
  {
    const Kernel::Triangle_3 placed = mesh.Placed(triangle);
    if (!placed.is_degenerate())
    {
      boxes.emplace_back(placed.bbox(), &triangle);
    }
  }
  std::int64_t count = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
    [&](const Box& a, const Box& b)
    { count += Intersect(mesh, *a.handle(), *b.handle()) ? 1 : 0; });
  return count;
}

}

int main(int argc, char** argv)
{
  try
  {
    if (argc != 2)
    {
      throw std::invalid_argument("MESH");
    }
    std::cout << Count(Read(argv[1])) << "\n";
  }
  catch (const std::exception& error)
  {
    std::cerr << "IsodiamondCGALIntersections: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
