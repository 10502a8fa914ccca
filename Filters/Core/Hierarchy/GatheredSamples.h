// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_GatheredSamples_h
#define isodiamond_GatheredSamples_h

#include "Field/Peers.h"
#include "Field/Samples.h"
#include "Hierarchy/IsovertexPlacement.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** Samples that are wanted together but lie in several slabs of a volume, gathered from these. */
class GatheredSamples
{
public:
  /** @param dimensions of the volume @param indices of the samples in it, in any order */
  GatheredSamples(const std::array<int, 3>& dimensions, std::vector<std::int64_t> indices);

  void Add(const SampleSlab& slab);
  /** Adds what peers have added. */
  void Merge(Peers& peers) { peers.Or(this->Values); }

  /** A sample that was wanted, once its slab has been added. */
  double operator()(const Point& point) const;

private:
  std::array<int, 3> Dimensions;
  std::vector<std::int64_t> Indices; ///< ascending
  std::vector<double> Values;
};

/** The samples along an edge as IsovertexPlacement.h needs them: values only at the edge's ends and
 *  at those of the steps that cross a surface, and signs everywhere. */
class GatheredEdge : public EdgeSigns
{
public:
  /** @param values may be null where only signs are asked for */
  GatheredEdge(const GatheredSamples* values, const EdgeSigns& signs, int steps)
    : EdgeSigns(signs)
    , Values(values)
    , Count(steps)
  {
  }

  int Steps() const { return this->Count; }
  double operator()(int i) const { return (*this->Values)(this->At(i)); }

private:
  const GatheredSamples* Values;
  int Count;
};

/** Calls body(point) for the points whose samples the placement of isovertices needs. */
template <typename Body>
void ForEachNeeded(const GatheredEdge& edge, const Body& body)
{
  body(edge.At(0));
  body(edge.At(edge.Steps()));
  for (int i = 0; i < edge.Steps(); ++i)
  {
    if (edge.Sign(i) != edge.Sign(i + 1))
    {
      body(edge.At(i));
      body(edge.At(i + 1));
    }
  }
}

}

#endif
