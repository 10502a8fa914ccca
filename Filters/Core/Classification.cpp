// SPDX-License-Identifier: BSD-3-Clause
#include "Classification.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** The signs of a brick and of one layer around it. */
struct SignBlock
{
  std::array<std::array<SignLattice::Row, 10>, 10> Rows; ///< [z + 1][y + 1]
  bool Mixed = false;

  SignBlock(const SignLattice& signs, int scale, const Point& origin)
  {
    std::uint32_t above = 0;
    std::uint32_t below = 0;
    for (int z = 0; z < 10; ++z)
    {
      for (int y = 0; y < 10; ++y)
      {
        const SignLattice::Row row =
          signs.Load(scale, origin[0], origin[1] + y - 1, origin[2] + z - 1);
        this->Rows[z][y] = row;
        above |= row.Signs;
        below |= row.Sampled & ~row.Signs;
      }
    }
    this->Mixed = above != 0 && below != 0;
  }
};

struct ClassifiedBrick
{
  std::int64_t Index = 0;
  BrickMask Active{};
  BrickMask Creation{};
};

/** Classifies eight positions of a row at once; parity says which of y and z are odd. */
void ClassifyRow(
  const SignBlock& block, int y, int z, std::uint64_t& active, std::uint64_t& creation)
{
  for (int oddX = 0; oddX < 2; ++oddX)
  {
    const ParityTable& shape = tables::Parities[oddX | ((y & 1) << 1) | ((z & 1) << 2)];
    std::uint32_t above = 0;
    std::uint32_t below = 0;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      const Point& offset = shape.Offsets[i];
      const SignLattice::Row& row = block.Rows[z + 1 + offset[2]][y + 1 + offset[1]];
      above |= row.Signs >> (1 + offset[0]);
      below |= (row.Sampled & ~row.Signs) >> (1 + offset[0]);
    }
    const SignLattice::Row& centre = block.Rows[z + 1][y + 1];
    const std::uint32_t centreAbove = centre.Signs >> 1;
    const std::uint32_t centreBelow = (centre.Sampled & ~centre.Signs) >> 1;
    const std::uint32_t positions = oddX != 0 ? 0xaaU : 0x55U;
    active |= above & below & positions;
    creation |= ((centreAbove & below & ~above) | (centreBelow & above & ~below)) & positions;
  }
}

/** Appends the brick if it holds an active or creation diamond. */
void ClassifyBrick(const Grid& grid, const SignLattice& signs, int scale, const BrickBox& box,
  std::int64_t index, std::vector<ClassifiedBrick>& result)
{
  const Point origin = box.Origin(index);
  const SignBlock block(signs, scale, origin);
  if (!block.Mixed)
  {
    return;
  }
  // The last bricks reach past the positions that diamonds can have.
  const std::array<int, 3> count = grid.Positions(scale);
  const int width = std::min(8, count[0] - origin[0]);
  const std::uint64_t valid = (std::uint64_t{ 1 } << width) - 1;
  ClassifiedBrick brick;
  brick.Index = index;
  std::uint64_t any = 0;
  for (int z = 0; z < std::min(8, count[2] - origin[2]); ++z)
  {
    for (int y = 0; y < std::min(8, count[1] - origin[1]); ++y)
    {
      std::uint64_t active = 0;
      std::uint64_t creation = 0;
      ClassifyRow(block, y, z, active, creation);
      brick.Active[z] |= (active & valid) << (8 * y);
      brick.Creation[z] |= (creation & valid) << (8 * y);
      any |= brick.Active[z] | brick.Creation[z];
    }
  }
  if (any != 0)
  {
    result.push_back(brick);
  }
}

/** Adds all ancestors, from the finest scale and the youngest class upward. */
void CloseOverParents(const Grid& grid, DiamondMask& members)
{
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (int diamondClass = 2; diamondClass >= 0; --diamondClass)
    {
      members.ForEachOfScale(scale,
        [&](const Place& place)
        {
          const TypeTable& shape = ShapeOf(place.Position);
          for (int i = 0; shape.DiamondClass == diamondClass && i < shape.ParentCount; ++i)
          {
            const Place parent = ParentPlace(shape, place, i);
            if (parent.Scale < grid.Depth() && grid.IsValid(parent.Position, parent.Scale))
            {
              members.Insert(parent);
            }
          }
        });
    }
  }
}

}

Classification Classify(const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor)
{
  Classification result{ DiamondMask(grid), DiamondMask(grid), DiamondMask(grid) };
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    // Rows of bricks are independent; each collects its own list.
    const BrickBox& box = result.Active.Box(scale);
    const std::int64_t rows = std::int64_t{ 1 } * box.Count[1] * box.Count[2];
    std::vector<std::vector<ClassifiedBrick>> found(rows);
    parallelFor(rows, 4,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t index = begin * box.Count[0]; index < end * box.Count[0]; ++index)
        {
          ClassifyBrick(grid, signs, scale, box, index, found[index / box.Count[0]]);
        }
      });
    for (const std::vector<ClassifiedBrick>& row : found)
    {
      for (const ClassifiedBrick& brick : row)
      {
        result.Active.Insert(scale, brick.Index, brick.Active);
        result.Creation.Insert(scale, brick.Index, brick.Creation);
        result.Members.Insert(scale, brick.Index, brick.Active);
        result.Members.Insert(scale, brick.Index, brick.Creation);
      }
    }
  }
  CloseOverParents(grid, result.Members);
  return result;
}

}
