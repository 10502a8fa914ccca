// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRecords.h"

#include <algorithm>
#include <stdexcept>

namespace reference
{

namespace
{

/** The sign of a vertex, or 0 if it has no sample. */
int SignAt(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue, const Point& vertex)
{
  return hierarchy.IsSampled(vertex) ? SignOf(field.At(vertex), isovalue) : 0;
}

bool IsCut(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue, const Isovertex& isovertex)
{
  return hierarchy.IsSampled(isovertex.Younger) && hierarchy.IsSampled(isovertex.Older) &&
    SignOf(field.At(isovertex.Younger), isovalue) != SignOf(field.At(isovertex.Older), isovalue);
}

/** The diamonds of one kind, sorted by depth, then in grid order of their central vertices. */
std::vector<int> SortedDiamonds(
  const Hierarchy& hierarchy, const std::vector<Kind>& kinds, Kind kind)
{
  std::vector<int> indices;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    if (kinds[index] == kind)
    {
      indices.push_back(index);
    }
  }
  std::sort(indices.begin(), indices.end(),
    [&hierarchy](int a, int b)
    {
      const Diamond& first = hierarchy.At(a);
      const Diamond& second = hierarchy.At(b);
      return first.Depth != second.Depth ? first.Depth < second.Depth
                                         : InGridOrder(first.Center, second.Center);
    });
  return indices;
}

}

std::size_t Encoding::Bytes() const
{
  return 2 + 12 * (this->Active.size() + this->Creation.size() + this->Relevant.size()) +
    this->Isovertices.size();
}

std::vector<Isovertex> OwnIsovertices(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue, int diamond)
{
  std::vector<Isovertex> isovertices;
  for (const Point& vertex : hierarchy.At(diamond).Vertices)
  {
    const Isovertex isovertex{ hierarchy.At(diamond).Center, vertex };
    if (IsCut(hierarchy, field, isovalue, isovertex))
    {
      isovertices.push_back(isovertex);
    }
  }
  return isovertices;
}

std::vector<Isovertex> BaseIsovertices(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue)
{
  std::vector<Isovertex> isovertices;
  for (const std::array<Point, 2>& edge : hierarchy.BaseEdges())
  {
    const Isovertex isovertex{ edge[0], edge[1] };
    if (IsCut(hierarchy, field, isovalue, isovertex))
    {
      isovertices.push_back(isovertex);
    }
  }
  return isovertices;
}

Encoding Encode(const Hierarchy& hierarchy, const ScalarField& field, double isovalue,
  const std::vector<Kind>& kinds, const std::vector<std::uint16_t>& errorCodes, Model model)
{
  if (hierarchy.BaseSize() > 0x8000)
  {
    throw std::invalid_argument("coordinates exceed the records' 16 bits");
  }

  Encoding encoding;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int size = hierarchy.BaseSize();
    const Point position{ (corner & 1) * size, (corner >> 1 & 1) * size, (corner >> 2) * size };
    const int sign = SignAt(hierarchy, field, isovalue, position);
    encoding.BaseSigns = static_cast<std::uint16_t>(encoding.BaseSigns | sign << corner);
  }

  const auto encode = [&](Kind kind, std::vector<Record>& records)
  {
    for (const int index : SortedDiamonds(hierarchy, kinds, kind))
    {
      const Point& center = hierarchy.At(index).Center;
      Record record;
      for (int axis = 0; axis < 3; ++axis)
      {
        record.Center[axis] = static_cast<std::uint16_t>(center[axis]);
      }
      const int sign = SignAt(hierarchy, field, isovalue, center);
      record.SignAndError = static_cast<std::uint16_t>(sign << 14 | (errorCodes[index] & 0x3fff));
      record.FirstIsovertex = static_cast<std::uint32_t>(encoding.Isovertices.size());
      records.push_back(record);
      for (const Isovertex& isovertex : OwnIsovertices(hierarchy, field, isovalue, index))
      {
        encoding.Isovertices.push_back(
          static_cast<std::uint8_t>(Coefficient(field, isovalue, isovertex)));
      }
    }
  };
  encode(Kind::Active, encoding.Active);
  encode(Kind::Creation, encoding.Creation);
  if (model == Model::Relevant)
  {
    encode(Kind::Relevant, encoding.Relevant);
  }
  return encoding;
}

}
