// SPDX-License-Identifier: BSD-3-Clause
// The paper's Table 2, exactly, on its own volumes, padded with zeros to (2^N + 1)^3. The
// environment variable ISODIAMONDS_DATA_DIR says where the files are.
#include "Tools/IntervalTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

using namespace isodiamond;

namespace
{

struct Row
{
  const char* File;
  int Size;
  Isoregion Region;
  std::int64_t Isovertices;
  std::int64_t Relevant;
  std::int64_t Creation;
  std::int64_t Active;
  std::size_t Vertices;
  std::size_t Cells; ///< triangles or tetrahedra
};

void CheckRow(const Row& row)
{
  const char* folder = std::getenv("ISODIAMONDS_DATA_DIR");
  const std::string path = std::string(folder ? folder : "") + "/" + row.File;
  std::ifstream file(path, std::ios::binary);
  if (!folder || !file)
  {
    GTEST_SKIP() << "ISODIAMONDS_DATA_DIR does not hold " << row.File;
  }
  const int n = row.Size + 1;
  std::vector<std::uint8_t> samples(std::size_t(n) * n * n, 0);
  for (int z = 0; z < row.Size; ++z)
  {
    for (int y = 0; y < row.Size; ++y)
    {
      file.read(reinterpret_cast<char*>(samples.data() + (std::size_t(z) * n + y) * n), row.Size);
    }
  }
  ASSERT_TRUE(file);
  const SampleView<std::uint8_t> view(samples.data(), { n, n, n });
  const test::Built relevant(
    BuildIsodiamonds(Model::Relevant, view, row.Region, SerialFor), SerialFor);
  const test::Built minimal(
    BuildIsodiamonds(Model::Minimal, view, row.Region, SerialFor), SerialFor);
  EXPECT_EQ(minimal.Hierarchy->IsovertexCount(), row.Isovertices);
  EXPECT_EQ(minimal.Hierarchy->Count(Kind::Active), row.Active);
  EXPECT_EQ(minimal.Hierarchy->Count(Kind::Creation), row.Creation);
  EXPECT_EQ(relevant.Hierarchy->Count(Kind::Relevant) + relevant.Hierarchy->Count(Kind::Creation),
    row.Relevant);
  if (row.Region.IsVolume())
  {
    const test::Volume volume = test::ExtractVolume(*minimal.Hierarchy, 0.0);
    EXPECT_EQ(volume.Points.size() -
        static_cast<std::size_t>(std::count(volume.Surfaces.begin(), volume.Surfaces.end(), 0)),
      row.Vertices);
    EXPECT_EQ(volume.Tetrahedra.size(), row.Cells);
    EXPECT_EQ(test::FindFault(volume, { n, n, n }), "");
    for (const double tolerance : { 1.0, 10.0, 60.0 })
    {
      const test::Volume coarser = test::ExtractVolume(*minimal.Hierarchy, tolerance);
      EXPECT_LT(coarser.Tetrahedra.size(), volume.Tetrahedra.size());
      EXPECT_EQ(test::FindFault(coarser, { n, n, n }), "");
    }
    return;
  }
  const test::Mesh mesh = test::Extract(*minimal.Hierarchy, 0.0);
  EXPECT_EQ(mesh.Points.size(), row.Vertices);
  EXPECT_EQ(mesh.Triangles.size(), row.Cells);
}

}

TEST(PaperCounts, Neghip)
{
  CheckRow({ "neghip_64x64x64_uint8.raw", 64, 59.1, 56331, 14942, 17, 24523, 43131, 86102 });
}

TEST(PaperCounts, HydrogenAtom)
{
  CheckRow(
    { "hydrogen_atom_128x128x128_uint8.raw", 128, 24.0, 75792, 22314, 1, 33596, 56878, 113744 });
}

TEST(PaperCounts, FuelInterval)
{
  CheckRow({ "fuel_64x64x64_uint8.raw", 64, { 7.2, 11.4 }, 45818, 5449, 2, 10770, 35286, 109126 });
}

TEST(PaperCounts, HydrogenAtomInterval)
{
  CheckRow({ "hydrogen_atom_128x128x128_uint8.raw", 128, { 24.0, 48.0 }, 101022, 18277, 1, 53039,
    75932, 375976 });
}
