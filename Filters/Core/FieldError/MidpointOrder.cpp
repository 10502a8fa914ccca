// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError/MidpointOrder.h"

#include "Lattice/KuhnTetrahedron.h"

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

/** Lists the points that bisection reaches. */
class MidpointOrder::Builder
{
public:
  struct Corner
  {
    Point Position{};
    std::uint16_t Index = 0;
  };

  Builder(int scale, std::vector<Entry>& entries)
    : Half(1 << scale)
    , Entries(entries)
    , Found((2 * Half + 1) * (2 * Half + 1) * (2 * Half + 1), None)
  {
  }

  Corner Add(const Point& point, const std::array<std::uint16_t, 2>& ends)
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
    return { point, index };
  }

  Corner AddMiddle(const Corner& a, const Corner& b)
  {
    return this->Add(MiddleOf(a.Position, b.Position), { a.Index, b.Index });
  }

  /** Cuts a path down to edges of length 1. */
  void Cut(const KuhnTetrahedron<Corner>& path, int edge)
  {
    if (edge > 1)
    {
      ForEachEighth(
        path, [&](const Corner& a, const Corner& b) { return this->AddMiddle(a, b); },
        [&](const KuhnTetrahedron<Corner>& eighth) { this->Cut(eighth, edge / 2); });
    }
  }

private:
  int Half;
  std::vector<Entry>& Entries;
  std::vector<std::uint16_t> Found;
};

MidpointOrder::MidpointOrder(const TypeTable& type, int scale)
  : Vertices(type.VertexCount)
{
  using Corner = Builder::Corner;
  Builder builder(scale, this->List);
  std::array<Corner, MaximumVertices> vertices;
  for (int i = 0; i < type.VertexCount; ++i)
  {
    vertices[i] = builder.Add((1 << scale) * type.Offsets[i], {});
  }
  CutIntoPaths(
    type, vertices, [&](const Corner& a, const Corner& b) { return builder.AddMiddle(a, b); },
    [&](const KuhnTetrahedron<Corner>& path) { builder.Cut(path, 1 << scale); });
}

int MidpointOrder::NumberOf(const Place& place)
{
  return 64 * place.Scale + TypeWithSpine(TypeOf(place.Position));
}

const MidpointOrder& MidpointOrder::Of(int number)
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
  return orders[number];
}

}
