// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceMinimal_h
#define ReferenceMinimal_h

#include "ReferenceRecords.h"

#include <map>
#include <vector>

namespace reference
{

/** Signs of sampled vertices. */
using VertexSigns = std::map<Point, int>;

/** What a walk over the minimal hierarchy finds. */
struct MinimalRefinement
{
  /** The subdivided active and creation diamonds. */
  DiamondSet Subdivided;
  /** The active diamonds that were reached over an arc, or the root, but not subdivided. */
  DiamondSet Front;
  /** The signs of the sampled vertices of every subdivided diamond, as the walk found them. */
  std::map<int, VertexSigns> Signs;
  /** The isosurface in the halves of the subdivided diamonds' tetrahedra; sorted. */
  std::vector<Patch> Patches;
};

/**
 * The minimal isodiamond hierarchy MI (section 7 of the paper): only active and creation diamonds,
 * for each its central vertex, the central vertex's sign and a threshold; besides these only the
 * signs of the base cube's corners. It never sees the field.
 *
 * Arcs (the paper's Table 1) are not stored. An arc leads from a subdivided diamond to an active
 * child if their duet is active: if a tetrahedron that they share has vertices of both signs. No
 * arc leads to a creation diamond: creation diamonds are in a list of their own, and all vertices
 * of one have the sign opposite to its central vertex's. Since the parent of an active duet is
 * itself active or a creation diamond (Theorem 7.1), every active diamond can be reached from the
 * root or from a creation diamond.
 *
 * The signs of a diamond's vertices come from its active duets. A tetrahedron in none of these has
 * only one sign: that of the spine, which is common to all tetrahedra of the diamond. At the grid's
 * border, where both ends of the spine may have no sample, it is that of any vertex of the
 * tetrahedron whose sign is already known.
 *
 * The thresholds must be closed: a stored diamond's threshold is no larger than a stored parent's.
 * Then subdividing one diamond never forces another. The closure over the children of a creation
 * diamond (section 7.3) is left out: it makes up for what the relevant diamonds, which MI lacks,
 * would have forced, and the thresholds contain that already. It would subdivide more than they ask
 * for.
 */
class MinimalHierarchy
{
public:
  /**
   * @param encoding the records of MI, whose error codes are ignored
   * @param thresholds the threshold of every diamond, of which only those of the records are kept
   */
  MinimalHierarchy(
    const Hierarchy& hierarchy, const Encoding& encoding, const std::vector<double>& thresholds);

  /**
   * Visits the root, the creation diamonds and all that arcs lead to, parents before children, and
   * subdivides every diamond with a threshold above the tolerance.
   */
  MinimalRefinement Refine(double tolerance) const;

private:
  struct Entry
  {
    int CenterSign;
    double Threshold;
    bool IsCreation;
  };

  VertexSigns BaseSigns() const;
  VertexSigns CreationSigns(int index) const;
  /** Adds the signs of the vertices in no active duet. */
  void Complete(int index, VertexSigns& signs) const;
  /** Hands the signs of a subdivided diamond's active duets on to its active children. */
  void FollowArcs(int index, const VertexSigns& signs, std::map<int, VertexSigns>& reached) const;
  void AddPatches(const Tetrahedron& leaf, const VertexSigns& signs, const DiamondSet& subdivided,
    std::vector<Patch>& patches) const;

  const Hierarchy& Geometry;
  unsigned int CornerSigns;
  std::map<int, Entry> Entries;
};

}

#endif
