// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IntervalExtraction_h
#define isodiamond_IntervalExtraction_h

#include "AffineMap.h"
#include "ExtractionPasses.h"

#include <vector>

namespace isodiamond
{

/**
 * The interval volume of a refined set, as tetrahedra: the patches of IntervalPatches.h over the
 * leaves of the current mesh.
 *
 * Points are the centres of refined diamonds that lie inside, and the alive isovertices of refined
 * diamonds, each belonging to one diamond; their ids are a prefix sum, as for surfaces (see
 * SurfaceExtraction.h). All tetrahedra have positive volume in index space and share whole faces.
 * Order and values of the output do not depend on threads. Paper, section 6.
 */
class IntervalExtraction
{
public:
  /** The refined set must outlive the extraction. @throws std::length_error beyond 2^32 - 1
   *  points. */
  IntervalExtraction(const RefinedSet& refined, const ParallelFor& parallelFor);

  std::int64_t PointCount() const { return this->Passes.Total().Points; }
  std::int64_t TetrahedronCount() const { return this->Passes.Total().Cells; }

  /** Writes 3 coordinates a point; float or double. */
  template <typename Coordinate>
  void WritePoints(const AffineMap& world, Coordinate* points) const;

  /**
   * Writes what is known of the points.
   *
   * @param values receives the field's value: the isovalue on a surface, the sample inside; NaN on
   *        a surface without an isovalue, where an open side meets NaN; float or double
   * @param surfaces receives -1 on the lower surface, 1 on the upper one, else 0
   */
  template <typename Value>
  void WriteValues(Value* values, std::int8_t* surfaces) const;

  /**
   * Writes the tetrahedra.
   *
   * @param mirrored of the map that places the points; their volumes are positive then
   * @param connectivity receives 4 point ids a tetrahedron (32 bits, or long long)
   * @param levels receives the level of the diamond that each lies in: 0 for the root, N at full
   *        resolution
   */
  template <typename Id>
  void WriteTetrahedra(bool mirrored, Id* connectivity, std::int8_t* levels) const;

private:
  /** The points of one refined diamond have consecutive ids: its centre if that lies inside, its
   *  alive isovertices on the lower surface, those on the upper one. */
  struct Slot
  {
    std::uint32_t First = 0;
    std::uint16_t HasCentre = 0;
    std::array<std::uint16_t, 2> Alive{}; ///< by surface

    /** Ids of points that there are not, which only a damaged file asks for, are 0. */
    std::uint32_t CentreId() const { return this->HasCentre != 0 ? this->First : 0; }
    std::uint32_t Id(int surface, int edge) const
    {
      if (((this->Alive[surface] >> edge) & 1U) == 0)
      {
        return 0;
      }
      const std::uint32_t before = (1U << edge) - 1U;
      return this->First + this->HasCentre +
        static_cast<std::uint32_t>(surface == 0
            ? PopCount(this->Alive[0] & before)
            : PopCount(this->Alive[0]) + PopCount(this->Alive[1] & before));
    }
    std::uint32_t Size() const
    {
      return this->HasCentre +
        static_cast<std::uint32_t>(PopCount(this->Alive[0]) + PopCount(this->Alive[1]));
    }
  };

  ExtractionPasses::Counts CountBrick(std::int64_t brick);

  template <typename Body>
  void ForEachPoint(Body&& body) const;
  template <typename Id>
  class TetrahedronWriter;

  const RefinedSet& Refined;
  const IsodiamondHierarchy& Source;
  ExtractionPasses Passes;
  std::vector<Slot> Slots; ///< by rank
};

}

#endif
