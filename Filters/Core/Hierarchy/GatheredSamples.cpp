// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/GatheredSamples.h"

#include <algorithm>
#include <cassert>

namespace isodiamond
{

GatheredSamples::GatheredSamples(
  const std::array<int, 3>& dimensions, std::vector<std::int64_t> indices)
  : Dimensions(dimensions)
  , Indices(std::move(indices))
{
  std::sort(this->Indices.begin(), this->Indices.end());
  this->Indices.erase(std::unique(this->Indices.begin(), this->Indices.end()), this->Indices.end());
  this->Values.resize(this->Indices.size());
}

void GatheredSamples::Add(const SampleSlab& slab)
{
  const auto placeOf = [&](int slice)
  {
    const std::int64_t index = SampleIndex(this->Dimensions, { 0, 0, slice });
    return std::lower_bound(this->Indices.begin(), this->Indices.end(), index);
  };
  const std::int64_t before = SampleIndex(this->Dimensions, { 0, 0, slab.First });
  const auto end = placeOf(slab.End());
  std::visit(
    [&](const auto& view)
    {
      for (auto index = placeOf(slab.First); index != end; ++index)
      {
        this->Values[index - this->Indices.begin()] =
          static_cast<double>(view.Pointer()[*index - before]);
      }
    },
    slab.Samples);
}

double GatheredSamples::operator()(const Point& point) const
{
  const std::int64_t index = SampleIndex(this->Dimensions, point);
  const auto found = std::lower_bound(this->Indices.begin(), this->Indices.end(), index);
  assert(found != this->Indices.end() && *found == index && "a sample that was wanted");
  return this->Values[found - this->Indices.begin()];
}

}
