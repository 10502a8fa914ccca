// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/MeshDivision.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

MeshBlocks BlocksOf(
  const MeshToDivide& mesh, const std::vector<std::uint32_t>& some, std::size_t most, double cut)
{
  std::vector<Vector> middles;
  middles.reserve(some.size());
  for (const std::uint32_t triangle : some)
  {
    const auto [a, b, c] = mesh.Triangles[triangle];
    middles.push_back((1.0 / 3.0) * (mesh.Positions[a] + mesh.Positions[b] + mesh.Positions[c]));
  }
  MeshBlocks blocks = CutIntoBlocks(middles, most, cut);
  for (std::uint32_t& triangle : blocks.Order)
  {
    triangle = some[triangle]; // still ascending
  }
  return blocks;
}

/** The numbers that belong to each part. @param partOf (number) -> part, or None */
template <typename PartOf>
CellsAtPoints ByPart(std::size_t parts, std::size_t count, PartOf&& partOf)
{
  std::uint32_t part = None;
  return { parts, count,
    [&](std::size_t number) -> IdRange
    {
      part = partOf(static_cast<std::uint32_t>(number));
      return { &part, part == None ? &part : &part + 1 };
    } };
}

}

MeshDivision::MeshDivision(
  const MeshToDivide& mesh, const std::vector<std::uint32_t>& some, std::size_t most, double cut)
  : Triangles(BlocksOf(mesh, some, most, cut))
  , PartOf(mesh.Triangles.size(), None)
  , Number(mesh.Triangles.size())
  , IsHeld(mesh.Triangles.size())
  , OwnerOf(mesh.Near.Count())
  , OriginalNumber(mesh.Near.Count())
{
  const auto parts = static_cast<std::uint32_t>(this->Triangles.Count());
  for (std::uint32_t part = 0; part < parts; ++part)
  {
    const IdRange triangles = this->Triangles[part];
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      this->PartOf[triangles[i]] = part;
      this->Number[triangles[i]] = i;
    }
  }
  this->FindOwners(mesh.Near);
  this->Originals =
    ByPart(parts, this->OwnerOf.size(), [&](std::uint32_t i) { return this->OwnerOf[i]; });
  for (std::uint32_t part = 0; part < parts; ++part)
  {
    std::uint32_t number = 0;
    for (const std::uint32_t original : this->Originals[part])
    {
      this->OriginalNumber[original] = number++;
    }
  }
  this->Samples = ByPart(parts, mesh.Homes.size(),
    [&](std::uint32_t i)
    {
      const std::uint32_t home = mesh.Homes[i];
      return home == None ? None : this->PartOf[home];
    });
}

/** Original triangles that belong to more than one part, or partly to none, hold all that they are
 *  near to. */
void MeshDivision::FindOwners(const NearLists& near)
{
  for (std::size_t i = 0; i < this->OwnerOf.size(); ++i)
  {
    const IdRange triangles = near[i];
    std::uint32_t& owner = this->OwnerOf[i];
    owner = this->PartOf[*triangles.begin()];
    if (std::any_of(triangles.begin(), triangles.end(),
          [&](std::uint32_t triangle) { return this->PartOf[triangle] != owner; }))
    {
      owner = None;
      std::for_each(triangles.begin(), triangles.end(),
        [&](std::uint32_t triangle) { this->IsHeld[triangle] = true; });
    }
  }
}

}
