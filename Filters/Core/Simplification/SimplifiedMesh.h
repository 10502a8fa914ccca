// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SimplifiedMesh_h
#define isodiamond_SimplifiedMesh_h

#include "Field/Parallel.h"
#include "Simplification/AllowedMesh.h"
#include "Simplification/MeshDivision.h"
#include "Simplification/MeshPart.h"
#include "Simplification/PointNumbers.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * A mesh that is simplified part by part, in passes that cut the parts in different places.
 *
 * A part has triangles of the simpler mesh, and those of the original that are near to these alone
 * (MeshDivision.h); what is held stays as it is in that pass. Parts need to know of each other only
 * so as not to intersect (PartBorders.h). A pass goes over what is not settled yet, and some rings
 * of triangles around: all else is in no part.
 */
class SimplifiedMesh
{
public:
  /** @param original must outlive it */
  explicit SimplifiedMesh(const AllowedMesh& original);

  const std::vector<Triangle>& Triangles() const { return this->Simple.Triangles; }

  /** By point: the triangle that it lies over; None for points in use. */
  std::vector<std::uint32_t> PointHomes() const
  {
    return { this->Homes.begin(), this->Homes.begin() + this->Original.Mesh.Positions.size() };
  }

  /** Simplifies all parts.
   *  @param most triangles of a part @param cut see CutIntoBlocks
   *  @param usedPart see EdgeCollapses */
  void Simplify(std::size_t most, double cut, double usedPart, const ParallelFor& parallelFor);

  /** Forgets what has been tried: the next pass tries all again. */
  void TryAllAgain() { this->IsSettled = this->IsPinched; }

  /** The part of the triangles at which the next pass has anything to try: a corner was held so
   *  far, or something has changed around it since. */
  double PartToTry() const;

private:
  struct Made;

  SurfaceSample SampleOf(std::size_t id) const;
  /** @param others triangles of other parts @param ids receives the part's samples, the points
   * first, by their ids in the whole mesh */
  MeshPart Take(const MeshDivision& division, std::uint32_t number,
    const std::vector<Triangle>& others, std::vector<std::uint32_t>& ids) const;
  void AddPoints(const MeshDivision& division, std::uint32_t number, const PointNumbers& numbers,
    std::vector<std::uint32_t>& ids, MeshPart& part) const;
  std::vector<bool> FixedPoints(const MeshDivision& division, std::uint32_t number,
    const std::vector<std::uint32_t>& ids, const MeshPart& part) const;
  std::vector<std::uint32_t> TrianglesToTry() const;
  Made SimplifyPart(const MeshDivision& division, std::uint32_t number,
    const std::vector<Triangle>& others, double usedPart) const;
  void PutTogether(const MeshDivision& division, const std::vector<Made>& made);
  void Settle(const MeshDivision& division, const std::vector<Made>& made);
  std::vector<std::uint32_t> NewNumbers(const MeshDivision& division, const std::vector<Made>& made,
    std::vector<Triangle>& simple) const;
  void MoveHomes(const MeshDivision& division, const std::vector<Made>& made,
    const std::vector<std::uint32_t>& renamed);
  NearLists NewNear(const MeshDivision& division, const std::vector<Made>& made,
    const std::vector<std::uint32_t>& renamed) const;

  const AllowedMesh& Original;
  LinkedTriangles OriginalLinks;
  std::vector<bool> IsFaulty;  ///< by point: neighbours there are meaningless
  std::vector<bool> IsPinched; ///< by point: sheets meet there, so it stays
  std::vector<bool> IsSettled; ///< by point: as in MeshPart
  LinkedTriangles Simple;
  std::vector<std::uint32_t> Homes;    ///< by sample: the points, then the middles of triangles
  std::vector<double> PointAllowances; ///< by point: the least of the triangles there
  NearLists Near;                      ///< by original triangle
};

}

#endif
