// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Improvement.h"

#include "Stuffing/BestChange.h"
#include "Stuffing/ChangeNotes.h"
#include "Stuffing/LocalMesh.h"
#include "Stuffing/Shortfall.h"

#include <algorithm>
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
      std::vector<std::uint32_t> changed;
      for (std::size_t first = 0; first < bad.size(); first += TriesAtOnce)
      {
        const std::size_t count = std::min(TriesAtOnce, bad.size() - first);
        this->Improve(bad.data() + first, count, parallelFor, changed);
      }
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
  /** Finds the best changes for some tetrahedra at once, and does them one after the other. A
   *  change found from what another one has changed since is searched for again: so all are as if
   *  each had been found when its turn came. */
  void Improve(const std::uint32_t* tetrahedra, std::size_t count, const ParallelFor& parallelFor,
    std::vector<std::uint32_t>& changed)
  {
    const auto isToBeTried = [&](std::size_t i)
    {
      return IsBad(this->Mesh, this->Wanted, tetrahedra[i]) &&
        this->Notes.IsWorthATry(this->Mesh, tetrahedra[i]);
    };
    const int before = this->Notes.Count();
    std::vector<Change> changes(count);
    ForEachIndex(parallelFor, count, 1,
      [&](std::int64_t i)
      {
        if (isToBeTried(i))
        {
          changes[i] = BestChange(this->Mesh, this->Options, tetrahedra[i]);
        }
      });
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isToBeTried(i))
      {
        if (this->Notes.IsTouchedAround(this->Mesh, tetrahedra[i], before))
        {
          changes[i] = BestChange(this->Mesh, this->Options, tetrahedra[i]);
        }
        this->Notes.NoteTry(tetrahedra[i]);
        if (changes[i].Kind != Change::None)
        {
          if (this->Known != nullptr)
          {
            this->Known->Note(changes[i], tetrahedra[i], this->Mesh);
          }
          this->Notes.Do(changes[i], this->Mesh, changed);
        }
      }
    }
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
