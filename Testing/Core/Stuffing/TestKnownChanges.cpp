// SPDX-License-Identifier: BSD-3-Clause
// Changes of one mesh that are done again in another: the same one, with other numbers, and with
// other changes.
#include "Tools/StuffingTestTools.h"

#include "Stuffing/BestChange.h"
#include "Stuffing/BestPlace.h"
#include "Stuffing/KnownChanges.h"
#include "Stuffing/RingFilling.h"
#include "Stuffing/Shortfall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

using namespace isodiamond;

namespace
{

/** A tetrahedral mesh of noise with much to improve, what may be done to it, and what was done. */
struct ImprovedMesh
{
  explicit ImprovedMesh(unsigned seed)
    : Field(test::NoiseField({ 9, 9, 9 }, seed))
    , Built(test::BuildVolume(this->Field, { 3.7, HUGE_VAL }))
    , Stuffed(*this->Built.Hierarchy, Query{})
  {
    this->Stuffed.Mesh.Blended.clear(); // it is a mesh of its own here
    this->Options = test::OptionsFor(this->Stuffed.Mesh, 20.0);
    this->Result = Improve(this->Stuffed.Mesh, this->Options, SerialFor, &this->Known);
  }

  test::Field Field;
  test::Built Built;
  test::Stuffed Stuffed; ///< whose mesh it was
  ImprovementOptions Options;
  KnownChanges Known;
  TetrahedronMesh Result;
};

/** Does what is known again in a mesh, and counts by kind of change what is and is not done. */
struct DoneAgain
{
  DoneAgain(KnownChanges known, const ImprovementOptions& options, TetrahedronMesh mesh)
    : Mesh(std::move(mesh))
  {
    // One may be asked about more than once, if others have been done since: the last answer
    // counts.
    std::map<std::tuple<std::uint32_t, int, std::uint32_t, std::uint32_t, Vector>, bool> answers;
    known.DoAgain(
      this->Mesh,
      [&](const Change& change, std::uint32_t tetrahedron)
      {
        const bool helps = Helps(change, this->Mesh, options, tetrahedron);
        answers[{ tetrahedron, change.Kind, change.Point, change.Other, change.Place }] = helps;
        return helps;
      },
      SerialFor);
    for (const auto& [change, helps] : answers)
    {
      ++(helps ? this->Done : this->Refused).at(std::get<1>(change));
    }
    EXPECT_EQ(known.Count(), this->CountDone());
  }

  std::size_t CountDone() const { return std::accumulate(this->Done.begin(), this->Done.end(), 0); }

  int CountOffered() const
  {
    return std::accumulate(
      this->Refused.begin(), this->Refused.end(), static_cast<int>(this->CountDone()));
  }

