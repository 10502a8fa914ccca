// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TetrahedronCollapses_h
#define isodiamond_TetrahedronCollapses_h

#include "Field/Parallel.h"
#include "Simplification/EdgeCollapses.h"
#include "Stuffing/LocalMesh.h"

#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Collapses edges of a tetrahedral mesh into one of their ends, wherever that leaves tetrahedra of
 * good shape and the topology as it is, no edge much longer than those around were (by a quarter
 * inside, twice as long on surfaces), and the whole volume nearly the same. Inside it finds the
 * edges itself; on surfaces others do, who see to it that these stay near, and ask whether they may
 * (CollapseGuard). Collapses can be undone, until points move.
 */
class TetrahedronCollapses : public CollapseGuard
{
public:
  /** @param leastAngle in degrees: dihedral angles between that and 180 less that, or as good as
   *         what they replace
   *  @param volume what the mesh should have: it gets no farther from that than half a percent, or
   *         than it is */
  TetrahedronCollapses(TetrahedronMesh mesh, double leastAngle, double volume);

  /** Collapses edges whose vertices that go are on no surface. */
  void CollapseInside(const ParallelFor& parallelFor);

  /** Moves points that are on no surface to where the angles around them are better (Relaxation.h),
   *  after which more edges can collapse. Earlier collapses can no longer be undone.
   *  @param axes of RelaxationOptions */
  void RelaxInside(const std::array<Vector, 3>& axes, const ParallelFor& parallelFor);

  /** How many collapses there are. */
  std::size_t Count() const { return this->Steps.size(); }

  /** The mesh as it is now. All else is over then. */
  TetrahedronMesh Take() { return this->Mesh.Take(); }

  bool Allows(std::uint32_t vertex, std::uint32_t target) override;
  void Collapse(std::uint32_t vertex, std::uint32_t target) override;
  void NoteRefusal(std::uint32_t vertex) override;
  bool IsWorthATry(std::uint32_t vertex) const override { return !this->IsTried[vertex]; }
  std::vector<std::uint32_t> Undo(const std::vector<std::uint32_t>& vertices) override;

private:
  /** What was done, to be undone. */
  struct Step
  {
    std::uint32_t Vertex = 0;
    std::uint32_t Target = 0;
    double Gain = 0.0; ///< in volume
    std::vector<std::uint32_t> Old;
    std::vector<std::uint32_t> Fresh;
  };

  double SineNeeded(std::uint32_t vertex) const;
  double SineAfter(std::uint32_t vertex, std::uint32_t target, double needed) const;
  double GainOf(std::uint32_t vertex, std::uint32_t target) const;
  bool KeepsVolume(double gain) const;
  double MostLength(std::uint32_t a, std::uint32_t b, double mostTimes) const;
  bool IsNear(std::uint32_t point, const Vector& place) const;
  bool IsLong(std::uint32_t a, std::uint32_t b, double mostTimes) const;
  void FindTargets(std::uint32_t vertex, double needed);
  /** What has changed makes new tries worth while. */
  void LookAgainAround(const LocalMesh::Star& changed);

  LocalMesh Mesh;
  double LeastSine;
  double WantedVolume;
  double Volume;
  double MostChange;           ///< of it
  std::vector<double> Longest; ///< by point: the longest edge, squared, as it was at first
  std::vector<Step> Steps;
  std::vector<bool> IsTried;         ///< by point: and nothing has changed around it since
  std::vector<bool> IsShortOfVolume; ///< by point: refused for what others may give back
  /** Of one vertex: the smallest sine, negative, so that the best comes first. */
  std::vector<std::pair<double, std::uint32_t>> Targets;
};

}

#endif
