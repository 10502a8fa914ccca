// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TetrahedronCollapses_h
#define isodiamond_TetrahedronCollapses_h

#include "Field/Parallel.h"
#include "Simplification/EdgeCollapses.h"
#include "Stuffing/LocalMesh.h"
#include "Stuffing/TouchedPoints.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{

/** What the volume of a mesh should lie between. */
struct VolumeRange
{
  double Least = 0.0;
  double Most = 0.0;

  /** How far a volume is outside. */
  double Outside(double volume) const
  {
    return std::max({ this->Least - volume, volume - this->Most, 0.0 });
  }
};

/**
 * Collapses edges of a tetrahedral mesh into one of their ends, wherever that leaves tetrahedra of
 * good shape, the topology as it is, no edge much longer than those around it were (by a quarter
 * inside, twice as long on surfaces), and the whole volume nearly in its range. Inside it finds the
 * edges itself; on surfaces others find them, keep the surfaces near, and ask whether an edge may
 * collapse (CollapseGuard). Collapses can be undone until points move.
 */
class TetrahedronCollapses : public CollapseGuard
{
public:
  /** @param leastAngle in degrees: new dihedral angles are between this and 180 less this, or as
   *         good as what they replace
   *  @param wanted volume: the mesh's own gets no farther outside than half a percent, or than it
   *         already is */
  TetrahedronCollapses(TetrahedronMesh mesh, double leastAngle, const VolumeRange& wanted);

  /** Collapses edges where the vertex that is removed is on no surface. */
  void CollapseInside(const ParallelFor& parallelFor);

  /** Moves points that are on no surface to where the angles around them are better (Relaxation.h),
   *  after which more edges can collapse. Earlier collapses can no longer be undone.
   *  @param axes of RelaxationOptions */
  void RelaxInside(const std::array<Vector, 3>& axes, const ParallelFor& parallelFor);

  /** How many collapses there are. */
  std::size_t Count() const { return this->Steps.size(); }

  /** The mesh as it is now. Nothing else may be called afterwards. */
  TetrahedronMesh Take() { return this->Mesh.Take(); }

  bool Allows(std::uint32_t vertex, std::uint32_t target) override;
  void Collapse(std::uint32_t vertex, std::uint32_t target) override;
  void NoteRefusal(std::uint32_t vertex) override;
  bool IsWorthATry(std::uint32_t vertex) const override { return !this->IsTried[vertex]; }
  std::vector<std::uint32_t> Undo(const std::vector<std::uint32_t>& vertices) override;

private:
  /** What was done, so as to undo it. */
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
  bool KeepsEdgesShort(std::uint32_t point, const Vector& place) const;
  bool IsLong(std::uint32_t a, std::uint32_t b, double mostTimes) const;
  std::uint32_t BestTarget(std::uint32_t vertex) const;
  /** Changed tetrahedra make their points worth another try. */
  void LookAgainAround(const LocalMesh::Star& changed);

  LocalMesh Mesh;
  double LeastSine;
  VolumeRange WantedVolume;
  double Volume;
  double MostOutside;          ///< how far it may be outside
  std::vector<double> Longest; ///< by point: the longest edge, squared, as it was at first
  std::vector<Step> Steps;
  std::vector<bool> IsTried;         ///< by point: and nothing around it has changed since
  std::vector<bool> IsShortOfVolume; ///< by point: refused for volume that others may give back
  TouchedPoints Touched;
};

}

#endif
