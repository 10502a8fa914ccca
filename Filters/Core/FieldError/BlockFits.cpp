// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError/BlockFits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isodiamond
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr int Edge = BlockFits::FinestEdge;

/** Rounds a bound up; infinite if arithmetic has overflowed. */
float UpperFloat(double bound)
{
  return bound < std::numeric_limits<float>::max()
    ? std::nextafter(static_cast<float>(bound), HUGE_VALF)
    : HUGE_VALF;
}

/** The samples of one cube of the finest size. */
class Block
{
public:
  /** @param dimensions of the volume @param firstSlice the first one that has samples here */
  template <typename T>
  Block(const std::array<int, 3>& dimensions, const SampleView<T>& samples, int firstSlice,
    const Point& first)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Last[axis] = std::min(Edge, dimensions[axis] - 1 - first[axis]);
    }
    double low = Infinity;
    double high = -Infinity;
    double invalid = 0.0;
    this->ForEachRow(
      [&](int y, int z)
      {
        const T* from = samples.Pointer() + samples.Index(first + Point{ 0, y, z - firstSlice });
        double* to = this->Row(y, z);
        for (int x = 0; x <= this->Last[0]; ++x)
        {
          const auto value = static_cast<double>(from[x]);
          to[x] = value;
          low = value < low ? value : low;
          high = value > high ? value : high;
          invalid += value - value; // NaN for values that are not finite
        }
      });
    this->IsFinite = invalid == 0.0;
    this->Range = this->IsFinite ? ValueRange{ low, high } : ValueRange{ -Infinity, Infinity };
  }

  BlockFit Fit()
  {
    BlockFit fit;
    fit.Range = this->Range;
    if (!this->IsFinite)
    {
      fit.Residual = HUGE_VALF;
    }
    else if (this->Last == Point{ Edge, Edge, Edge })
    {
      this->FitSlopes(fit);
      // Half the range of what remains.
      const ValueRange rest = this->Residuals(fit);
      fit.Value = static_cast<float>(0.5 * (rest.Minimum + rest.Maximum));
      fit.Residual =
        UpperFloat(std::max(rest.Maximum - fit.Value, fit.Value - rest.Minimum) * (1.0 + 1e-9));
    }
    return fit;
  }

private:
  static constexpr int Width = Edge + 1;
  static constexpr int Middle = Edge / 2;

  double* Row(int y, int z) { return &this->Values[(z * Width + y) * Width]; }

  template <typename Body>
  void ForEachRow(const Body& body) const
  {
    for (int z = 0; z <= this->Last[2]; ++z)
    {
      for (int y = 0; y <= this->Last[1]; ++y)
      {
        body(y, z);
      }
    }
  }

  /** Fits by least squares. */
  void FitSlopes(BlockFit& fit)
  {
    std::array<double, 3> moments{};
    this->ForEachRow(
      [&](int y, int z)
      {
        const double* row = this->Row(y, z);
        double sum = 0.0;
        for (int x = 0; x < Width; ++x)
        {
          sum += row[x];
          moments[0] += (x - Middle) * row[x];
        }
        moments[1] += (y - Middle) * sum;
        moments[2] += (z - Middle) * sum;
      });
    constexpr int squares = Middle * (Middle + 1) * Width / 3 * Width * Width;
    for (int axis = 0; axis < 3; ++axis)
    {
      fit.Slopes[axis] = static_cast<float>(moments[axis] / squares);
    }
  }

  /** The range of the samples minus the slopes. */
  ValueRange Residuals(const BlockFit& fit)
  {
    ValueRange range{ Infinity, -Infinity };
    this->ForEachRow(
      [&](int y, int z)
      {
        const double* row = this->Row(y, z);
        const double start = fit.At({ 0, y, z });
        const double slope = fit.Slopes[0];
        for (int x = 0; x < Width; ++x)
        {
          const double rest = row[x] - (start + slope * x);
          range.Minimum = rest < range.Minimum ? rest : range.Minimum;
          range.Maximum = rest > range.Maximum ? rest : range.Maximum;
        }
      });
    return range;
  }

  Point Last{};
  bool IsFinite = true;
  ValueRange Range;
  std::array<double, Width * Width * Width> Values;
};

}

