// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FarthestSearch_h
#define isodiamond_FarthestSearch_h

#include "DiamondPatches.h"
#include "RisingErrors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace isodiamond
{

/**
 * Finds the isovertex of a diamond that is farthest from the patches around the spine. Isovertices
 * are proposed, with the tetrahedron that holds them; few of those need to be compared with more
 * than its own patch. Used for one diamond after the other, by one thread.
 */
class FarthestSearch
{
public:
  FarthestSearch(const RisingErrors& errors, int surface)
    : Metric(errors.Metric())
    , Patches(errors.Hierarchy(), errors.Metric(), surface)
  {
  }

  /** Goes on to another diamond. */
  void Reset(const Place& diamond)
  {
    this->Patches.Reset(diamond);
    this->Candidates.clear();
  }

  /** The number of one of the diamond's tetrahedra, and whether it is one with samples at all
   *  vertices. */
  int Find(const HalfPlace& tetrahedron) const { return this->Patches.Find(tetrahedron); }
  bool IsThere(int tetrahedron) const { return this->Patches.IsThere(tetrahedron); }

  /** Looks at the distance of an isovertex to the patch of its tetrahedron. */
  void Propose(int tetrahedron, const FinePosition& position, Farthest& farthest)
  {
    farthest.IsAny = true;
    const Vector point = this->Metric(position);
    const double squared = this->Patches.SquaredTo(tetrahedron, point);
    if (squared > farthest.Squared)
    {
      this->Candidates.push_back({ squared, tetrahedron, point });
    }
  }

  /** Looks for nearer patches of what was proposed. The isovertex that is farthest from its own
   *  goes first: few others need it then. */
  void Decide(Farthest& farthest)
  {
    const auto measure = [&](const Candidate& candidate)
    {
      if (candidate.Squared > farthest.Squared)
      {
        farthest.Squared = std::max(farthest.Squared,
          this->Patches.SquaredToNearest(
            candidate.Tetrahedron, candidate.Point, candidate.Squared, farthest.Squared));
      }
    };
    const auto first = std::max_element(this->Candidates.begin(), this->Candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.Squared < b.Squared; });
    if (first != this->Candidates.end())
    {
      measure(*first);
    }
    std::for_each(this->Candidates.begin(), this->Candidates.end(), measure);
    this->Candidates.clear();
  }

  /** Whether all of a box is surely nearer than a distance: no distance changes faster than the
   *  place does. */
  bool IsWithin(int tetrahedron, const FineBox& box, double squaredLimit)
  {
    FinePosition centre;
    std::array<double, 3> half;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int size = box.High[axis] - box.Low[axis];
      centre[axis] = box.Low[axis] + size / 2;
      const int longer = size - size / 2;
      half[axis] = 1.0 / FineUnits * longer;
    }
    double squaredRadius = 0.0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Vector reach = this->Metric(
        (corner & 1) != 0 ? -half[0] : half[0], (corner & 2) != 0 ? -half[1] : half[1], half[2]);
      squaredRadius = std::max(squaredRadius, Dot(reach, reach));
    }
    const double limit = std::sqrt(squaredLimit) / (DistanceMargin * DistanceMargin) -
      std::sqrt(squaredRadius) * DistanceMargin;
    if (limit <= 0.0)
    {
      return false;
    }
    const Vector point = this->Metric(centre);
    const double own = this->Patches.SquaredTo(tetrahedron, point);
    const double enough = limit * limit;
    return own <= enough ||
      this->Patches.SquaredToNearest(tetrahedron, point, own, enough) <= enough;
  }

private:
  struct Candidate
  {
    double Squared = 0.0; ///< distance to the tetrahedron's own patch
    int Tetrahedron = 0;
    Vector Point{};
  };

  const WorldMetric& Metric;
  DiamondPatches Patches;
  std::vector<Candidate> Candidates;
};

}

#endif
