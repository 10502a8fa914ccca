// SPDX-License-Identifier: BSD-3-Clause
#include "EncodingBytes.h"

#include <algorithm>
#include <cstring>

using namespace isodiamond;

namespace fuzz
{
namespace
{

class Source
{
public:
  Source(const std::uint8_t* data, std::size_t size)
    : Next(data)
    , Left(size)
  {
  }

  template <typename T>
  void operator()(T& value)
  {
    value = T{};
    this->Copy(&value, std::min(sizeof(T), this->Left));
  }
  template <typename T>
  void operator()(std::vector<T>& values)
  {
    std::uint32_t count = 0;
    (*this)(count);
    values.resize(std::min<std::size_t>(count, this->Left / sizeof(T)));
    this->Copy(values.data(), values.size() * sizeof(T));
  }
  /** The type's index in AnyValues comes first. */
  void operator()(AnyValues& values)
  {
    std::uint8_t type = 0;
    (*this)(type);
    MakeOfType(type % std::variant_size_v<AnyValues>, values);
    std::visit([&](auto& some) { (*this)(some); }, values);
  }

private:
  template <std::size_t Index = 0>
  static void MakeOfType(std::size_t type, AnyValues& values)
  {
    if constexpr (Index < std::variant_size_v<AnyValues>)
    {
      if (type == Index)
      {
        values.emplace<Index>();
      }
      MakeOfType<Index + 1>(type, values);
    }
  }

  void Copy(void* to, std::size_t bytes)
  {
    if (bytes > 0)
    {
      std::memcpy(to, this->Next, bytes);
    }
    this->Next += bytes;
    this->Left -= bytes;
  }

  const std::uint8_t* Next;
  std::size_t Left;
};

class Sink
{
public:
  std::vector<std::uint8_t> Bytes;

  template <typename T>
  void operator()(const T& value)
  {
    this->Append(&value, sizeof(T));
  }
  template <typename T>
  void operator()(const std::vector<T>& values)
  {
    (*this)(static_cast<std::uint32_t>(values.size()));
    this->Append(values.data(), values.size() * sizeof(T));
  }
  void operator()(const AnyValues& values)
  {
    (*this)(static_cast<std::uint8_t>(values.index()));
    std::visit([&](const auto& some) { (*this)(some); }, values);
  }

private:
  void Append(const void* from, std::size_t bytes)
  {
    const auto* first = static_cast<const std::uint8_t*>(from);
    this->Bytes.insert(this->Bytes.end(), first, first + bytes);
  }
};

/** The parts of a header as plain numbers. */
struct Numbers
{
  std::uint8_t Kind = 0;
  std::uint8_t Metric = 0;
  std::uint8_t IsExact = 0;
  std::uint8_t IsVolume = 0;
  std::array<double, 2> Isorange{};
};

/** Visits everything in the order of the bytes. */
template <typename Visitor, typename Some>
void VisitAll(Visitor& visitor, Numbers& numbers, Some& arrays)
{
  visitor(numbers.Kind);
  visitor(numbers.Metric);
  visitor(numbers.IsExact);
  visitor(numbers.IsVolume);
  visitor(numbers.Isorange);
  auto& header = arrays.Isodiamonds.Header;
  visitor(header.Dimensions);
  visitor(header.ErrorScale);
  visitor(header.FieldScale);
  visitor(header.RelevantCount);
  visitor(arrays.Tolerance);
  visitor(arrays.InteriorTolerance);
  visitor(arrays.Region);
  auto& isodiamonds = arrays.Isodiamonds.Arrays;
  visitor(isodiamonds.BrickCounts);
  visitor(isodiamonds.BrickIndices);
  visitor(isodiamonds.BrickMasks);
  visitor(isodiamonds.Records);
  visitor(isodiamonds.Isovertices);
  visitor(isodiamonds.InteriorCodes);
  visitor(arrays.Isodiamonds.InsideValues);
  visitor(arrays.Errors);
  visitor(arrays.Samples);
  visitor(arrays.Minima);
  visitor(arrays.Maxima);
  visitor(isodiamonds.Followers);
}

}

Arrays Read(const std::uint8_t* data, std::size_t size)
{
  Source source(data, size);
  Numbers numbers;
  Arrays arrays;
  VisitAll(source, numbers, arrays);
  EncodingHeader& header = arrays.Isodiamonds.Header;
  header.TheModel = static_cast<Model>(numbers.Kind % 3);
  header.Metric = static_cast<ErrorMetric>(numbers.Metric % 2);
  header.ExactIsovertices = numbers.IsExact != 0;
  header.Region = numbers.IsVolume % 2 != 0 ? Isoregion(numbers.Isorange[0], numbers.Isorange[1])
                                            : Isoregion(numbers.Isorange[0]);
  return arrays;
}

std::vector<std::uint8_t> Write(const Arrays& arrays)
{
  const EncodingHeader& header = arrays.Isodiamonds.Header;
  Numbers numbers;
  numbers.Kind = static_cast<std::uint8_t>(header.TheModel);
  numbers.Metric = static_cast<std::uint8_t>(header.Metric);
  numbers.IsExact = header.ExactIsovertices ? 1 : 0;
  numbers.IsVolume = header.Region.IsVolume() ? 1 : 0;
  numbers.Isorange = { header.Region.Isovalue(0),
    header.Region.Isovalue(header.Region.SurfaceCount() - 1) };
  Sink sink;
  VisitAll(sink, numbers, arrays);
  return sink.Bytes;
}

}
