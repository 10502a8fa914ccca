// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes.h"

#include "vtkDataArray.h"
#include "vtkImageConstantPad.h"
#include "vtkImageReader2.h"
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"
#include "vtkNrrdReader.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>

namespace benchmark
{
namespace
{

/** What follows a file's name on the command line. */
struct Choice
{
  std::optional<double> Isovalue;
  std::optional<std::array<double, 2>> Isorange;
};

/** Choices of the paper's Table 2, and others that have been used with a volume. */
const std::map<std::string, Choice>& KnownChoices()
{
  static const std::map<std::string, Choice> known = {
    { "neghip", { 59.1, {} } },
    { "hydrogen_atom", { 24.0, std::array<double, 2>{ 24.0, 48.0 } } },
    { "fuel", { {}, std::array<double, 2>{ 7.2, 11.4 } } },
    { "tooth", { 119.5, {} } },
  };
  return known;
}

double Number(const std::string& text)
{
  std::size_t length = 0;
  double number = NAN;
  try
  {
    number = std::stod(text, &length);
  }
  catch (const std::exception&)
  {
  }
  if (length == 0 || length != text.size() || !std::isfinite(number))
  {
    throw std::invalid_argument("\"" + text + "\" is not a finite number.");
  }
  return number;
}

/** Splits FILE:ISOVALUE:LOWER:UPPER, where the last two come together. */
Choice ParseArgument(const std::string& argument, std::string& path)
{
  static const std::regex pattern("([^:]+)(?::([^:]+)(?::([^:]+):([^:]+))?)?");
  std::smatch match;
  if (!std::regex_match(argument, match, pattern))
  {
    throw std::invalid_argument(
      "\"" + argument + "\" is not FILE, FILE:ISOVALUE or FILE:ISOVALUE:LOWER:UPPER.");
  }
  path = match[1];
  Choice choice;
  if (match[2].matched)
  {
    choice.Isovalue = Number(match[2]);
  }
  if (match[3].matched)
  {
    choice.Isorange = { Number(match[3]), Number(match[4]) };
  }
  return choice;
}

vtkSmartPointer<vtkImageReader2> RawReader(const std::string& fileName, std::string& name)
{
  static const std::map<std::string, int> types = { { "uint8", VTK_UNSIGNED_CHAR },
    { "int16", VTK_SHORT }, { "uint16", VTK_UNSIGNED_SHORT }, { "float32", VTK_FLOAT } };
  static const std::regex pattern("(.+)_(\\d{1,5})x(\\d{1,5})x(\\d{1,5})_([a-z]+\\d+)\\.raw");
  std::smatch match;
  if (!std::regex_match(fileName, match, pattern) || types.count(match[5]) == 0)
  {
    throw std::invalid_argument("\"" + fileName +
      "\" is not named NAME_XxYxZ_TYPE.raw with TYPE "
      "uint8, int16, uint16 or float32.");
  }
  name = match[1];
  auto reader = vtkSmartPointer<vtkImageReader2>::New();
  reader->SetFileDimensionality(3);
  reader->SetDataExtent(
    0, std::stoi(match[2]) - 1, 0, std::stoi(match[3]) - 1, 0, std::stoi(match[4]) - 1);
  reader->SetDataScalarType(types.at(match[5]));
  reader->SetDataByteOrderToLittleEndian();
  reader->FileLowerLeftOn(); // rows in the file's order
  return reader;
}

bool EndsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

vtkSmartPointer<vtkImageReader2> ReaderOf(const std::string& fileName, std::string& name)
{
  name = fileName.substr(0, fileName.find('.'));
  if (EndsWith(fileName, ".nii") || EndsWith(fileName, ".nii.gz"))
  {
    return vtkSmartPointer<vtkNIFTIImageReader>::New();
  }
  if (EndsWith(fileName, ".nrrd") || EndsWith(fileName, ".nhdr"))
  {
    return vtkSmartPointer<vtkNrrdReader>::New();
  }
  return RawReader(fileName, name);
}

vtkSmartPointer<vtkImageData> Read(vtkImageReader2* reader, const std::string& path)
{
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkImageData> image = reader->GetOutput();
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (!scalars || scalars->GetNumberOfTuples() == 0 || scalars->GetNumberOfComponents() != 1)
  {
    throw std::runtime_error("There is no volume of one component in \"" + path + "\".");
  }
  scalars->SetName("Value");
  return image;
}

/** The middle of the range; for integers, half way between two, so that no sample equals it. */
double MiddleValue(const Volume& volume)
{
  const std::array<double, 2> range = volume.Range();
  const double value = 0.5 * (range[0] + range[1]);
  const int type = volume.Image->GetScalarType();
  return type == VTK_FLOAT || type == VTK_DOUBLE ? value : std::floor(value) + 0.5;
}

/** From the isovalue half way up to the largest sample. */
std::array<double, 2> UpperRange(const Volume& volume)
{
  return { volume.Isovalue, 0.5 * (volume.Isovalue + volume.Range()[1]) };
}

}

std::array<double, 2> Volume::Range() const
{
  std::array<double, 2> range{};
  this->Image->GetPointData()->GetScalars()->GetFiniteRange(range.data());
  return range;
}

double Volume::Voxel() const
{
  const double* spacing = this->Image->GetSpacing();
  return std::min({ spacing[0], spacing[1], spacing[2] });
}

VolumeSource VolumeFile(const std::string& argument)
{
  std::string path;
  const Choice given = ParseArgument(argument, path);
  if (!std::filesystem::is_regular_file(path))
  {
    throw std::invalid_argument("There is no file \"" + path + "\".");
  }
  std::string name;
  const vtkSmartPointer<vtkImageReader2> reader =
    ReaderOf(std::filesystem::path(path).filename().string(), name);
  Choice usual;
  if (KnownChoices().count(name) > 0)
  {
    usual = KnownChoices().at(name);
  }
  return { name,
    [path, given, usual, reader, name]
    {
      Volume volume;
      volume.Name = name;
      volume.Image = vtkSmartPointer<vtkImageData>::New();
      volume.Image->ShallowCopy(Read(reader, path));
      reader->GetOutput()->Initialize(); // or the samples would stay in memory
      reader->Modified();
      volume.Isovalue = given.Isovalue.value_or(usual.Isovalue.value_or(MiddleValue(volume)));
      volume.Isorange = given.Isorange.value_or(usual.Isorange.value_or(UpperRange(volume)));
      return volume;
    } };
}

Volume PadAsPaper(const Volume& volume)
{
  int dimensions[3];
  volume.Image->GetDimensions(dimensions);
  int last = 1; // 2^N
  while (last + 1 < *std::max_element(dimensions, dimensions + 3))
  {
    last *= 2;
  }
  vtkNew<vtkImageConstantPad> pad;
  pad->SetInputData(volume.Image);
  pad->SetConstant(0.0);
  pad->SetOutputWholeExtent(0, last, 0, last, 0, last);
  pad->Update();
  Volume padded = volume;
  padded.Image = pad->GetOutput();
  return padded;
}

}