BlockFits::BlockFits(const std::array<int, 3>& dimensions, const SampleSlab& slab,
  const SliceRange& own, int levels, const ParallelFor& parallelFor)
{
  std::visit(
    [&](const auto& view)
    {
      for (int level = 0; level < levels; ++level)
      {
        this->AddLevel(
          dimensions, own,
          [&](const Point& block)
          {
            return level == 0 ? Block(dimensions, view, slab.First, Edge * block).Fit()
                              : this->Merge(level, block);
          },
          parallelFor);
      }
    },
    slab.Samples);
}

template <typename Fit>
void BlockFits::AddLevel(const std::array<int, 3>& dimensions, const SliceRange& own,
  const Fit& fit, const ParallelFor& parallelFor)
{
  Level level;
  const auto number = static_cast<int>(this->Levels.size());
  const auto blocksIn = [](int edges, int edge) { return (edges + edge - 1) / edge; };
  for (int axis = 0; axis < 3; ++axis)
  {
    level.Count[axis] = blocksIn(dimensions[axis] - 1, Edge << number);
  }
  // The finest blocks; and those that contain them.
  const int begin = blocksIn(own.Begin, Edge);
  const int end = std::min(blocksIn(own.End, Edge), blocksIn(dimensions[2] - 1, Edge));
  const bool isAny = begin < end;
  level.Slices = { begin >> number, isAny ? ((end - 1) >> number) + 1 : begin >> number };
  const int slices = level.Slices.End - level.Slices.Begin;
  level.Blocks.resize(std::size_t{ 1 } * level.Count[0] * level.Count[1] * slices);
  parallelFor(slices, 1,
    [&](std::int64_t first, std::int64_t last)
    {
      Point block{ 0, 0, level.Slices.Begin + static_cast<int>(first) };
      for (; block[2] < level.Slices.Begin + last; ++block[2])
      {
        for (block[1] = 0; block[1] < level.Count[1]; ++block[1])
        {
          for (block[0] = 0; block[0] < level.Count[0]; ++block[0])
          {
            level.Blocks[level.Index(block)] = fit(block);
          }
        }
      }
    });
  this->Levels.push_back(std::move(level));
}

/** A cube's fit from those of its eighths. */
BlockFit BlockFits::Merge(int level, const Point& block) const
{
  const Level& finer = this->Levels[level - 1];
  const int half = Edge << (level - 1);
  const Point middle{ half / 2, half / 2, half / 2 };
  BlockFit fit;
  fit.Range = { Infinity, -Infinity };
  std::array<const BlockFit*, 8> parts{};
  std::array<double, 3> slopes{};
  for (int i = 0; i < 8; ++i)
  {
    const Point side = { i & 1, (i >> 1) & 1, i >> 2 };
    const Point part = 2 * block + side;
    if (part[0] >= finer.Count[0] || part[1] >= finer.Count[1] || part[2] >= finer.Count[2])
    {
      continue;
    }
    if (!this->Has(level - 1, part[2]))
    {
      BlockFit unknown;
      unknown.Range = { -Infinity, Infinity };
      unknown.Residual = HUGE_VALF;
      return unknown;
    }
    parts[i] = &finer.Blocks[finer.Index(part)];
    fit.Range.Minimum = std::min(fit.Range.Minimum, parts[i]->Range.Minimum);
    fit.Range.Maximum = std::max(fit.Range.Maximum, parts[i]->Range.Maximum);
    const double value = parts[i]->At(middle);
    fit.Value += static_cast<float>(value / 8);
    for (int axis = 0; axis < 3; ++axis)
    {
      slopes[axis] += (side[axis] != 0 ? value : -value) / (4 * half);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    fit.Slopes[axis] = static_cast<float>(slopes[axis]);
    fit.Value -= half * fit.Slopes[axis]; // from the middle to the first corner
  }
  for (int i = 0; i < 8; ++i)
  {
    if (parts[i] != nullptr)
    {
      const Point first = { half * (i & 1), half * ((i >> 1) & 1), half * (i >> 2) };
      double apart = std::fabs(fit.At(first + middle) - parts[i]->At(middle));
      for (int axis = 0; axis < 3; ++axis)
      {
        apart += 0.5 * half * std::fabs(double{ fit.Slopes[axis] } - parts[i]->Slopes[axis]);
      }
      fit.Residual =
        std::max(fit.Residual, UpperFloat((parts[i]->Residual + apart) * (1.0 + 1e-9)));
    }
  }
  return fit;
}

}
