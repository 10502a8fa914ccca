// SPDX-License-Identifier: BSD-3-Clause
#include "Results.h"

#include <algorithm>
#include <sstream>

namespace benchmark
{

void Figures::Set(const std::string& name, double value)
{
  const auto found = std::find_if(this->Values.begin(), this->Values.end(),
    [&](const auto& figure) { return figure.first == name; });
  if (found == this->Values.end())
  {
    this->Values.emplace_back(name, value);
  }
  else
  {
    found->second = value;
  }
}

double Figures::Get(const std::string& name) const
{
  const auto found = std::find_if(this->Values.begin(), this->Values.end(),
    [&](const auto& figure) { return figure.first == name; });
  return found == this->Values.end() ? NAN : found->second;
}

const char* Tolerance::UnitName() const
{
  switch (this->In)
  {
    case Unit::PercentOfRange:
      return "% of the range";
    case Unit::Voxels:
      return "voxels";
    default:
      return "";
  }
}

std::string Tolerance::Text() const
{
  std::ostringstream text;
  text.precision(3);
  if (this->In != Unit::None)
  {
    text << this->Value << (this->In == Unit::Voxels ? " voxels" : " %");
  }
  return text.str();
}

Row& Table::At(const std::string& contestant, const Tolerance& tolerance)
{
  for (Row& row : this->Rows)
  {
    const bool same = row.Tolerance.Value == tolerance.Value ||
      (std::isnan(row.Tolerance.Value) && std::isnan(tolerance.Value));
    if (row.Contestant == contestant && same)
    {
      return row;
    }
  }
  this->Rows.push_back({ contestant, tolerance, {} });
  return this->Rows.back();
}

double Table::Get(const std::string& contestant, const std::string& figure, double tolerance) const
{
  for (const Row& row : this->Rows)
  {
    if (row.Contestant == contestant && (std::isnan(tolerance) || row.Tolerance.Value == tolerance))
    {
      return row.Figures.Get(figure);
    }
  }
  return NAN;
}

double VolumeResult::SampleCount() const
{
  return static_cast<double>(this->Dimensions[0]) * this->Dimensions[1] * this->Dimensions[2];
}

std::string VolumeResult::Title() const
{
  return this->Name + " " + std::to_string(this->Dimensions[0]) + " x " +
    std::to_string(this->Dimensions[1]) + " x " + std::to_string(this->Dimensions[2]);
}

Table& VolumeResult::Of(Shape shape)
{
  return shape == Shape::Isosurface ? this->Isosurface : this->IntervalVolume;
}

const Table& VolumeResult::Of(Shape shape) const
{
  return shape == Shape::Isosurface ? this->Isosurface : this->IntervalVolume;
}

}
