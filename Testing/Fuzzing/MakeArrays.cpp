// SPDX-License-Identifier: BSD-3-Clause
// Writes what the fuzzer of arrays begins with: small hierarchies of each model and form.
#include "Build/Builder.h"
#include "EncodingBytes.h"

#include <cmath>
#include <fstream>
#include <string>

using namespace isodiamond;

namespace
{

void Save(const std::string& file, const fuzz::Arrays& arrays)
{
  const std::vector<std::uint8_t> bytes = fuzz::Write(arrays);
  std::ofstream(file, std::ios::binary)
    .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

std::vector<float> Wave(const std::array<int, 3>& dimensions)
{
  std::vector<float> values;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x)
      {
        values.push_back(std::sin(1.1F * x) + std::cos(0.8F * y + 0.3F * z));
      }
    }
  }
  return values;
}

void SaveAll(const std::string& folder, const std::array<int, 3>& dimensions)
{
  const std::vector<float> values = Wave(dimensions);
  const AnySamples samples = SampleView<float>(values.data(), dimensions);
  const std::string name = folder + "/" + std::to_string(dimensions[0]);
  fuzz::Arrays arrays;
  arrays.Tolerance = 0.3;
  arrays.InteriorTolerance = 0.2;
  arrays.Region = { 0.0, 0.0, 0.0, 2.0, 2.0, 2.0 };
  for (const Isoregion& region : { Isoregion(0.2), Isoregion(-0.3, 0.4) })
  {
    const std::string shape = region.IsVolume() ? "-volume" : "-surface";
    for (const Model model : { Model::Minimal, Model::Relevant })
    {
      BuildOptions options;
      options.RefineInterior = model == Model::Relevant && region.IsVolume();
      options.Metric = model == Model::Minimal ? ErrorMetric::Distance : ErrorMetric::Field;
      arrays.Isodiamonds = BuildIsodiamonds(model, samples, region, SerialFor, options);
      Save(name + shape + (model == Model::Minimal ? "-mi" : "-ri"), arrays);
    }
    const ScalarEncoding scalars = BuildScalarHierarchy(samples, SerialFor);
    fuzz::Arrays hd;
    hd.Tolerance = 0.3;
    hd.InteriorTolerance = 0.2;
    hd.Isodiamonds.Header.TheModel = Model::HierarchyOfDiamonds;
    hd.Isodiamonds.Header.Dimensions = dimensions;
    hd.Isodiamonds.Header.Region = region;
    hd.Isodiamonds.Header.ErrorScale = scalars.ErrorScale;
    hd.Errors = scalars.Codes;
    hd.Samples = values;
    hd.Minima = scalars.Minima;
    hd.Maxima = scalars.Maxima;
    Save(name + shape + "-hd", hd);
  }
}

}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    return 1;
  }
  SaveAll(argv[1], { 5, 5, 5 });
  SaveAll(argv[1], { 9, 4, 6 });
  return 0;
}
