// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Improvement.h"

#include "Stuffing/BestChange.h"
#include "Stuffing/ChangeNotes.h"
#include "Stuffing/LocalMesh.h"
#include "Stuffing/SearchAhead.h"
#include "Stuffing/Shortfall.h"

#include <cmath>
#include <utility>

namespace isodiamond
{
namespace
{

/** Passes over what is bad; most is done in two. */
constexpr int MostPasses = 10;
/** Tries in all passes, for this many that are bad before the first pass: where it is hopeless, as
 * a coarse mesh can be no better, there would be ever more. */
constexpr std::size_t MostSearches(std::size_t bad)
{
  return 1000 + 4 * bad;
}

/** Changes that are looked for at the same time: few of them touch each other. */
constexpr std::size_t TriesAtOnce = 64;

class Improver
{
public:
  Improver(TetrahedronMesh mesh, const ImprovementOptions& options, KnownChanges* known)
    : Mesh(std::move(mesh))
    , Options(options)
    , Known(known)
    , Wanted(WantedSine(options))
  {
  }

  /** Does what helped before, as long as it still helps a tetrahedron that is bad. */
  void DoKnown(const ParallelFor& parallelFor)
  {
    const auto mayDo = [this](const Change& change, std::uint32_t tetrahedron)
    {
      return IsBad(this->Mesh, this->Wanted, tetrahedron) &&
        Helps(change, this->Mesh, this->Options, tetrahedron);
    };
    if (this->Known != nullptr)
    {
      this->Known->DoAgain(this->Mesh, mayDo, parallelFor);
    }
  }

  void Run(const ParallelFor& parallelFor)
  {
    std::vector<std::uint32_t> bad = WorstFirst(this->Mesh, this->Wanted);
    std::size_t triesLeft = MostSearches(bad.size());
    for (int pass = 0; pass < MostPasses; ++pass)
    {
      if (bad.size() > triesLeft)
      {
        return;
      }
      triesLeft -= bad.size();
      const std::vector<std::uint32_t> changed = this->Improve(bad, parallelFor);
      if (changed.empty())
      {
        return;
      }
      bad.insert(bad.end(), changed.begin(), changed.end());
      bad = WorstFirst(this->Mesh, this->Wanted, std::move(bad));
    }
  }

  TetrahedronMesh Take() { return this->Mesh.Take(); }

private:
  bool IsToBeTried(std::uint32_t tetrahedron) const
  {
    return IsBad(this->Mesh, this->Wanted, tetrahedron) &&
      this->Notes.IsWorthATry(this->Mesh, tetrahedron);
  }

  /** Makes the best change for each of some tetrahedra.
   *  @return what is not as it was, by tetrahedron */
  std::vector<std::uint32_t> Improve(
    const std::vector<std::uint32_t>& tetrahedra, const ParallelFor& parallelFor)
  {
    std::vector<std::uint32_t> changed;
    SearchAhead(
      parallelFor, tetrahedra.size(), TriesAtOnce, this->Notes.Touched(),
      [&](std::size_t i)
      {
        return this->IsToBeTried(tetrahedra[i])
          ? BestChange(this->Mesh, this->Options, tetrahedra[i])
          : Change();
      },
      [&](std::size_t i, const Change& /*best*/, int changes)
      {
        return this->IsToBeTried(tetrahedra[i]) &&
          this->Notes.IsTouchedAround(this->Mesh, tetrahedra[i], changes);
      },
      [&](std::size_t i, const Change& best)
      {
        if (!this->IsToBeTried(tetrahedra[i]))
        {
          return;
        }
        this->Notes.NoteTry(tetrahedra[i]);
        if (best.Kind != Change::None)
        {
          if (this->Known != nullptr)
          {
            this->Known->Note(best, tetrahedra[i], this->Mesh);
          }
          this->Notes.Do(best, this->Mesh, changed);
        }
      });
    return changed;
  }

  LocalMesh Mesh;
  const ImprovementOptions& Options;
  KnownChanges* Known; ///< may be null
  double Wanted;       ///< sine
  ChangeNotes Notes;
};

}

double WantedSine(const ImprovementOptions& options)
{
  return std::sin(options.WantedAngle / DegreesOfRadian);
}

TetrahedronMesh Improve(TetrahedronMesh mesh, const ImprovementOptions& options,
  const ParallelFor& parallelFor, KnownChanges* known)
{
  Improver improver(std::move(mesh), options, known);
  improver.DoKnown(parallelFor);
  improver.Run(parallelFor);
  return improver.Take();
}

}
