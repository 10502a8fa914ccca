// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes.h"

#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace benchmark
{
namespace
{

/** Where a field is sampled. */
struct Location
{
  double X; ///< from -1 to 1 along the image's longest axis, the others to the same scale
  double Y;
  double Z;
  double VoxelsPerUnit;
  std::uint64_t Index;
};

struct Field
{
  const char* Name;
  int ScalarType;
  double (*Function)(const Location& at);
  double Isovalue;
  std::array<double, 2> Isorange;
  bool IsOdd; ///< an odd number of samples on every axis, a different one on each
};

/** Marschner & Lobb, "An Evaluation of Reconstruction Filters for Volume Rendering", 1994. */
double MarschnerLobb(const Location& at)
{
  const double alpha = 0.25;
  const double frequency = 6.0;
  const double pi = vtkMath::Pi();
  const double wave = std::cos(2.0 * pi * frequency * std::cos(0.5 * pi * std::hypot(at.X, at.Y)));
  return (1.0 - std::sin(0.5 * pi * at.Z) + alpha * (1.0 + wave)) / (2.0 * (1.0 + alpha));
}

struct Ball
{
  double X;
  double Y;
  double Z;
  double Radius;
};

/** 1 in the middle, 0 and smooth at the radius. */
double Metaball(const Ball& ball, const Location& at)
{
  const double x = (at.X - ball.X) / ball.Radius;
  const double y = (at.Y - ball.Y) / ball.Radius;
  const double z = (at.Z - ball.Z) / ball.Radius;
  const double left = std::max(0.0, 1.0 - x * x - y * y - z * z);
  return left * left * left;
}

/** Sheets all over the volume, with eight periods on each axis; some solid and some hollow balls.
 */
double GyroidWithMetaballs(const Location& at)
{
  static const Ball solid[] = { { -0.5, -0.4, -0.3, 0.45 }, { -0.2, -0.3, -0.2, 0.35 },
    { 0.5, 0.4, -0.5, 0.4 }, { 0.1, 0.6, 0.5, 0.35 } };
  static const Ball hollow[] = { { 0.5, -0.5, 0.4, 0.5 }, { -0.5, 0.5, 0.1, 0.3 } };
  const double x = 8.0 * vtkMath::Pi() * at.X + 0.3;
  const double y = 8.0 * vtkMath::Pi() * at.Y + 0.7;
  const double z = 8.0 * vtkMath::Pi() * at.Z + 1.1;
  double value = std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  for (const Ball& ball : solid)
  {
    value += 4.0 * Metaball(ball, at);
  }
  for (const Ball& ball : hollow)
  {
    value -= 4.0 * Metaball(ball, at);
  }
  return value;
}

/** Approximately normally distributed, with standard deviation 1; depends on the index alone. */
double Noise(std::uint64_t index)
{
  std::uint64_t bits = (index + 1) * 0x9e3779b97f4a7c15ULL; // splitmix64
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  bits ^= bits >> 31;
  double sum = 0.0; // of four uniform numbers
  for (int i = 0; i < 4; ++i)
  {
    sum += static_cast<double>((bits >> (16 * i)) & 0xffffU) / 65535.0;
  }
  return (sum - 2.0) * std::sqrt(3.0);
}

struct Organ
{
  std::array<double, 3> Center;
  std::array<double, 3> Radii;
  double Hounsfield;
};

/** 1 inside an ellipsoid, 0 outside, blurred over about two voxels. */
double Coverage(const Organ& organ, const Location& at)
{
  const double x = (at.X - organ.Center[0]) / organ.Radii[0];
  const double y = (at.Y - organ.Center[1]) / organ.Radii[1];
  const double z = (at.Z - organ.Center[2]) / organ.Radii[2];
  const double least = std::min({ organ.Radii[0], organ.Radii[1], organ.Radii[2] });
  const double depth = (1.0 - std::sqrt(x * x + y * y + z * z)) * least * at.VoxelsPerUnit;
  if (std::abs(depth) > 8.0)
  {
    return depth > 0.0 ? 1.0 : 0.0;
  }
  return 0.5 + 0.5 * std::tanh(depth);
}

/** CT of a head: skin, skull, brain, ventricles, air and noise. Later organs cover earlier ones. */
double NoisyPhantom(const Location& at)
{
  static const Organ organs[] = {
    { { 0.0, 0.0, 0.0 }, { 0.66, 0.82, 0.74 }, 20.0 },    // skin
    { { 0.0, 0.0, 0.02 }, { 0.6, 0.76, 0.68 }, 1000.0 },  // skull
    { { 0.0, 0.0, 0.02 }, { 0.54, 0.7, 0.62 }, 40.0 },    // brain
    { { -0.12, 0.05, 0.1 }, { 0.07, 0.26, 0.1 }, 5.0 },   // ventricles
    { { 0.12, 0.05, 0.1 }, { 0.07, 0.26, 0.1 }, 5.0 },    //
    { { 0.0, -0.7, -0.28 }, { 0.1, 0.16, 0.2 }, -1000.0 } // nose
  };
  double value = -1000.0;
  for (const Organ& organ : organs)
  {
    value += Coverage(organ, at) * (organ.Hounsfield - value);
  }
  return std::round(value + 30.0 * Noise(at.Index));
}

const std::vector<Field>& Fields()
{
  static const std::vector<Field> fields = {
    { "marschner-lobb", VTK_FLOAT, MarschnerLobb, 0.5, { 0.45, 0.55 }, false },
    { "gyroid", VTK_FLOAT, GyroidWithMetaballs, 0.0, { -0.3, 0.3 }, false },
    { "phantom", VTK_SHORT, NoisyPhantom, -300.5, { -300.5, 400.5 }, false },
    { "odd", VTK_FLOAT, GyroidWithMetaballs, 0.0, { -0.3, 0.3 }, true },
  };
  return fields;
}

template <typename T>
void FillSlice(const Field& field, const std::array<int, 3>& dimensions, int z, T* samples)
{
  const double longest = *std::max_element(dimensions.begin(), dimensions.end()) - 1;
  Location at{};
  at.VoxelsPerUnit = 0.5 * longest;
  at.Z = (2.0 * z - (dimensions[2] - 1)) / longest;
  for (int y = 0; y < dimensions[1]; ++y)
  {
    at.Y = (2.0 * y - (dimensions[1] - 1)) / longest;
    for (int x = 0; x < dimensions[0]; ++x)
    {
      at.X = (2.0 * x - (dimensions[0] - 1)) / longest;
      at.Index = (std::uint64_t(z) * dimensions[1] + y) * dimensions[0] + x;
      samples[at.Index] = static_cast<T>(field.Function(at));
    }
  }
}

Volume Sample(const Field& field, const std::array<int, 3>& dimensions)
{
  Volume volume;
  volume.Name = field.Name;
  volume.Isovalue = field.Isovalue;
  volume.Isorange = field.Isorange;
  volume.Image = vtkSmartPointer<vtkImageData>::New();
  volume.Image->SetDimensions(dimensions.data());
  volume.Image->AllocateScalars(field.ScalarType, 1);
  volume.Image->GetPointData()->GetScalars()->SetName("Value");
  void* samples = volume.Image->GetScalarPointer();
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false },
    [&]
    {
      vtkSMPTools::For(0, dimensions[2], 1,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (int z = static_cast<int>(begin); z < end; ++z)
          {
            if (field.ScalarType == VTK_SHORT)
            {
              FillSlice(field, dimensions, z, static_cast<short*>(samples));
            }
            else
            {
              FillSlice(field, dimensions, z, static_cast<float*>(samples));
            }
          }
        });
    });
  return volume;
}

}

std::vector<std::string> FieldNames()
{
  std::vector<std::string> names;
  for (const Field& field : Fields())
  {
    names.emplace_back(field.Name);
  }
  return names;
}

VolumeSource SyntheticVolume(const std::string& name, int size)
{
  for (const Field& field : Fields())
  {
    if (name == field.Name)
    {
      std::array<int, 3> dimensions = { size, size, size };
      if (field.IsOdd)
      {
        dimensions = { (size - size / 9) | 1, (size - size / 4) | 1, (size - size / 3) | 1 };
      }
      return { name, [&field, dimensions] { return Sample(field, dimensions); } };
    }
  }
  throw std::invalid_argument("There is no field \"" + name + "\".");
}

}
