// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Detours.h"

#include "Stuffing/BestChange.h"
#include "Stuffing/ChangeNotes.h"
#include "Stuffing/Shortfall.h"
#include "Stuffing/Surroundings.h"

#include <algorithm>
#include <random>
#include <utility>

namespace isodiamond
{
namespace
{

/** Most is done in the first pass; what is left is tried with other random choices, and more. */
constexpr int DetourPasses = 4;
///@{
/** Changes that are tried at one place, and in all: some, and this many more for each tetrahedron
 * that is good thanks to them; they take half of that. Where a mesh is too coarse to be better, it
 * ends soon; and where steps on the axes differ, and much is bad, there is a limit. */
constexpr std::int64_t TriesAtOnePlace(int pass)
{
  return std::int64_t{ 1000 } << pass;
}
constexpr std::int64_t FirstTries = 10000;
constexpr std::int64_t TriesForOneMore = 200;
constexpr std::int64_t MostTries(std::size_t tetrahedra)
{
  return 10000 + static_cast<std::int64_t>(tetrahedra / 2);
}
///@}
/** Random changes at the beginning of an attempt: 1 to this many. */
constexpr int MostByChance = 3;
/** Improvements after that. */
constexpr int MostImprovements = 40;
/** Tetrahedra whose surroundings are searched at the same time, if they are apart. */
constexpr std::size_t LooksAtOnce = 16;

/** Changes to what is around a tetrahedron. */
struct Detour
{
  std::vector<StoredChange> Steps;
  std::int64_t Tries = 0;
};

/** Looks for the best detour around one tetrahedron. */
class DetourSearch
{
public:
  DetourSearch(const Surroundings& around, std::int64_t mostTries, int seed)
    : Around(around)
    , MostTries(mostTries)
    , Wanted(WantedSine(around.Options()))
    , Random(static_cast<unsigned>(seed))
  {
  }

  Detour Find()
  {
    State best{ this->Around.Mesh(), {}, {} };
    const Shortfall before = this->LackOf(best.Mesh);
    double least = before.Sum;
    for (int attempt = 0; this->Tries < this->MostTries && !this->BadOf(best.Mesh).empty();
         ++attempt)
    {
      State state = best;
      if (!this->ChangeByChance(state, 1 + attempt % MostByChance))
      {
        continue;
      }
      this->Improve(state);
      const Shortfall after = this->LackOf(state.Mesh);
      if (after.Worst >= before.Worst && after.Sum < least)
      {
        least = after.Sum;
        best = std::move(state);
      }
    }
    return { std::move(best.Steps), this->Tries };
  }

private:
  /** What the surroundings have become. */
  struct State
  {
    LocalMesh Mesh;
    ChangeNotes Notes;
    std::vector<StoredChange> Steps;

    void Do(const Change& change)
    {
      this->Steps.emplace_back(change, this->Mesh);
      std::vector<std::uint32_t> changed;
      this->Notes.Do(change, this->Mesh, changed);
    }
  };

  Shortfall LackOf(const LocalMesh& mesh) const
  {
    Shortfall sum(this->Wanted);
    for (std::uint32_t i = 0; i < mesh.Mesh().Tetrahedra.size(); ++i)
    {
      if (mesh.IsAlive(i))
      {
        sum.Add(mesh.SineOf(i));
      }
    }
    return sum;
  }

  std::vector<std::uint32_t> BadOf(const LocalMesh& mesh) const
  {
    std::vector<std::uint32_t> bad = WorstFirst(mesh, this->Wanted);
    bad.erase(std::remove_if(bad.begin(), bad.end(),
                [&](std::uint32_t tetrahedron) { return !this->Around.IsFree(mesh, tetrahedron); }),
      bad.end());
    return bad;
  }

  std::size_t Draw(std::size_t count) { return this->Random() % count; }

  /** Makes several random changes that touch a bad tetrahedron. @return whether it could */
  bool ChangeByChance(State& state, int times)
  {
    for (; times > 0; --times)
    {
      const std::vector<std::uint32_t> bad = this->BadOf(state.Mesh);
      if (bad.empty())
      {
        return true;
      }
      ++this->Tries;
      const Corners& corners = state.Mesh.CornersOf(bad[this->Draw(bad.size())]);
      const LocalMesh::Star star = state.Mesh.StarOf(corners[this->Draw(corners.size())]);
      const std::uint32_t beside = *(star.begin() + this->Draw(star.end() - star.begin()));
      const Change change = this->Around.IsFree(state.Mesh, beside)
        ? AnyChange(state.Mesh, this->Around.Options(), beside, this->Random)
        : Change();
      if (change.Kind == Change::None)
      {
        return false;
      }
      state.Do(change);
    }
    return true;
  }

