// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IntervalExtraction_h
#define isodiamond_IntervalExtraction_h

#include "Mesh/CutMesh.h"
#include "Mesh/MeshExtraction.h"

namespace isodiamond
{

/** The number of tetrahedra in a diamond's leaves. */
int CountTetrahedra(const IsodiamondHierarchy& hierarchy, const LeafParent& parent);

/**
 * The interval volume of a refined set, as tetrahedra: the patches of IntervalPatches.h over the
 * leaves of the current mesh.
 *
 * Points are the centres of refined diamonds that lie inside, and the alive isovertices of refined
 * diamonds, each belonging to one diamond; their ids are a prefix sum, as for surfaces (see
 * SurfaceExtraction.h). All tetrahedra have positive volume in index space and share whole faces.
 * The order and values of the output do not depend on threads. Paper, section 6.
 */
class IntervalExtraction : public MeshExtraction
{
public:
  /** The refined set must outlive the extraction. @throws std::length_error beyond 2^32 - 1
   *  points. */
  IntervalExtraction(
    const RefinedSet& refined, const ParallelFor& parallelFor, const MeshShare& share = {});

  std::int64_t TetrahedronCount() const { return this->Passes.Total().Cells; }

  /**
   * Writes what is known about the points.
   *
   * @param values receives field values: the isovalue on a surface, the sample inside; NaN on a
   *        surface without an isovalue, where an open side meets NaN; float or double
   * @param surfaces receives -1 on the lower surface, 1 on the upper one, else 0; 8 or 16 bits each
   */
  template <typename Value, typename Side>
  void WriteValues(Value* values, Side* surfaces) const;

  /**
   * Writes the tetrahedra.
   *
   * @param mirrored whether the map that places the points mirrors; after it, volumes are positive
   * @param connectivity receives 4 point ids per tetrahedron (32 bits, or long long)
   * @param levels receives the level of the diamond that each lies in: 0 for the root, N at full
   *        resolution
   */
  template <typename Id>
  void WriteTetrahedra(bool mirrored, Id* connectivity, std::int16_t* levels) const
  {
    this->WriteTetrahedra(this->Passes.AllCells(), mirrored, connectivity, levels);
  }

  /** Writes only a range of the tetrahedra. */
  template <typename Id>
  void WriteTetrahedra(
    const CellRange& range, bool mirrored, Id* connectivity, std::int16_t* levels) const;

  /** The leaves before they are cut. @param hidden the hidden cells, or null */
  CutMesh Leaves(const HiddenCells* hidden) const { return MakeCutMesh(this->Passes, hidden); }
};

}

#endif