  LocalMesh Mesh;
  std::array<int, Change::Shift + 1> Done{};
  std::array<int, Change::Shift + 1> Refused{};
};

/** A mesh after random changes. */
TetrahedronMesh ChangedAnyhow(
  TetrahedronMesh mesh, const ImprovementOptions& options, int changes, std::minstd_rand& random)
{
  LocalMesh local(std::move(mesh));
  std::vector<std::uint32_t> changed;
  for (int i = 0; i < changes; ++i)
  {
    const auto tetrahedron = static_cast<std::uint32_t>(random() % local.Mesh().Tetrahedra.size());
    if (local.IsAlive(tetrahedron))
    {
      Do(AnyChange(local, options, tetrahedron, random), local, changed);
    }
  }
  return local.Take();
}

/** Changes around a tetrahedron, whether they can be made or not. */
std::vector<Change> AnyChangesOf(
  const LocalMesh& mesh, std::uint32_t tetrahedron, test::Random& random)
{
  std::vector<Change> changes;
  const Corners corners = mesh.CornersOf(tetrahedron);
  const auto placeBeside = [&](std::uint32_t point)
  {
    Vector place = mesh.At(point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool stays = Walls::OnAxis(mesh.Mesh().OnWalls[point], axis);
      place[axis] += stays ? 0.0 : test::Uniform(random, -0.3, 0.3);
    }
    return place;
  };
  for (const std::uint32_t a : corners)
  {
    Change& move = changes.emplace_back();
    move.Kind = mesh.Mesh().Surfaces[a] == 0 ? Change::Move : Change::Shift;
    move.Point = a;
    move.Place = placeBeside(a);
    for (const std::uint32_t b : corners)
    {
      LocalMesh::Ring ring;
      if (a == b || !mesh.FindRing(a, b, MostAround, ring))
      {
        continue;
      }
      Change change;
      change.Point = a;
      change.Other = b;
      change.Kind = Change::Collapse;
      changes.push_back(change);
      change.Old = ring.Tetrahedra;
      change.Kind = Change::Split;
      change.OnWalls = static_cast<Walls::Type>(
        random() % 2 == 0 ? 0 : mesh.PlaceOfFace(a, b, ring.Points.front()));
      PointStar star;
      for (const std::uint32_t old : ring.Tetrahedra)
      {
        for (const std::uint32_t end : { a, b })
        {
          star.Add(mesh.Mesh(), mesh.CornersOf(old), end);
          change.Fresh.push_back(mesh.CornersOf(old));
          std::replace(
            change.Fresh.back().begin(), change.Fresh.back().end(), end, Change::NewPoint);
        }
      }
      change.Place =
        BestPlace(star, 0.5 * (mesh.At(a) + mesh.At(b)), change.OnWalls, test::UnitAxes, 0.7).Place;
      changes.push_back(change);
      change.Old.pop_back(); // not all that is around the edge
      change.Fresh.resize(change.Fresh.size() - 2);
      changes.push_back(change);
      change.Old = ring.Tetrahedra;
      change.Kind = Change::Replace;
      change.Fresh.clear();
      if (ring.Points.size() >= 3 && FillRing(mesh, a, b, ring.Points, change.Fresh) > 0.0)
      {
        changes.push_back(change);
        change.Old.pop_back(); // not all that is around the edge
        changes.push_back(change);
      }
    }
  }
  return changes;
}

/** Expects a change that may be made to be one that a search could have found. */
void ExpectAllowed(const Change& change, const LocalMesh& mesh, const ImprovementOptions& options)
{
  LocalMesh::Ring ring;
  switch (change.Kind)
  {
    case Change::Split:
      ASSERT_TRUE(mesh.FindRing(change.Point, change.Other, MostAround, ring));
      EXPECT_EQ(change.OnWalls,
        ring.IsClosed ? 0 : mesh.PlaceOfFace(change.Point, change.Other, ring.Points[0]));
      EXPECT_EQ(change.Old.size(), ring.Tetrahedra.size());
      break;
    case Change::Shift:
    {
      const Vector way = change.Place - mesh.At(mesh.SourceOf(change.Point));
      EXPECT_LE(Dot(way, way), options.SurfaceMove * options.SurfaceMove);
      EXPECT_TRUE(CanShift(mesh, change.Point, change.Place));
      break;
    }
    case Change::Replace:
      ASSERT_TRUE(mesh.FindRing(change.Point, change.Other, MostAround, ring));
      EXPECT_EQ(change.Old.size(), ring.Tetrahedra.size());
      EXPECT_TRUE(
        ring.IsClosed || CanTurn(mesh, change.Point, change.Other, ring, options.SurfaceMove));
      for (std::size_t i = 0; i + 2 < ring.Points.size(); ++i)
      {
        for (std::size_t j = i + 2; j < ring.Points.size(); ++j)
        {
          const bool isSide = ring.IsClosed && i == 0 && j + 1 == ring.Points.size();
          const bool isUsed = std::any_of(change.Fresh.begin(), change.Fresh.end(),
            [&](const Corners& corners)
            { return Has(corners, ring.Points[i]) && Has(corners, ring.Points[j]); });
          EXPECT_TRUE(isSide || !isUsed || !mesh.HasEdge(ring.Points[i], ring.Points[j]));
        }
      }
      break;
    default:
      break;
  }
}

}

