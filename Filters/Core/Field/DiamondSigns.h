// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondSigns_h
#define isodiamond_DiamondSigns_h

#include "Field/Isoregion.h"
#include "Lattice/DiamondSet.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** The kind of an isodiamond (paper, sections 4 and 7). */
enum class Kind : int
{
  Active = 0,   ///< a surface passes between its vertices, or all lie in the interval volume
  Creation = 1, ///< its vertices are on one side, its centre on the other
  Relevant = 2  ///< neither, but it leads to such diamonds
};

/**
 * The signs of a diamond's vertices, as edge masks, and of its centre; from them follow the crossed
 * edges and the kind. Vertices without a sample, beyond the grid, are on no side.
 *
 * Where the kinds of many diamonds are wanted at once, Classification.h finds them by words.
 */
class DiamondSigns
{
public:
  /** @param centreSign -1 if the centre has no sample
   *  @param above by surface, the sampled vertices that lie above */
  DiamondSigns(const Isoregion& region, int centreSign, std::uint32_t sampled,
    const std::array<std::uint32_t, 2>& above)
    : Surfaces(region.SurfaceCount())
    , CentreSign(centreSign)
    , Sampled(sampled)
    , Above(above)
  {
  }

  /** Reads the signs from the samples. */
  DiamondSigns(
    const Isoregion& region, const Grid& grid, const AnySamples& samples, const Place& place)
    : DiamondSigns(Read(region,
        grid.IsSampled(Centre(place)) ? region.SignOf(SampleAt(samples, Centre(place))) : -1,
        SampledVertices(grid, place),
        [&](int vertex)
        {
          const Point& offset = tables::Parities[Parity(place.Position)].Offsets[vertex];
          return region.SignOf(SampleAt(samples, VertexAt(place, offset)));
        }))
  {
  }

  /** @param signOf called with each sampled vertex */
  template <typename SignOf>
  static DiamondSigns Read(
    const Isoregion& region, int centreSign, std::uint32_t sampled, const SignOf& signOf)
  {
    std::array<std::uint32_t, 2> above{};
    ForEachBit(sampled,
      [&](int vertex)
      {
        const int sign = signOf(vertex);
        above[0] |= (sign > 0 ? 1U : 0U) << vertex;
        above[1] |= (sign > 1 ? 1U : 0U) << vertex;
      });
    return { region, centreSign, sampled, above };
  }

  /** The same where all vertices have samples, which is nearly everywhere: without a branch for
   * each.
   *  @param signOf called with all numbers below MaximumVertices; it may return any sign for those
   *         beyond the last vertex */
  template <typename SignOf>
  static DiamondSigns ReadAll(
    const Isoregion& region, int centreSign, std::uint32_t sampled, const SignOf& signOf)
  {
    std::array<std::uint32_t, 2> above{};
    for (int vertex = 0; vertex < MaximumVertices; ++vertex)
    {
      const int sign = signOf(vertex);
      above[0] |= (sign > 0 ? 1U : 0U) << vertex;
      above[1] |= (sign > 1 ? 1U : 0U) << vertex;
    }
    return { region, centreSign, sampled, { above[0] & sampled, above[1] & sampled } };
  }

  /** The subdivision edges that cross a surface. */
  std::uint32_t CrossedEdges(int surface) const
  {
    const std::uint32_t above = this->Above[surface];
    const std::uint32_t other = this->CentreSign > surface ? this->Sampled & ~above : above;
    return this->CentreSign < 0 ? 0 : other;
  }

  /** Whether there are sampled vertices, and all lie in the interval volume. */
  bool HasAllVerticesInside() const
  {
    return this->Surfaces == 2 && this->Sampled != 0 && this->Above[0] == this->Sampled &&
      this->Above[1] == 0;
  }

  Kind KindOfDiamond() const
  {
    bool isActive = this->HasAllVerticesInside();
    std::uint32_t crossed = 0;
    for (int surface = 0; surface < this->Surfaces; ++surface)
    {
      const std::uint32_t above = this->Above[surface];
      isActive = isActive || (above != 0 && above != this->Sampled);
      crossed |= this->CrossedEdges(surface);
    }
    return isActive ? Kind::Active : (crossed != 0 ? Kind::Creation : Kind::Relevant);
  }

private:
  int Surfaces;
  int CentreSign;
  std::uint32_t Sampled;
  std::array<std::uint32_t, 2> Above; ///< by surface
};

/** The same as DiamondSigns::HasAllVerticesInside(), but stops at the first vertex not inside.
 *  @param signOf called with lattice points that have a sample */
template <typename SignOf>
bool HasAllVerticesInside(
  const Isoregion& region, const Grid& grid, const Place& place, const SignOf& signOf)
{
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  bool any = false;
  bool all = region.IsVolume();
  for (int i = 0; i < shape.VertexCount && all; ++i)
  {
    const Point vertex = VertexAt(place, shape.Offsets[i]);
    if (grid.IsSampled(vertex))
    {
      any = true;
      all = signOf(vertex) == InsideSign;
    }
  }
  return any && all;
}

/** The same, by samples. */
inline bool HasAllVerticesInside(
  const Isoregion& region, const Grid& grid, const AnySamples& samples, const Place& place)
{
  return HasAllVerticesInside(region, grid, place,
    [&](const Point& vertex) { return region.SignOf(SampleAt(samples, vertex)); });
}

}

#endif
