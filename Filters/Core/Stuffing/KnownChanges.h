// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_KnownChanges_h
#define isodiamond_KnownChanges_h

#include "Field/Parallel.h"
#include "Stuffing/Change.h"

#include <functional>
#include <vector>

namespace isodiamond
{

/**
 * The changes that improved a mesh, to be tried first in the next one.
 *
 * While leaves get finer here and there, their mesh is improved again and again, mostly by the same
 * changes. Searching for the best change takes much longer than finding out whether a given one
 * makes things better. So what was the best change of a tetrahedron before is done again if that
 * tetrahedron, and all that would be replaced, are still there, and if it still helps. Detours are
 * not noted.
 */
class KnownChanges
{
public:
  /** Whether a change may be made for a tetrahedron. It reads no more than BestChange() does; it is
   *  called in several threads, and again for a change around which others have been made. */
  using Check = std::function<bool(const Change& change, std::uint32_t tetrahedron)>;

  /** Does again what may be done, in a mesh that has not been changed yet. From then on this knows
   *  of changes of that mesh only. */
  void DoAgain(LocalMesh& mesh, const Check& mayDo, const ParallelFor& parallelFor);

  /** Notes a change that is about to be made in the mesh last given to DoAgain().
   *  @param tetrahedron for which it is the best */
  void Note(const Change& change, std::uint32_t tetrahedron, const LocalMesh& mesh);

  std::size_t Count() const { return this->Changes.size(); }

private:
  /** By what a point is known in another mesh, and its number. */
  struct PointPlace
  {
    Vector Position{};
    std::int8_t Surface = 0;
    Walls::Type OnWalls = 0;
    std::uint32_t Point = LocalMesh::None;

    bool IsThatOf(const PointPlace& other) const;
  };
  struct Known
  {
    StoredChange What;
    Corners BestFor{};                        ///< the tetrahedron
    std::uint32_t NewPoint = LocalMesh::None; ///< that it adds
  };

  static std::vector<PointPlace> PlacesOf(const TetrahedronMesh& mesh);
  std::vector<std::uint32_t> IdsIn(const std::vector<PointPlace>& places) const;

  std::vector<PointPlace> Places; ///< of the mesh before its changes, by position
  std::vector<Known> Changes;     ///< in their order
};

}

#endif