TEST(KnownChanges, GiveTheSameMeshAgain)
{
  ImprovedMesh noisy(1);
  const std::size_t count = noisy.Known.Count();
  ASSERT_GT(count, 300U);
  const DoneAgain again(noisy.Known, noisy.Options, noisy.Stuffed.Mesh);
  EXPECT_EQ(again.CountDone(), count);
  const TetrahedronMesh result =
    Improve(noisy.Stuffed.Mesh, noisy.Options, SerialFor, &noisy.Known);
  EXPECT_EQ(noisy.Known.Count(), count);
  EXPECT_EQ(result.Tetrahedra, noisy.Result.Tetrahedra);
  EXPECT_EQ(result.Positions, noisy.Result.Positions);
}

TEST(KnownChanges, AreFoundUnderOtherNumbers)
{
  const ImprovedMesh noisy(2);
  const TetrahedronMesh& mesh = noisy.Stuffed.Mesh;
  const auto count = static_cast<std::uint32_t>(mesh.Positions.size());
  TetrahedronMesh turned = mesh;
  ImprovementOptions options = noisy.Options;
  std::reverse(turned.Positions.begin(), turned.Positions.end());
  std::reverse(turned.Surfaces.begin(), turned.Surfaces.end());
  std::reverse(turned.OnWalls.begin(), turned.OnWalls.end());
  std::reverse(options.CutEdges.begin(), options.CutEdges.end());
  std::reverse(turned.Tetrahedra.begin(), turned.Tetrahedra.end());
  std::reverse(turned.Origins.begin(), turned.Origins.end());
  for (Corners& corners : turned.Tetrahedra)
  {
    for (std::uint32_t& corner : corners)
    {
      corner = count - 1 - corner;
    }
  }
  const DoneAgain again(noisy.Known, noisy.Options, mesh);
  const DoneAgain inTurned(noisy.Known, options, turned);
  EXPECT_EQ(inTurned.CountDone(), noisy.Known.Count());
  EXPECT_TRUE(test::PlacesOf(inTurned.Mesh) == test::PlacesOf(again.Mesh));

  // A point in the same place, but on another surface or wall, is another one.
  TetrahedronMesh other = mesh;
  std::transform(other.Surfaces.begin(), other.Surfaces.end(), other.Surfaces.begin(),
    [](std::int8_t surface) { return surface == 0 ? 1 : 0; });
  EXPECT_EQ(DoneAgain(noisy.Known, noisy.Options, other).CountOffered(), 0);
  other = mesh;
  std::transform(other.OnWalls.begin(), other.OnWalls.end(), other.OnWalls.begin(),
    [](Walls::Type walls) { return static_cast<Walls::Type>(walls ^ 1); });
  EXPECT_EQ(DoneAgain(noisy.Known, noisy.Options, other).CountOffered(), 0);
}

// Where other changes come between, some can no longer be done; the mesh stays sound.
TEST(KnownChanges, AreDoneWhereTheyStillCanBe)
{
  std::array<int, Change::Shift + 1> done{};
  std::array<int, Change::Shift + 1> refused{};
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE(seed);
    ImprovedMesh noisy(seed);
    const test::AnyMesh plain(*noisy.Built.Hierarchy, Query{});
    std::minstd_rand random(seed);
    for (const int changes : { 10, 100, 400, 1600 })
    {
      TetrahedronMesh changed = ChangedAnyhow(noisy.Stuffed.Mesh, noisy.Options, changes, random);
      ImprovementOptions options = noisy.Options;
      options.CutEdges.resize(changed.Positions.size());
      DoneAgain again(noisy.Known, options, changed);
      for (std::size_t kind = 0; kind < done.size(); ++kind)
      {
        done[kind] += again.Done[kind];
        refused[kind] += again.Refused[kind];
      }
      noisy.Stuffed.Mesh = again.Mesh.Take();
      const test::Volume volume = noisy.Stuffed.AsVolume();
      EXPECT_EQ(test::FindFault(volume, noisy.Field.Dims), "");
      EXPECT_EQ(test::TopologyOf(volume, plain), test::Topology(plain));
    }
  }
  for (const int kind :
    { Change::Move, Change::Collapse, Change::Replace, Change::Split, Change::Shift })
  {
    EXPECT_GT(done.at(kind), 20) << kind;
    EXPECT_GT(refused.at(kind), 5) << kind;
  }
}

