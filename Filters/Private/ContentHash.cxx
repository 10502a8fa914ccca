// SPDX-License-Identifier: BSD-3-Clause
#include "Private/ContentHash.h"

#include "Private/Arrays.h"
#include "Private/Threads.h"

#include <algorithm>
#include <cstring>

namespace vtkIsodiamond
{
namespace
{

constexpr std::int64_t BlockBytes = 1 << 16;

/** Every bit of the value comes to change every bit of the result (the finalizer of SplitMix64). */
std::uint64_t Mix(std::uint64_t value)
{
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

/** Two lanes of multiplication and rotation, with different factors. */
struct Lanes
{
  ContentHash State = { 0x9e3779b97f4a7c15U, 0xd1b54a32d192ed03U };

  void Add(std::uint64_t word)
  {
    this->State[0] = (this->State[0] ^ word) * 0xa0761d6478bd642fU;
    this->State[0] ^= this->State[0] >> 29;
    this->State[1] = (this->State[1] + word) * 0xe7037ed1a0b428dbU;
    this->State[1] ^= this->State[1] >> 32;
  }
  ContentHash Result() const { return { Mix(this->State[0]), Mix(this->State[1]) }; }
};

ContentHash HashOf(const char* bytes, std::int64_t count)
{
  Lanes lanes;
  std::int64_t at = 0;
  std::uint64_t word = 0;
  for (; at + 8 <= count; at += 8)
  {
    std::memcpy(&word, bytes + at, 8);
    lanes.Add(word);
  }
  word = 0;
  std::memcpy(&word, bytes + at, static_cast<std::size_t>(count - at));
  lanes.Add(word);
  return lanes.Result();
}

}

ContentHash HashOf(vtkDataArray* array)
{
  if (!array)
  {
    return {};
  }
  const vtkSmartPointer<vtkDataArray> row = InRow(array);
  const char* bytes = static_cast<const char*>(row->GetVoidPointer(0));
  const std::int64_t count = array->GetNumberOfValues() * array->GetDataTypeSize();
  std::vector<ContentHash> blocks((count + BlockBytes - 1) / BlockBytes);
  SMPFor()(static_cast<std::int64_t>(blocks.size()), 16,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t block = begin; block < end; ++block)
      {
        const std::int64_t first = block * BlockBytes;
        blocks[block] = HashOf(bytes + first, std::min(BlockBytes, count - first));
      }
    });
  Lanes lanes;
  lanes.Add(static_cast<std::uint64_t>(array->GetDataType()));
  lanes.Add(static_cast<std::uint64_t>(array->GetNumberOfComponents()));
  lanes.Add(static_cast<std::uint64_t>(count));
  for (const ContentHash& block : blocks)
  {
    lanes.Add(block[0]);
    lanes.Add(block[1]);
  }
  return lanes.Result();
}

ContentHash ContentHashes::Of(vtkDataArray* array)
{
  if (!array)
  {
    return {};
  }
  this->All.erase(std::remove_if(this->All.begin(), this->All.end(),
                    [](const Known& known) { return known.Array == nullptr; }),
    this->All.end());
  for (Known& known : this->All)
  {
    if (known.Array == array)
    {
      if (known.Time != array->GetMTime())
      {
        known.Hash = HashOf(array);
        known.Time = array->GetMTime();
      }
      return known.Hash;
    }
  }
  this->All.push_back({ array, array->GetMTime(), HashOf(array) });
  return this->All.back().Hash;
}

}
