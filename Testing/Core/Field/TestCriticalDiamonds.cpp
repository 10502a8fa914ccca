// SPDX-License-Identifier: BSD-3-Clause
// Critical diamonds are those of the definition, which compares the surface in a diamond's domain
// before and after its subdivision.
#include "Field/CriticalDiamonds.h"
#include "Tools/CoreTestTools.h"

#include "ReferenceInterval.h"
#include "ReferenceTopology.h"

#include <gtest/gtest.h>

#include <map>

using namespace isodiamond;

namespace
{

constexpr float Isovalue = 2.5F;
constexpr reference::Isorange Isorange = { 2.0, 3.0 };

/** Whole numbers from 0 to 5; none, half or three quarters of them are replaced by one end. */
test::Field RandomField(const std::array<int, 3>& dims, unsigned seed)
{
  test::Field field = test::NoiseField(dims, seed);
  std::mt19937 random(seed);
  const unsigned blobs = seed % 3;
  for (float& sample : field.Samples)
  {
    sample = static_cast<float>(random() % 6);
    const bool isOther = blobs != 0 && random() % (2 * blobs) != 0;
    sample = isOther ? (seed % 2 == 0 ? 0.0F : 5.0F) : sample;
  }
  return field;
}

struct Tally
{
  int Diamonds = 0;
  int Critical = 0;
  int Others = 0; ///< not critical, though the centre is on the other side than both ends
};

/** Compares the mask with the definition, for all diamonds that do not stick out. */
void CompareAll(const test::Field& field, const reference::Hierarchy& hierarchy,
  const DiamondMask& mask, const std::vector<reference::SideOfVertex>& surfaces, Tally& tally)
{
  const Grid grid(field.Dims);
  for (int i = 0; i < hierarchy.Size(); ++i)
  {
    const reference::Diamond& diamond = hierarchy.At(i);
    if (diamond.SticksOut)
    {
      continue;
    }
    bool isCritical = false;
    bool isCandidate = false;
    for (const reference::SideOfVertex& isAbove : surfaces)
    {
      isCritical = isCritical || reference::IsCritical(hierarchy, i, isAbove);
      isCandidate = isCandidate ||
        (isAbove(diamond.Spine[0]) == isAbove(diamond.Spine[1]) &&
          isAbove(diamond.Spine[0]) != isAbove(diamond.Center));
    }
    ASSERT_EQ(mask.Contains(test::PlaceOf(grid, diamond.Center)), isCritical)
      << "at " << diamond.Center[0] << " " << diamond.Center[1] << " " << diamond.Center[2];
    ++tally.Diamonds;
    tally.Critical += isCritical ? 1 : 0;
    tally.Others += isCandidate && !isCritical ? 1 : 0;
  }
}

DiamondMask MaskOf(const test::Field& field, const Isoregion& region)
{
  const Grid grid(field.Dims);
  const SignLattice signs(grid, field.View(), region, SerialFor);
  return CriticalDiamonds(grid, signs, test::ThreadedFor(2));
}

}

TEST(CriticalDiamonds, AreThoseOfTheDefinitionInRandomFields)
{
  Tally ofSurfaces;
  Tally ofVolumes;
  const std::vector<std::array<int, 3>> sizes = { { 3, 3, 3 }, { 5, 5, 5 }, { 9, 9, 9 },
    { 4, 6, 5 }, { 7, 3, 6 }, { 2, 5, 6 }, { 5, 2, 9 }, { 6, 9, 2 }, { 2, 2, 7 }, { 3, 10, 4 } };
  for (const std::array<int, 3>& dims : sizes)
  {
    const reference::Hierarchy hierarchy(dims);
    for (unsigned seed = 0; seed < 6; ++seed)
    {
      const test::Field field = RandomField(dims, seed);
      SCOPED_TRACE(field.Name + ", seed " + std::to_string(seed));
      const reference::ScalarField samples = field.Reference();
      const auto sideOf = [&samples](int surface) -> reference::SideOfVertex
      {
        return [&samples, surface](const reference::Point& vertex)
        { return reference::SignOf(samples.At(vertex), Isorange) >= surface; };
      };
      CompareAll(field, hierarchy, MaskOf(field, Isovalue),
        { [&samples](const reference::Point& vertex)
          { return reference::SignOf(samples.At(vertex), Isovalue) == 1; } },
        ofSurfaces);
      CompareAll(field, hierarchy, MaskOf(field, { Isorange.Lower, Isorange.Upper }),
        { sideOf(0), sideOf(1) }, ofVolumes);
    }
  }
  for (const Tally& tally : { ofSurfaces, ofVolumes })
  {
    EXPECT_GT(tally.Critical, 500);
    EXPECT_GT(tally.Diamonds - tally.Critical, 500);
    EXPECT_GT(tally.Others, 200);
  }
}

