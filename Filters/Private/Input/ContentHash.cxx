// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Input/ContentHash.h"

#include "Private/Common/Arrays.h"
#include "Private/Common/Threads.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <xxhash.h>

namespace vtkIsodiamond
{
namespace
{

constexpr std::int64_t BlockBytes = 1 << 16;

ContentHash HashOf(const void* bytes, std::int64_t count)
{
  const XXH128_hash_t hash = XXH3_128bits(bytes, static_cast<std::size_t>(count));
  return { hash.low64, hash.high64 };
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
  const std::int64_t blocks = (count + BlockBytes - 1) / BlockBytes;
  std::vector<ContentHash> parts(blocks);
  SMPFor()(blocks, 16,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t block = begin; block < end; ++block)
      {
        const std::int64_t first = block * BlockBytes;
        parts[block] = HashOf(bytes + first, std::min(BlockBytes, count - first));
      }
    });
  parts.push_back({ static_cast<std::uint64_t>(array->GetDataType()),
    static_cast<std::uint64_t>(array->GetNumberOfComponents()) });
  parts.push_back({ static_cast<std::uint64_t>(count) });
  return HashOf(parts.data(), static_cast<std::int64_t>(parts.size() * sizeof(ContentHash)));
}

ContentHash ContentHashes::Of(vtkDataArray* array, vtkDataSet* grid)
{
  if (!array)
  {
    return {};
  }
  const vtkMTimeType time =
    std::max({ array->GetMTime(), grid->GetMTime(), grid->GetUpdateTime() });
  this->All.erase(std::remove_if(this->All.begin(), this->All.end(),
                    [](const Known& known) { return known.Array == nullptr; }),
    this->All.end());
  for (Known& known : this->All)
  {
    if (known.Array == array)
    {
      if (known.Time != time)
      {
        known.Hash = HashOf(array);
        known.Time = time;
      }
      return known.Hash;
    }
  }
  this->All.push_back({ array, time, HashOf(array) });
  return this->All.back().Hash;
}

}
