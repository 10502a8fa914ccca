// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Shortfall_h
#define isodiamond_Shortfall_h

#include "Stuffing/LocalMesh.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{

/** Tetrahedra with less than this part of the wanted sine all count as equally bad. */
inline constexpr double WorstPartOfSine = 0.01;

/** What a tetrahedron lacks: every bad one counts, the worst most.
 *  @param wanted a tetrahedron whose smallest sine is at least this lacks nothing */
inline double ShortfallOf(double sine, double wanted)
{
  const double missing = std::max(0.0, wanted / std::max(sine, WorstPartOfSine * wanted) - 1.0);
  return missing * missing;
}

/** What several tetrahedra lack in total. */
struct Shortfall
{
  explicit Shortfall(double wanted)
    : Wanted(wanted)
  {
  }

  void Add(double sine)
  {
    this->Worst = std::min(this->Worst, sine);
    this->Sum += ShortfallOf(sine, this->Wanted);
  }

  double Wanted;      ///< the sine at which nothing is lacking
  double Worst = 1.0; ///< the smallest sine
  double Sum = 0.0;
};

/** Whether a tetrahedron, which may be dead, lacks something. */
inline bool IsBad(const LocalMesh& mesh, double wanted, std::uint32_t tetrahedron)
{
  return mesh.IsAlive(tetrahedron) && mesh.SineOf(tetrahedron) < wanted;
}

/** The tetrahedra of a mesh that lack something, each once, the worst first. */
std::vector<std::uint32_t> WorstFirst(const LocalMesh& mesh, double wanted);
/** The same of some tetrahedra, which may be dead. */
std::vector<std::uint32_t> WorstFirst(
  const LocalMesh& mesh, double wanted, std::vector<std::uint32_t> some);

}

#endif
