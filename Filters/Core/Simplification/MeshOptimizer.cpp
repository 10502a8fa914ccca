// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/MeshOptimizer.h"

#ifdef ISODIAMONDS_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <algorithm>

namespace isodiamond
{

#ifdef ISODIAMONDS_HAVE_MESHOPTIMIZER

Decimation MeshOptimizer()
{
  return [](const TriangleMesh& mesh, double error)
  {
    // In floats, around a point of the mesh; errors are told in parts of its extent.
    const Vector origin = mesh.Positions.front();
    std::vector<float> positions;
    positions.reserve(3 * mesh.Positions.size());
    for (const Vector& position : mesh.Positions)
    {
      const Vector relative = position - origin;
      std::transform(relative.begin(), relative.end(), std::back_inserter(positions),
        [](double x) { return static_cast<float>(x); });
    }
    const std::size_t stride = 3 * sizeof(float);
    const float extent = meshopt_simplifyScale(positions.data(), mesh.Positions.size(), stride);
    std::vector<unsigned int> ids;
    ids.reserve(3 * mesh.Triangles.size());
    for (const Triangle& triangle : mesh.Triangles)
    {
      ids.insert(ids.end(), triangle.begin(), triangle.end());
    }
    ids.resize(
      meshopt_simplify(ids.data(), ids.data(), ids.size(), positions.data(), mesh.Positions.size(),
        stride, 0, static_cast<float>(error) / extent, meshopt_SimplifyLockBorder, nullptr));
    std::vector<Triangle> triangles(ids.size() / 3);
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      triangles[i] = { ids[3 * i], ids[3 * i + 1], ids[3 * i + 2] };
    }
    return triangles;
  };
}

#else

Decimation MeshOptimizer()
{
  return nullptr;
}

#endif

}
