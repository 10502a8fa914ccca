// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshDivision_h
#define isodiamond_MeshDivision_h

#include "Simplification/CellsAtPoints.h"
#include "Simplification/MeshBlocks.h"
#include "Simplification/NearLists.h"
#include "Simplification/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** A simpler mesh, and what each of its triangles stands for. All is referred to. */
struct MeshToDivide
{
  const std::vector<Vector>& Positions;
  const std::vector<Triangle>& Triangles;
  const NearLists& Near;                   ///< by original triangle; none is empty
  const std::vector<std::uint32_t>& Homes; ///< by sample: the triangle that it lies over, or None
};

/**
 * The parts of a simpler mesh that are simplified at the same time, each with the original
 * triangles that are near to its own alone.
 *
 * Where an original triangle is near to triangles of several parts, or also to some that are in
 * none, all of these are held.
 */
class MeshDivision
{
public:
  /** @param some triangles, ascending, that are in parts
   *  @param most triangles of a part @param cut see CutIntoBlocks */
  MeshDivision(
    const MeshToDivide& mesh, const std::vector<std::uint32_t>& some, std::size_t most, double cut);

  MeshBlocks Triangles;                      ///< of the simpler mesh, by part
  std::vector<std::uint32_t> PartOf;         ///< by triangle of the simpler mesh; None: in no part
  std::vector<std::uint32_t> Number;         ///< in its part
  std::vector<bool> IsHeld;                  ///< by triangle of the simpler mesh
  CellsAtPoints Originals;                   ///< by part
  std::vector<std::uint32_t> OwnerOf;        ///< by original triangle: the part; None if more
  std::vector<std::uint32_t> OriginalNumber; ///< in its part
  CellsAtPoints Samples;                     ///< that lie over triangles, by part

private:
  void FindOwners(const NearLists& near);
};

}

#endif
