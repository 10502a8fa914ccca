// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshExtraction_h
#define isodiamond_MeshExtraction_h

#include "Field/AffineMap.h"
#include "Mesh/MeshPoints.h"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace isodiamond
{

/** The points of an extracted mesh, whatever its cells are. */
class MeshExtraction
{
public:
  std::int64_t PointCount() const { return this->Passes.PointCount(); }

  /** How the cells that were counted are dealt out to shares. Ranges number the counted cells; if
   *  only the share's own were counted, all are its own. */
  std::vector<DealtCells> Dealt() const { return this->Passes.Dealt(); }

  /** Writes 3 coordinates per point; float or double. */
  template <typename Coordinate>
  void WritePoints(const AffineMap& world, Coordinate* points) const
  {
    isodiamond::WritePoints(this->Passes, world, points);
  }

  /** Calls body(point) for every MeshPoint, in parallel. */
  template <typename Body>
  void ForEachPoint(Body&& body) const
  {
    isodiamond::ForEachPoint(this->Passes, body);
  }

  /** Calls body(group) for every PointGroup, in parallel. */
  template <typename Body>
  void ForEachPointGroup(Body&& body) const
  {
    isodiamond::ForEachPointGroup(this->Passes, body);
  }

  /**
   * From here on the mesh has only the points that some cells use.
   *
   * @param ids of points, as written for a range of cells; they become the points' new ids
   * @param size of ids
   */
  template <typename Id>
  void KeepPointsOf(Id* ids, std::int64_t size)
  {
    this->Passes.KeepPointsOf(ids, size);
  }

  /** The ids that the points left have among all that were counted. */
  template <typename Id>
  std::vector<Id> PointIds() const
  {
    if (const KeptPoints* kept = this->Passes.PointsKept())
    {
      return kept->Ids<Id>();
    }
    std::vector<Id> ids(this->PointCount());
    std::iota(ids.begin(), ids.end(), Id{ 0 });
    return ids;
  }

protected:
  explicit MeshExtraction(ExtractionPasses passes)
    : Passes(std::move(passes))
  {
  }

  ExtractionPasses Passes;
};

}

#endif