namespace
{

/** Of each parity, a diamond for each number of tetrahedra: inside the grid, at a face, an edge. */
std::vector<int> OneOfEachShape(const reference::Hierarchy& hierarchy)
{
  std::map<std::pair<int, std::size_t>, int> found;
  for (int i = 0; i < hierarchy.Size(); ++i)
  {
    const reference::Diamond& diamond = hierarchy.At(i);
    const int parity = Parity(diamond.Center);
    if (!diamond.SticksOut && parity != 0)
    {
      found.emplace(std::make_pair(parity, diamond.Tetrahedra.size()), i);
    }
  }
  std::vector<int> diamonds;
  for (const auto& [shape, diamond] : found)
  {
    diamonds.push_back(diamond);
  }
  return diamonds;
}

/** How many patterns of sides are critical: the centre on either side, the ends on the other, and
 *  any ring but those with one run of each side. */
int CountCritical(int ring, bool isOpen)
{
  return 2 * ((1 << ring) - (isOpen ? 2 * (ring - 1) : ring * (ring - 1)));
}

/** Tries all patterns of sides of a diamond's points. @return how many are critical */
int CompareAllPatterns(const reference::Hierarchy& hierarchy, int index)
{
  const reference::Diamond& diamond = hierarchy.At(index);
  std::vector<reference::Point> points = diamond.Vertices;
  points.push_back(diamond.Center);
  test::Field field = test::NoiseField(hierarchy.Dims(), 0);
  const Place place = test::PlaceOf(Grid(field.Dims), diamond.Center);
  int critical = 0;
  for (unsigned pattern = 0; pattern < 1U << points.size(); ++pattern)
  {
    field.Samples.assign(field.Samples.size(), 0.0F);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto& [x, y, z] = points[i];
      field.Samples[x + field.Dims[0] * (y + field.Dims[1] * z)] = (pattern >> i & 1U) * 5.0F;
    }
    const reference::ScalarField samples = field.Reference();
    const bool isCritical = reference::IsCritical(hierarchy, index,
      [&samples](const reference::Point& vertex) { return samples.At(vertex) > Isovalue; });
    EXPECT_EQ(MaskOf(field, Isovalue).Contains(place), isCritical) << "pattern " << pattern;
    critical += isCritical ? 1 : 0;
    if (testing::Test::HasFailure())
    {
      break;
    }
  }
  return critical;
}

}

// Rings of 6, 4 and 8 vertices, of 3 and 5 at faces of the grid, and of 3 at its edges.
TEST(CriticalDiamonds, AreThoseOfTheDefinitionForAllPatternsOfSides)
{
  const reference::Hierarchy hierarchy({ 5, 5, 5 });
  const std::vector<int> diamonds = OneOfEachShape(hierarchy);
  EXPECT_EQ(diamonds.size(), 1U + 3 * 2 + 3 * 3);
  for (const int index : diamonds)
  {
    const reference::Diamond& diamond = hierarchy.At(index);
    const int ring = static_cast<int>(diamond.Vertices.size()) - 2;
    const bool isOpen = static_cast<int>(diamond.Tetrahedra.size()) < ring;
    SCOPED_TRACE("class " + std::to_string(diamond.Class()) + ", ring of " + std::to_string(ring));
    EXPECT_EQ(CompareAllPatterns(hierarchy, index), CountCritical(ring, isOpen));
    if (HasFailure())
    {
      return;
    }
  }
}
