// SPDX-License-Identifier: BSD-3-Clause
#include "MidpointOrder.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

constexpr std::uint16_t None = 0xffff;

/** The first type with the same tetrahedra: the spine may point in either direction. */
int TypeWithSpine(int type)
{
  const int parity = type & 7;
  const int highBits = (type >> 3) & parity;
  return parity | (std::min(highBits, parity & ~highBits) << 3);
}

}

/** Bisects tetrahedra down to the lattice and lists the points that it meets. */
class MidpointOrder::Builder
{
public:
  Builder(int scale, std::vector<Entry>& entries)
    : Half(1 << scale)
    , Entries(entries)
    , Found((2 * Half + 1) * (2 * Half + 1) * (2 * Half + 1), None)
  {
  }

  std::uint16_t Add(const Point& point, const std::array<std::uint16_t, 2>& ends)
  {
    const int width = 2 * this->Half + 1;
    std::uint16_t& index =
      this->Found[((point[2] + this->Half) * width + point[1] + this->Half) * width + point[0] +
        this->Half];
    if (index == None)
    {
      index = static_cast<std::uint16_t>(this->Entries.size());
      this->Entries.push_back(
        { { static_cast<std::int8_t>(point[0]), static_cast<std::int8_t>(point[1]),
            static_cast<std::int8_t>(point[2]) },
          ends });
    }
    return index;
  }

  /** Adds the middle of the longest edge, and so on in both halves. */
  void Bisect(const std::array<std::uint16_t, 4>& corners)
  {
    std::array<int, 2> longest = { 0, 1 };
    for (const std::array<int, 2>& edge : TetrahedronEdges)
    {
      longest = this->Length(corners, edge) > this->Length(corners, longest) ? edge : longest;
    }
    const std::array<std::uint16_t, 2> ends = { corners[longest[0]], corners[longest[1]] };
    const Point sum = this->At(ends[0]) + this->At(ends[1]);
    if (Parity(sum) != 0)
    {
      return; // the middle is no lattice point, nor is that of a shorter edge
    }
    const std::uint16_t middle = this->Add({ sum[0] / 2, sum[1] / 2, sum[2] / 2 }, ends);
    for (const int end : longest)
    {
      std::array<std::uint16_t, 4> half = corners;
      half[end] = middle;
      this->Bisect(half);
    }
  }

private:
  int Length(const std::array<std::uint16_t, 4>& corners, const std::array<int, 2>& edge) const
  {
    return tables::SquaredLength(this->At(corners[edge[0]]), this->At(corners[edge[1]]));
  }

  Point At(std::uint16_t index) const
  {
    const std::array<std::int8_t, 3>& offset = this->Entries[index].Offset;
    return { offset[0], offset[1], offset[2] };
  }

  int Half;
  std::vector<Entry>& Entries;
  std::vector<std::uint16_t> Found;
};

MidpointOrder::MidpointOrder(const TypeTable& type, int scale)
  : Vertices(type.VertexCount)
{
  Builder builder(scale, this->List);
  for (int i = 0; i < type.VertexCount; ++i)
  {
    builder.Add((1 << scale) * type.Offsets[i], {});
  }
  const std::uint16_t centre = builder.Add({ 0, 0, 0 }, { type.Spine[0], type.Spine[1] });
  for (int i = 0; i < type.HalfTetrahedronCount; ++i)
  {
    const std::array<std::uint8_t, 3>& v = type.HalfTetrahedra[i].Vertices;
    builder.Bisect({ centre, v[0], v[1], v[2] });
  }
}

const MidpointOrder& MidpointOrder::Of(const Place& place)
{
  static const std::vector<MidpointOrder> orders = []
  {
    std::vector<MidpointOrder> all;
    for (int scale = 0; scale <= MaximumScale; ++scale)
    {
      for (int type = 0; type < 64; ++type)
      {
        const bool isNeeded = tables::Types[type].Valid && TypeWithSpine(type) == type;
        all.push_back(isNeeded ? MidpointOrder(tables::Types[type], scale) : MidpointOrder());
      }
    }
    return all;
  }();
  return orders[64 * place.Scale + TypeWithSpine(TypeOf(place.Position))];
}

}