// Changes of all kinds, most of which nobody would search for: those that may be done leave the
// mesh sound, on its walls, and near its surfaces.
TEST(Helps, OnlyIfTheMeshStaysSound)
{
  std::array<int, Change::Shift + 1> done{};
  std::array<int, Change::Shift + 1> refused{};
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    const test::Field field = test::NoiseField({ 6, 6, 6 }, seed);
    const test::Built built = test::BuildVolume(field, { 3.7, HUGE_VAL });
    const test::AnyMesh plain(*built.Hierarchy, Query{});
    const test::Topology expected(plain);
    test::Stuffed result(*built.Hierarchy, Query{}); // for its means to tell
    const TetrahedronMesh before = test::Leaves(*built.Hierarchy, 0.0).Moved();
    const ImprovementOptions options = test::OptionsFor(before, 45.0);
    const LocalMesh mesh(before);
    test::Random random(seed);
    for (std::uint32_t tetrahedron = 0; tetrahedron < before.Tetrahedra.size(); ++tetrahedron)
    {
      for (const Change& change : AnyChangesOf(mesh, tetrahedron, random))
      {
        const bool helps = Helps(change, mesh, options, tetrahedron);
        int& count = (helps ? done : refused).at(change.Kind);
        ++count;
        if (!helps)
        {
          continue;
        }
        ExpectAllowed(change, mesh, options);
        if (count > 40)
        {
          continue; // the rest takes time
        }
        LocalMesh changedMesh(before);
        std::vector<std::uint32_t> changed;
        Do(change, changedMesh, changed);
        result.Mesh = changedMesh.Take();
        const test::Volume volume = result.AsVolume();
        ASSERT_EQ(test::FindFault(volume, field.Dims), "") << change.Kind;
        ASSERT_EQ(test::TopologyOf(volume, plain), expected) << change.Kind;
      }
    }
  }
  for (const int kind :
    { Change::Move, Change::Collapse, Change::Replace, Change::Split, Change::Shift })
  {
    EXPECT_GT(done.at(kind), 20) << kind;
    EXPECT_GT(refused.at(kind), 20) << kind;
  }
}

// Leaves that get finer here and there: most is known, and the result is as good as a fresh one.
TEST(KnownChanges, AreMostOfThoseOfARefinedMesh)
{
  const test::Field field = test::NoiseField({ 13, 13, 13 }, 4);
  const test::Built built = test::BuildVolume(field, { 3.7, HUGE_VAL });
  const test::Leaves leaves(*built.Hierarchy, 1.0);
  const TetrahedronMesh before = leaves.Moved();
  KnownChanges known;
  Improve(before, test::OptionsFor(before), SerialFor, &known);
  std::vector<Place> some = leaves.Diamonds(leaves.Mesh.Tetrahedra.size() / 50 + 1);
  ASSERT_GE(some.size(), 5U);
  some.resize(5);
  const TetrahedronMesh after = test::Leaves(*built.Hierarchy, 1.0, some).Moved();
  ASSERT_NE(after.Tetrahedra, before.Tetrahedra);
  const std::size_t count = known.Count();
  ASSERT_GT(count, 1000U);
  const ImprovementOptions options = test::OptionsFor(after);
  const DoneAgain again(known, options, after);
  EXPECT_GT(again.CountDone(), count / 2);
  const double wanted = WantedSine(options);
  const auto countBad = [&](TetrahedronMesh mesh)
  { return WorstFirst(LocalMesh(std::move(mesh)), wanted).size(); };
  const std::size_t bad = countBad(Improve(after, options, SerialFor, &known));
  const std::size_t fresh = countBad(Improve(after, options, SerialFor));
  EXPECT_LE(bad, fresh + fresh / 10);
  EXPECT_LT(bad, countBad(after) / 10);
}
