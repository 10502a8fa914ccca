// SPDX-License-Identifier: BSD-3-Clause
#include "Field/HiddenCells.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

std::int64_t IndexOf(const std::array<int, 3>& size, const Point& at)
{
  return (std::int64_t{ at[2] } * size[1] + at[1]) * size[0] + at[0];
}

}

HiddenCells::HiddenCells(std::vector<std::uint8_t> hidden, const std::array<int, 3>& cells)
{
  if (std::none_of(hidden.begin(), hidden.end(), [](std::uint8_t is) { return is != 0; }))
  {
    return;
  }
  this->Levels.push_back({ std::move(hidden), cells });
  while (*std::max_element(this->Levels.back().Size.begin(), this->Levels.back().Size.end()) > 1)
  {
    const Level& fine = this->Levels.back();
    Level coarse;
    for (int axis = 0; axis < 3; ++axis)
    {
      coarse.Size[axis] = (fine.Size[axis] + 1) / 2;
    }
    coarse.Hidden.resize(IndexOf(coarse.Size, { 0, 0, coarse.Size[2] }));
    for (int z = 0; z < fine.Size[2]; ++z)
    {
      for (int y = 0; y < fine.Size[1]; ++y)
      {
        for (int x = 0; x < fine.Size[0]; ++x)
        {
          coarse.Hidden[IndexOf(coarse.Size, { x / 2, y / 2, z / 2 })] |=
            fine.Hidden[IndexOf(fine.Size, { x, y, z })];
        }
      }
    }
    this->Levels.push_back(std::move(coarse));
  }
}

bool HiddenCells::At(int scale, const Point& block) const
{
  if (!this->Any())
  {
    return false;
  }
  // Beyond the top of the pyramid there is only its one block.
  const int last = static_cast<int>(this->Levels.size()) - 1;
  const Level& level = this->Levels[std::min(scale, last)];
  Point at{};
  for (int axis = 0; axis < 3; ++axis)
  {
    at[axis] = block[axis] * (1 << std::max(scale - last, 0));
    if (at[axis] < 0 || at[axis] >= level.Size[axis])
    {
      return false;
    }
  }
  return level.Hidden[IndexOf(level.Size, at)] != 0;
}

bool HiddenCells::Touch(const Place& place) const
{
  // The box is two blocks wide around the centre on every axis.
  for (int corner = 0; corner < 8; ++corner)
  {
    if (this->At(place.Scale,
          place.Position + Point{ -(corner & 1), -((corner >> 1) & 1), -((corner >> 2) & 1) }))
    {
      return true;
    }
  }
  return false;
}

}
