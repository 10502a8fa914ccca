// SPDX-License-Identifier: BSD-3-Clause
// Changes to hierarchies that libFuzzer would not find: one number here and there.
#include "EncodingBytes.h"

#include <algorithm>
#include <cstring>
#include <random>
#include <stdexcept>

using namespace isodiamond;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace
{

/** Makes the lengths fit what masks and signs imply, as far as that is easy to tell. */
void FitLengths(Encoding& encoding)
{
  std::size_t diamonds = 0;
  for (const std::uint64_t mask : encoding.Arrays.BrickMasks)
  {
    diamonds += PopCount(mask);
  }
  encoding.Arrays.Records.resize(diamonds, Record::Pack(ErrorCode::Always, 0));
  if (!encoding.Arrays.InteriorCodes.empty())
  {
    encoding.Arrays.InteriorCodes.resize(diamonds);
  }
  const auto inside = std::count_if(encoding.Arrays.Records.begin(), encoding.Arrays.Records.end(),
    [](std::uint16_t record) { return Record::Sign(record) == InsideSign; });
  std::visit([&](auto& values) { values.resize(encoding.Header.Region.IsVolume() ? inside : 0); },
    encoding.InsideValues);
}

template <typename T>
void ChangeOne(std::vector<T>& values, std::minstd_rand& random)
{
  if (!values.empty())
  {
    T& value = values[random() % values.size()];
    value = static_cast<T>(
      random() % 2 == 0 ? value ^ (T{ 1 } << (random() % (8 * sizeof(T)))) : T(random()));
  }
}

}

/** Random bytes are seldom a hierarchy: most changes are of one number, and lengths may follow. */
extern "C" std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
  std::minstd_rand random(seed);
  if (random() % 4 == 0)
  {
    return LLVMFuzzerMutate(data, size, most);
  }
  try
  {
    fuzz::Arrays arrays = fuzz::Read(data, size);
    auto& isodiamonds = arrays.Isodiamonds.Arrays;
    switch (random() % 8)
    {
      case 0:
        ChangeOne(isodiamonds.BrickCounts, random);
        break;
      case 1:
        ChangeOne(isodiamonds.BrickIndices, random);
        break;
      case 2:
        ChangeOne(isodiamonds.BrickMasks, random);
        break;
      case 3:
        ChangeOne(isodiamonds.Isovertices, random);
        break;
      case 4:
        isodiamonds.Isovertices.resize(isodiamonds.Isovertices.size() + random() % 9, 100);
        break;
      case 5:
        isodiamonds.Isovertices.resize(
          isodiamonds.Isovertices.size() - std::min(isodiamonds.Isovertices.size(), random() % 9));
        break;
      case 6:
        ChangeOne(isodiamonds.InteriorCodes, random);
        ChangeOne(isodiamonds.Followers, random);
        ChangeOne(arrays.Errors, random);
        break;
      default:
        ChangeOne(isodiamonds.Records, random);
    }
    if (random() % 2 == 0)
    {
      FitLengths(arrays.Isodiamonds);
    }
    const std::vector<std::uint8_t> bytes = fuzz::Write(arrays);
    if (bytes.size() <= most)
    {
      std::memcpy(data, bytes.data(), bytes.size());
      return bytes.size();
    }
  }
  catch (const std::invalid_argument&) // no such isorange
  {
  }
  return LLVMFuzzerMutate(data, size, most);
}
