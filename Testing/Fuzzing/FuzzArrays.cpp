// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies of any arrays: either refused, or every query gives a mesh whose cells have points.
#include "EncodingBytes.h"

#include "Build/Builder.h"
#include "Mesh/DiamondMesh.h"
#include "Mesh/IntervalExtraction.h"
#include "Mesh/SurfaceExtraction.h"
#include "Refinement/ScalarQuery.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

using namespace isodiamond;

namespace
{

/** No tolerance may take long: what is refined is in the arrays, and these are short. */
constexpr std::int64_t MostPoints = 10'000'000;

void Check(bool condition)
{
  if (!condition)
  {
    std::abort();
  }
}

template <typename Cells>
void CheckIds(const Cells& connectivity, std::int64_t points)
{
  Check(std::all_of(connectivity.begin(), connectivity.end(),
    [&](std::int32_t id) { return id >= 0 && id < points; }));
}

void Extract(const IsodiamondHierarchy& hierarchy, const Query& query)
{
  const RefinedSet refined(hierarchy, query, SerialFor);
  if (hierarchy.Region().IsVolume())
  {
    const IntervalExtraction extraction(refined, SerialFor);
    Check(extraction.PointCount() <= MostPoints);
    std::vector<float> points(3 * extraction.PointCount());
    std::vector<float> values(extraction.PointCount());
    std::vector<std::int8_t> surfaces(extraction.PointCount());
    std::vector<std::int32_t> connectivity(4 * extraction.TetrahedronCount());
    std::vector<std::int16_t> levels(extraction.TetrahedronCount());
    extraction.WritePoints(AffineMap(), points.data());
    extraction.WriteValues(values.data(), surfaces.data());
    extraction.WriteTetrahedra(false, connectivity.data(), levels.data());
    CheckIds(connectivity, extraction.PointCount());
  }
  else
  {
    const SurfaceExtraction extraction(refined, SerialFor);
    Check(extraction.PointCount() <= MostPoints);
    std::vector<float> points(3 * extraction.PointCount());
    std::vector<std::int32_t> connectivity(3 * extraction.TriangleCount());
    std::vector<std::int16_t> levels(extraction.TriangleCount());
    extraction.WritePoints(AffineMap(), points.data());
    extraction.WriteTriangles(false, connectivity.data(), levels.data());
    CheckIds(connectivity, extraction.PointCount());
  }
  ExtractDiamondMesh(refined);
}

Query RegionQuery(const fuzz::Arrays& arrays, const Grid& grid)
{
  const std::array<double, 6>& b = arrays.Region;
  Query query{ 0.0, arrays.InteriorTolerance };
  query.Region.emplace(Box{ { b[0], b[1], b[2] }, { b[3], b[4], b[5] } }, grid, AffineMap());
  query.OutsideTolerance = arrays.Tolerance;
  return query;
}

void QueryIsodiamonds(const fuzz::Arrays& arrays)
{
  const IsodiamondHierarchy hierarchy(arrays.Isodiamonds, SerialFor);
  Extract(hierarchy, Query{});
  Extract(hierarchy, Query{ arrays.Tolerance, arrays.InteriorTolerance });
  Query seen;
  seen.View.emplace(Vector{ arrays.Region[0], arrays.Region[1], arrays.Region[2] },
    std::abs(arrays.Tolerance), AffineMap());
  Extract(hierarchy, seen);
  Extract(hierarchy, RegionQuery(arrays, hierarchy.SampleGrid()));
}

void QueryScalars(const fuzz::Arrays& arrays)
{
  const EncodingHeader& header = arrays.Isodiamonds.Header;
  AnySamples samples = ViewOf(arrays.Samples);
  Check(SizeOf(samples) < 1'000'000);
  std::visit(
    [&](auto& view)
    {
      using View = std::decay_t<decltype(view)>;
      const View shaped(view.Pointer(), header.Dimensions);
      // Whoever reads an array has to compare its size with the dimensions.
      const bool fits = std::all_of(
        header.Dimensions.begin(), header.Dimensions.end(), [](int size) { return size > 0; });
      if (!fits || shaped.Size() != view.Size())
      {
        throw std::invalid_argument("dimensions");
      }
      view = shaped;
    },
    samples);
  const ScalarHierarchy hierarchy(samples, header.ErrorScale, arrays.Errors.data(),
    static_cast<std::int64_t>(arrays.Errors.size()), ViewOf(arrays.Minima), ViewOf(arrays.Maxima));
  for (const Query& query : { Query{}, Query{ arrays.Tolerance, arrays.InteriorTolerance },
         RegionQuery(arrays, hierarchy.SampleGrid()) })
  {
    Encoded answer =
      EncodeQuery(hierarchy, header.Region, query, header.ExactIsovertices, SerialFor);
    Extract(
      IsodiamondHierarchy(answer.Encoding, std::move(answer.Diamonds), std::move(answer.Edges)),
      Query{});
  }
  BuildIsodiamonds(Model::Minimal, hierarchy, header.Region, SerialFor);
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  try
  {
    const fuzz::Arrays arrays = fuzz::Read(data, size);
    const std::array<int, 3>& dimensions = arrays.Isodiamonds.Header.Dimensions;
    if (*std::max_element(dimensions.begin(), dimensions.end()) > 1000)
    {
      return 0; // takes long, with nothing to find; TestEncoding tests the limits
    }
    if (arrays.Isodiamonds.Header.TheModel == Model::HierarchyOfDiamonds)
    {
      QueryScalars(arrays);
    }
    else
    {
      QueryIsodiamonds(arrays);
    }
  }
  catch (const std::logic_error&) // refused
  {
  }
  return 0;
}
