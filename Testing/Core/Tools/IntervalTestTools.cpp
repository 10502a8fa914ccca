// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/IntervalTestTools.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace test
{

Volume ExtractVolume(const isodiamond::IsodiamondHierarchy& hierarchy, double tolerance,
  double interiorTolerance, const isodiamond::ParallelFor& parallelFor)
{
  return ExtractVolume(hierarchy, isodiamond::Query{ tolerance, interiorTolerance }, parallelFor);
}

Volume ExtractVolume(const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::Query& query, const isodiamond::ParallelFor& parallelFor)
{
  const isodiamond::RefinedSet refined(hierarchy, query, parallelFor);
  const isodiamond::IntervalExtraction extraction(refined, parallelFor);
  Volume volume;
  volume.Points.resize(extraction.PointCount());
  volume.Values.resize(extraction.PointCount());
  volume.Surfaces.resize(extraction.PointCount());
  volume.Tetrahedra.resize(extraction.TetrahedronCount());
  volume.Levels.resize(extraction.TetrahedronCount());
  if (!volume.Tetrahedra.empty())
  {
    extraction.WritePoints(isodiamond::AffineMap(), volume.Points[0].data());
    extraction.WriteValues(volume.Values.data(), volume.Surfaces.data());
    extraction.WriteTetrahedra(false, volume.Tetrahedra[0].data(), volume.Levels.data());
  }
  return volume;
}

double Determinant(const Volume& volume, const std::array<std::int32_t, 4>& tetrahedron)
{
  std::array<std::array<double, 3>, 3> edges{};
  for (int i = 0; i < 3; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      edges[i][axis] =
        volume.Points[tetrahedron[i + 1]][axis] - volume.Points[tetrahedron[0]][axis];
    }
  }
  const auto& [a, b, c] = edges;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

double TotalVolume(const Volume& volume)
{
  double sum = 0.0;
  for (const std::array<std::int32_t, 4>& tetrahedron : volume.Tetrahedra)
  {
    sum += Determinant(volume, tetrahedron) / 6.0;
  }
  return sum;
}

namespace
{

using Face = std::array<std::int32_t, 3>;

/** Whether a face may have only one tetrahedron: it is on one surface, or in one plane of the
 *  boundary. */
bool IsBoundary(const Volume& volume, const Face& face, const std::array<int, 3>& dims)
{
  for (const int surface : { -1, 1 })
  {
    if (std::all_of(face.begin(), face.end(),
          [&](std::int32_t point) { return volume.Surfaces[point] == surface; }))
    {
      return true;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double plane : { 0.0, dims[axis] - 1.0 })
    {
      if (std::all_of(face.begin(), face.end(),
            [&](std::int32_t point) { return volume.Points[point][axis] == plane; }))
      {
        return true;
      }
    }
  }
  return false;
}

}

std::vector<Face> SurfaceFaces(const Volume& volume, int surface)
{
  std::vector<Face> faces;
  for (const std::array<std::int32_t, 4>& t : volume.Tetrahedra)
  {
    for (Face face : { Face{ t[1], t[2], t[3] }, Face{ t[0], t[3], t[2] }, Face{ t[0], t[1], t[3] },
           Face{ t[0], t[2], t[1] } })
    {
      if (std::all_of(face.begin(), face.end(),
            [&](std::int32_t point) { return volume.Surfaces[point] == surface; }))
      {
        std::sort(face.begin(), face.end());
        faces.push_back(face);
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Face> alone;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const bool isShared =
      (i > 0 && faces[i - 1] == faces[i]) || (i + 1 < faces.size() && faces[i + 1] == faces[i]);
    if (!isShared)
    {
      alone.push_back(faces[i]);
    }
  }
  return alone;
}

std::string FindFault(const Volume& volume, const std::array<int, 3>& dims)
{
  std::ostringstream text;
  std::vector<bool> used(volume.Points.size(), false);
  std::map<Face, int> faces; // the sum of its orientations, plus 16 for each use
  for (const std::array<std::int32_t, 4>& t : volume.Tetrahedra)
  {
    if (!(Determinant(volume, t) > 0.0))
    {
      text << "a tetrahedron of volume " << Determinant(volume, t) / 6.0;
      return text.str();
    }
    for (const Face& face : { Face{ t[1], t[2], t[3] }, Face{ t[0], t[3], t[2] },
           Face{ t[0], t[1], t[3] }, Face{ t[0], t[2], t[1] } })
    {
      Face sorted = face;
      std::sort(sorted.begin(), sorted.end());
      const bool even = (face[0] < face[1]) == (face[1] < face[2])
        ? face[0] < face[1]
        : (face[0] < face[1] ? face[2] < face[0] : face[1] < face[2] && face[2] < face[0]);
      faces[sorted] += 16 + (even ? 1 : -1);
    }
    for (const std::int32_t point : t)
    {
      used[point] = true;
    }
  }
  for (const auto& [face, uses] : faces)
  {
    const bool shared = uses == 32; // twice, from both sides
    const bool single = uses == 15 || uses == 17;
    if (!shared && !(single && IsBoundary(volume, face, dims)))
    {
      const std::array<double, 3>& p = volume.Points[face[0]];
      text << "a face of " << (uses + 1) / 16 << " tetrahedra at " << p[0] << " " << p[1] << " "
           << p[2];
      return text.str();
    }
  }
  return std::all_of(used.begin(), used.end(), [](bool is) { return is; }) ? ""
                                                                           : "a point without use";
}

std::vector<std::pair<std::array<std::array<double, 3>, 4>, int>> PlacedTetrahedra(
  const Volume& volume)
{
  std::vector<std::pair<std::array<std::array<double, 3>, 4>, int>> placed;
  for (std::size_t i = 0; i < volume.Tetrahedra.size(); ++i)
  {
    std::array<std::array<double, 3>, 4> corners{};
    for (int corner = 0; corner < 4; ++corner)
    {
      corners[corner] = volume.Points[volume.Tetrahedra[i][corner]];
    }
    std::sort(corners.begin(), corners.end());
    placed.emplace_back(corners, volume.Levels[i]);
  }
  std::sort(placed.begin(), placed.end());
  return placed;
}

std::vector<reference::Isorange> RangesOf(const Field& field)
{
  std::vector<float> sorted;
  std::copy_if(field.Samples.begin(), field.Samples.end(), std::back_inserter(sorted),
    [](float value) { return std::isfinite(value); });
  std::sort(sorted.begin(), sorted.end());
  const double low = sorted[sorted.size() / 3];
  const double high = sorted[sorted.size() * 7 / 8];
  return { { low, low < high ? high : low + 1.0 }, { 0.5, 2.5 },
    { high, std::numeric_limits<double>::infinity() },
    { -std::numeric_limits<double>::infinity(), low },
    { -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() } };
}

}
