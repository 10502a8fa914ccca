// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra of what lies above an isovalue, by CGAL's Mesh_3, for tetrahedra.py.
//
//   IsodiamondCGALMesher SAMPLES NX NY NZ ISOVALUE DISTANCE SIZE OUTPUT
//
// SAMPLES is a file of floats, x fastest; OUTPUT is written in Medit's format. Prints the seconds
// of meshing and of optimizing. DISTANCE and SIZE, in voxels, are how far facets may be from the
// surface, and how large they may be; cells inside may be of any size.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/exude_mesh_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace params = CGAL::parameters;

/** In degrees: the least angle of facets, and the dihedral angle below which a cell is a sliver. */
constexpr double FacetAngle = 25.0;
constexpr double SliverBound = 12.0;

/** Samples on a grid, interpolated trilinearly between them. */
struct Field
{
  std::array<int, 3> Dims{};
  std::vector<float> Samples;

  double At(int x, int y, int z) const
  {
    return this->Samples[(static_cast<std::size_t>(z) * this->Dims[1] + y) * this->Dims[0] + x];
  }

  /** Outside the grid, less than any value. */
  double operator()(const Kernel::Point_3& point) const
  {
    std::array<int, 3> cell{};
    std::array<double, 3> part{};
    for (int axis = 0; axis < 3; ++axis)
    {
      if (point[axis] < 0.0 || point[axis] > this->Dims[axis] - 1)
      {
        return -HUGE_VAL;
      }
      cell[axis] = std::min(static_cast<int>(point[axis]), this->Dims[axis] - 2);
      part[axis] = point[axis] - cell[axis];
    }
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      std::array<int, 3> at = cell;
      for (int axis = 0; axis < 3; ++axis)
      {
        const bool isFar = ((corner >> axis) & 1) != 0;
        at[axis] += isFar ? 1 : 0;
        weight *= isFar ? part[axis] : 1.0 - part[axis];
      }
      value += weight * this->At(at[0], at[1], at[2]);
    }
    return value;
  }
};

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Run(const std::vector<std::string>& arguments)
{
  if (arguments.size() != 8)
  {
    throw std::invalid_argument("SAMPLES NX NY NZ ISOVALUE DISTANCE SIZE OUTPUT");
  }
  Field field;
  std::size_t count = 1;
  double diagonal = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    field.Dims[axis] = std::stoi(arguments[1 + axis]);
    count *= field.Dims[axis];
    diagonal += std::pow(field.Dims[axis] - 1, 2);
  }
  field.Samples.resize(count);
  std::ifstream input(arguments[0], std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(count * sizeof(float));
  if (!input.read(reinterpret_cast<char*>(field.Samples.data()), bytes))
  {
    throw std::runtime_error("cannot read " + arguments[0]);
  }
  const double isovalue = std::stod(arguments[4]);
  const double distance = std::stod(arguments[5]);
  const double size = std::stod(arguments[6]);

  const auto inside = [&](const Kernel::Point_3& point) { return isovalue - field(point); };
  const Kernel::Point_3 centre(
    0.5 * (field.Dims[0] - 1), 0.5 * (field.Dims[1] - 1), 0.5 * (field.Dims[2] - 1));
  const Domain domain = Domain::create_implicit_mesh_domain(
    inside, Kernel::Sphere_3(centre, 0.3 * diagonal), params::relative_error_bound = 1e-6);
  const Criteria criteria(params::facet_angle = FacetAngle, params::facet_size = size,
    params::facet_distance = distance, params::cell_radius_edge_ratio = 2.0);
  const auto start = std::chrono::steady_clock::now();
  Complex mesh =
    CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude());
  std::cout << SecondsSince(start) << " ";
  const auto optimizing = std::chrono::steady_clock::now();
  CGAL::perturb_mesh_3(mesh, domain, params::sliver_bound = SliverBound);
  CGAL::exude_mesh_3(mesh, params::sliver_bound = SliverBound);
  std::cout << SecondsSince(optimizing) << "\n";
  std::ofstream output(arguments[7]);
  mesh.output_to_medit(output);
}

}

int main(int argc, char** argv)
{
  try
  {
    Run({ argv + 1, argv + argc });
  }
  catch (const std::exception& error)
  {
    std::cerr << "IsodiamondCGALMesher: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
