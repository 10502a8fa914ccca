// SPDX-License-Identifier: BSD-3-Clause
#ifndef Results_h
#define Results_h

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/**
 * @file Results.h
 * What was measured: figures with names, in rows by contestant, in a table for each shape of each
 * volume. Missing figures are NaN.
 */
namespace benchmark
{

/** Named numbers, in the order in which they were set. */
class Figures
{
public:
  void Set(const std::string& name, double value);
  double Get(const std::string& name) const;
  const std::vector<std::pair<std::string, double>>& All() const { return this->Values; }

private:
  std::vector<std::pair<std::string, double>> Values;
};

/** An error tolerance as it is shown to people; NaN for contestants that have none. */
struct Tolerance
{
  enum class Unit
  {
    None,
    PercentOfRange, ///< field metric
    Voxels          ///< distance metric
  };

  double Value = NAN;
  Unit In = Unit::None;

  static Tolerance Percent(double value) { return { value, Unit::PercentOfRange }; }
  static Tolerance Voxels(double value) { return { value, Unit::Voxels }; }

  const char* UnitName() const;
  std::string Text() const; ///< as in "0.3 %"; empty if there is none
};

struct Row
{
  std::string Contestant;
  benchmark::Tolerance Tolerance;
  benchmark::Figures Figures;
};

enum class Shape
{
  Isosurface,
  IntervalVolume
};

/** All contestants on one shape of one volume. */
struct Table
{
  std::vector<Row> Rows;

  /** The row of a contestant, a new one if need be. */
  Row& At(const std::string& contestant, const Tolerance& tolerance);

  /** A contestant's figure; if it ran at several tolerances, that at one of them. */
  double Get(
    const std::string& contestant, const std::string& figure, double tolerance = NAN) const;
};

struct VolumeResult
{
  std::string Name;
  std::array<int, 3> Dimensions{};
  std::string ScalarType;
  int BytesOfSample = 0;
  std::array<double, 2> Range{};
  double Isovalue = 0.0;
  std::array<double, 2> Isorange{};
  Table Isosurface;
  Table IntervalVolume;

  double SampleCount() const;
  std::string Title() const; ///< as in "gyroid 64 x 64 x 64"
  Table& Of(Shape shape);
  const Table& Of(Shape shape) const;
};

/** A demand that is judged by what was measured. */
struct Bar
{
  int Number = 0; ///< in the list of demands
  std::string What;
  std::string Where;
  double Measured = NAN;
  double Limit = NAN;
  bool IsUpperLimit = true;

  bool IsMet() const
  {
    return this->IsUpperLimit ? this->Measured <= this->Limit : this->Measured >= this->Limit;
  }
};

/** A whole run. */
struct Report
{
  std::string Processor;
  std::string Version; ///< of VTK
  int Threads = 1;
  int Repetitions = 1;
  double MemoryBandwidth = NAN; ///< bytes a second, both ways
  std::vector<VolumeResult> Volumes;
  std::vector<Bar> Bars;
};

}

#endif