  /** Improves what is bad, as far as single changes help: the worst first, each time. */
  void Improve(State& state)
  {
    bool goesOn = true;
    for (int i = 0; i < MostImprovements && goesOn; ++i)
    {
      const std::vector<std::uint32_t> bad = this->BadOf(state.Mesh);
      goesOn = std::any_of(bad.begin(), bad.end(),
        [&](std::uint32_t tetrahedron)
        {
          if (!state.Notes.IsWorthATry(state.Mesh, tetrahedron))
          {
            return false;
          }
          ++this->Tries;
          state.Notes.NoteTry(tetrahedron);
          const Change change = BestChange(state.Mesh, this->Around.Options(), tetrahedron);
          if (change.Kind == Change::None)
          {
            return false;
          }
          state.Do(change);
          return true;
        });
    }
  }

  const Surroundings& Around;
  std::int64_t MostTries;
  std::int64_t Tries = 0;
  double Wanted; ///< sine
  std::minstd_rand Random;
};

/** Cuts out surroundings that have no point in common. */
class ApartSurroundings
{
public:
  ApartSurroundings(const LocalMesh& mesh, const ImprovementOptions& options)
    : Mesh(mesh)
    , Options(options)
  {
  }

  /** Takes those of the first of some tetrahedra. @param waiting loses these */
  std::vector<Surroundings> Take(std::vector<std::uint32_t>& waiting)
  {
    ++this->Turn;
    this->TakenIn.resize(this->Mesh.Mesh().Positions.size());
    std::vector<Surroundings> apart;
    std::vector<std::uint32_t> left;
    const std::size_t looks = std::min(LooksAtOnce, waiting.size());
    for (std::size_t i = 0; i < looks; ++i)
    {
      Surroundings around(this->Mesh, this->Options, waiting[i]);
      const bool isApart = std::all_of(around.Ids().begin(), around.Ids().end(),
        [&](std::uint32_t point) { return this->TakenIn[point] != this->Turn; });
      if (isApart)
      {
        std::for_each(around.Ids().begin(), around.Ids().end(),
          [&](std::uint32_t point) { this->TakenIn[point] = this->Turn; });
        apart.push_back(std::move(around));
      }
      else
      {
        left.push_back(waiting[i]);
      }
    }
    left.insert(left.end(), waiting.begin() + static_cast<std::ptrdiff_t>(looks), waiting.end());
    waiting = std::move(left);
    return apart;
  }

private:
  const LocalMesh& Mesh;
  const ImprovementOptions& Options;
  int Turn = 0;
  std::vector<int> TakenIn; ///< by point: the last turn that it was in
};

/** See Detours.h. */
void ImproveByDetours(
  LocalMesh& mesh, const ImprovementOptions& options, const ParallelFor& parallelFor)
{
  const double wanted = WantedSine(options);
  ApartSurroundings apart(mesh, options);
  std::vector<std::uint32_t> bad = WorstFirst(mesh, wanted);
  std::int64_t credit = FirstTries;
  std::int64_t left = MostTries(mesh.Mesh().Tetrahedra.size());
  for (int pass = 1; pass <= DetourPasses; ++pass)
  {
    for (std::vector<std::uint32_t> waiting = bad; !waiting.empty();)
    {
      const std::int64_t most = std::min({ credit, left, TriesAtOnePlace(pass) });
      if (most <= 0)
      {
        return;
      }
      const std::vector<Surroundings> places = apart.Take(waiting);
      std::vector<Detour> detours(places.size());
      ForEachIndex(parallelFor, places.size(), 1,
        [&](std::int64_t i) { detours[i] = DetourSearch(places[i], most, pass).Find(); });
      const std::size_t before = bad.size();
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        credit -= detours[i].Tries;
        left -= detours[i].Tries;
        places[i].DoInWhole(detours[i].Steps, mesh, bad);
      }
      bad = WorstFirst(mesh, wanted, std::move(bad));
      credit += TriesForOneMore * static_cast<std::int64_t>(before - std::min(before, bad.size()));
      waiting = WorstFirst(mesh, wanted, std::move(waiting)); // some are good by now, or gone
    }
  }
}

}

TetrahedronMesh TakeDetours(
  TetrahedronMesh mesh, const ImprovementOptions& options, const ParallelFor& parallelFor)
{
  LocalMesh local(std::move(mesh));
  ImproveByDetours(local, options, parallelFor);
  return local.Take();
}

}
