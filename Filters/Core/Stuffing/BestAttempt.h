// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestAttempt_h
#define isodiamond_BestAttempt_h

#include "Field/Parallel.h"
#include "Stuffing/Background.h"
#include "Stuffing/Coarsening.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/KnownChanges.h"

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace isodiamond
{

/**
 * Finds the best that improvement and detours make of a mesh of leaves that have been cut.
 *
 * As cut, surfaces never intersect; but improvement moves them, and where sheets are near to each
 * other they may get through each other. So where they do, surfaces are held: they stay as cut in
 * the leaves there and all around these, and everything is improved again. Angles come first: if
 * more of them are bad then, what is held near these is released for good, and everything is
 * improved once more. Of all these attempts the one with the fewest bad angles is taken, and of
 * several such the one with the fewest intersections: in white noise there is often no room for
 * both. Where there is no room for angles all over the mesh, the first attempt has to do.
 */
class BestAttempt
{
public:
  /** All of these must outlive it, except for the options.
   *  @param start improved each time
   *  @param measured what surfaces are measured by, before anything that is long is done; null if
   *         they are not
   *  @param known see Improve() */
  BestAttempt(const Background& background, const TetrahedronMesh& start,
    const ImprovementOptions& options, const CoarseningInput* measured,
    const ParallelFor& parallelFor, KnownChanges* known);

  struct Attempt
  {
    TetrahedronMesh Mesh;
    /** The leaves where it is too far away, if that was found out (Coarsening.h): then the mesh is
     *  not finished. */
    std::vector<std::uint32_t> FarLeaves;
    ///@{
    /** If there are none of these: how many are left. */
    std::size_t Bad = 0;           ///< tetrahedra whose angles are not as wanted
    std::size_t Intersections = 0; ///< pairs of a surface's triangles; not counted if hopeless

    bool IsBetterThan(const Attempt& other) const
    {
      return std::tie(this->Bad, this->Intersections) < std::tie(other.Bad, other.Intersections);
    }
    ///@}
    /** Whether too many are bad for detours to be worth it, or for surfaces to be held. */
    bool IsHopeless() const;
  };
  Attempt Find();

private:
  enum class Holds : char
  {
    None,
    Held,
    Released ///< must not be held again
  };

  Attempt Try();
  std::size_t CountBad(const TetrahedronMesh& mesh) const;
  bool HoldIntersecting(Attempt& attempt);
  bool ReleaseAroundBad(const TetrahedronMesh& mesh);
  template <typename Visit>
  void ForEachCrossingAround(std::uint32_t leaf, Visit&& visit) const;

  const Background& Leaves;
  const TetrahedronMesh& Start;
  ImprovementOptions Options;
  std::vector<double> MostMoves; ///< by point: where it is not held
  std::vector<Holds> HeldAt;     ///< by point
  const CoarseningInput* Measured;
  const ParallelFor& ForAll;
  KnownChanges* Known;
};

}

#endif
