// SPDX-License-Identifier: BSD-3-Clause
#include "RefinedSet.h"

namespace isodiamond
{

RefinedSet::RefinedSet(const IsodiamondHierarchy& hierarchy, double tolerance,
  const ParallelFor& parallelFor, double interiorTolerance)
  : Source(hierarchy)
  , Masks(hierarchy.Diamonds().ScaleCount())
{
  const ErrorCode::Type accepted = hierarchy.Codes().Accepted(tolerance);
  const ErrorCode::Type acceptedInside = hierarchy.Codes().Accepted(interiorTolerance);
  const bool interior = hierarchy.RefinesInterior() && acceptedInside < ErrorCode::Always - 1;
  const bool all = accepted < ErrorCode::Least && !hierarchy.RefinesInterior();
  for (int scale = 0; scale < hierarchy.Diamonds().ScaleCount(); ++scale)
  {
    const std::vector<Brick>& bricks = hierarchy.Diamonds().Level(scale).Bricks;
    this->Masks[scale].resize(bricks.size());
    parallelFor(static_cast<std::int64_t>(bricks.size()), 64,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          BrickMask& mask = this->Masks[scale][i];
          mask = bricks[i].Occupancy;
          if (all)
          {
            continue; // full resolution
          }
          std::uint32_t rank = bricks[i].First;
          for (std::uint64_t& word : mask)
          {
            std::uint64_t kept = 0;
            ForEachBit(word,
              [&](int bit)
              {
                const bool above = hierarchy.Threshold(rank) > accepted ||
                  (interior && hierarchy.InteriorThreshold(rank) > acceptedInside);
                kept |= static_cast<std::uint64_t>(above) << bit;
                ++rank;
              });
            word = kept;
          }
        }
      });
  }
}

std::int64_t RefinedSet::Count() const
{
  std::int64_t count = 0;
  for (int scale = 0; scale < this->Source.Domain().Depth(); ++scale)
  {
    for (const BrickMask& mask : this->Masks[scale])
    {
      for (const std::uint64_t word : mask)
      {
        count += PopCount(word);
      }
    }
  }
  return count;
}

}
