// SPDX-License-Identifier: BSD-3-Clause
// Random changes, changes on copies of what is around a tetrahedron, and detours.
#include "Tools/StuffingTestTools.h"

#include "Stuffing/BestChange.h"
#include "Stuffing/Detours.h"
#include "Stuffing/Shortfall.h"
#include "Stuffing/Surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace isodiamond;

namespace
{

/** A tetrahedral mesh of noise, and what may be done to it. */
struct NoisyMesh
{
  NoisyMesh(int size, unsigned seed)
    : Field(test::NoiseField({ size, size, size }, seed))
    , Built(test::BuildVolume(this->Field, { 3.7, HUGE_VAL }))
    , Stuffed(*this->Built.Hierarchy, Query{})
    , Options(test::OptionsFor(this->Stuffed.Mesh))
  {
  }

  test::Field Field;
  test::Built Built;
  test::Stuffed Stuffed;
  ImprovementOptions Options;
};

/** A random one of the tetrahedra that are alive. */
std::uint32_t DrawAlive(const LocalMesh& mesh, std::minstd_rand& random)
{
  std::uint32_t drawn = 0;
  do
  {
    drawn = static_cast<std::uint32_t>(random() % mesh.Mesh().Tetrahedra.size());
  } while (!mesh.IsAlive(drawn));
  return drawn;
}

}

TEST(AnyChange, KeepsTheMeshSound)
{
  std::array<int, Change::Shift + 1> kinds{};
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    NoisyMesh noisy(7, seed);
    const test::AnyMesh plain(*noisy.Built.Hierarchy, Query{});
    const double wanted = WantedSine(noisy.Options);
    ASSERT_TRUE(WorstFirst(LocalMesh(noisy.Stuffed.Mesh), wanted).empty());
    std::minstd_rand random(seed);
    LocalMesh mesh(noisy.Stuffed.Mesh);
    std::vector<std::uint32_t> changed;
    for (int i = 0; i < 300; ++i)
    {
      const Change change = AnyChange(mesh, noisy.Options, DrawAlive(mesh, random), random);
      ++kinds.at(change.Kind);
      Do(change, mesh, changed);
    }
    noisy.Stuffed.Mesh = mesh.Take();
    const test::Volume volume = noisy.Stuffed.AsVolume();
    EXPECT_EQ(test::FindFault(volume, noisy.Field.Dims), "");
    EXPECT_EQ(test::TopologyOf(volume, plain), test::Topology(plain));
    for (const Corners& corners : noisy.Stuffed.Mesh.Tetrahedra)
    {
      EXPECT_GT(SmallestSine(noisy.Stuffed.Mesh, corners), 0.09 * wanted);
    }
  }
  for (const int kind :
    { Change::Move, Change::Collapse, Change::Replace, Change::Split, Change::Shift })
  {
    EXPECT_GT(kinds.at(kind), 20) << kind;
  }
}

// After any changes, the best one for a free tetrahedron is the same in the copy as in the whole;
// and changes do the same to both.
TEST(Surroundings, ChangeAsTheWholeDoes)
{
  for (unsigned seed = 1; seed <= 2; ++seed)
  {
    const NoisyMesh noisy(11, seed);
    ImprovementOptions options = noisy.Options;
    options.WantedAngle = 35.0; // so that there is much to improve
    LocalMesh whole(noisy.Stuffed.Mesh);
    std::minstd_rand random(seed);
    std::vector<std::uint32_t> changed;
    for (int round = 0; round < 12; ++round)
    {
      const Surroundings around(whole, options, DrawAlive(whole, random));
      LocalMesh mesh = around.Mesh();
      ASSERT_LT(mesh.Mesh().Tetrahedra.size(), whole.Mesh().Tetrahedra.size() / 2);
      std::vector<StoredChange> steps;
      LocalMesh follower = whole;
      for (int i = 0; i < 12; ++i)
      {
        std::uint32_t tetrahedron = 0;
        do
        {
          tetrahedron = DrawAlive(mesh, random);
        } while (!around.IsFree(mesh, tetrahedron));
        // The same one in the whole.
        const auto idOf = [&](std::uint32_t point)
        {
          return static_cast<std::uint32_t>(point < around.Ids().size()
              ? around.Ids()[point]
              : whole.Mesh().Positions.size() + point - around.Ids().size());
        };
        const Corners& corners = mesh.CornersOf(tetrahedron);
        const LocalMesh::Star star = follower.StarOf(idOf(corners[0]));
        const auto same = std::find_if(star.begin(), star.end(),
          [&](std::uint32_t candidate)
          {
            return std::all_of(corners.begin(), corners.end(),
              [&](std::uint32_t corner)
              { return Has(follower.CornersOf(candidate), idOf(corner)); });
          });
        ASSERT_NE(same, star.end());
        const Change best = BestChange(mesh, around.Options(), tetrahedron);
        const Change inWhole = BestChange(follower, options, *same);
        EXPECT_EQ(best.Kind, inWhole.Kind);
        EXPECT_NEAR(best.Gain, inWhole.Gain, 1e-6 * (1.0 + best.Gain));
        const Change change =
          i % 2 == 0 ? best : AnyChange(mesh, around.Options(), tetrahedron, random);
        steps.emplace_back(change, mesh);
        Do(change, mesh, changed);
        follower = whole;
        around.DoInWhole(steps, follower, changed);
      }
      std::multiset<std::set<Vector>> expected = test::PlacesOf(whole);
      for (const std::set<Vector>& places : test::PlacesOf(around.Mesh()))
      {
        expected.erase(expected.find(places));
      }
      expected.merge(test::PlacesOf(mesh));
      EXPECT_TRUE(test::PlacesOf(follower) == expected);
      whole = follower;
    }
  }
}

// In a squeezed world, where most angles are bad, and many stay so.
TEST(Detours, MakeTheWorstNoWorse)
{
  constexpr double Squeezed = 0.25;
  std::size_t helped = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    NoisyMesh noisy(5, seed);
    const test::AnyMesh plain(*noisy.Built.Hierarchy, Query{});
    for (Vector& position : noisy.Stuffed.Mesh.Positions)
    {
      position[2] *= Squeezed;
    }
    noisy.Options.CutEdges.clear();
    const double wanted = WantedSine(noisy.Options);
    const LocalMesh start(noisy.Stuffed.Mesh);
    const std::vector<std::uint32_t> before = WorstFirst(start, wanted);
    noisy.Stuffed.Mesh = TakeDetours(noisy.Stuffed.Mesh, noisy.Options, SerialFor);
    const LocalMesh end(noisy.Stuffed.Mesh);
    const std::vector<std::uint32_t> after = WorstFirst(end, wanted);
    helped += before.size() - std::min(before.size(), after.size());
    EXPECT_TRUE(after.empty() || end.SineOf(after[0]) >= start.SineOf(before.at(0)));
    for (Vector& position : noisy.Stuffed.Mesh.Positions)
    {
      position[2] /= Squeezed;
    }
    const test::Volume volume = noisy.Stuffed.AsVolume();
    EXPECT_EQ(test::FindFault(volume, noisy.Field.Dims), "");
    EXPECT_EQ(test::TopologyOf(volume, plain), test::Topology(plain));
  }
  EXPECT_GT(helped, 0U);
}
