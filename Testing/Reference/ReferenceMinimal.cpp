// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceMinimal.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace reference
{

namespace
{

/** The known signs among a tetrahedron's vertices. */
std::set<int> KnownSigns(const Tetrahedron& tetrahedron, const VertexSigns& signs)
{
  std::set<int> known;
  for (const Point& vertex : tetrahedron.Vertices)
  {
    const auto found = signs.find(vertex);
    if (found != signs.end())
    {
      known.insert(found->second);
    }
  }
  return known;
}

}

MinimalHierarchy::MinimalHierarchy(
  const Hierarchy& hierarchy, const Encoding& encoding, const std::vector<double>& thresholds)
  : Geometry(hierarchy)
  , CornerSigns(encoding.BaseSigns)
{
  const auto add = [&](const std::vector<Record>& records, bool isCreation)
  {
    for (const Record& record : records)
    {
      const int index = hierarchy.Find({ record.Center[0], record.Center[1], record.Center[2] });
      this->Entries[index] = { record.Sign(), thresholds.at(index), isCreation };
    }
  };
  add(encoding.Active, false);
  add(encoding.Creation, true);
}

MinimalRefinement MinimalHierarchy::Refine(double tolerance) const
{
  MinimalRefinement refinement;
  refinement.Subdivided.assign(this->Geometry.Size(), false);
  refinement.Front.assign(this->Geometry.Size(), false);

  // What has been reached so far, with the vertex signs known so far. Indices ascend with depth, so
  // the smallest unvisited one has been reached from all its parents that are ever subdivided.
  std::map<int, VertexSigns> reached;
  for (const auto& [index, entry] : this->Entries)
  {
    if (entry.IsCreation)
    {
      reached[index] = this->CreationSigns(index);
    }
  }
  if (this->Entries.count(0) != 0 && !this->Entries.at(0).IsCreation)
  {
    reached[0] = this->BaseSigns();
  }

  for (auto next = reached.begin(); next != reached.end(); ++next)
  {
    const int index = next->first;
    const Entry& entry = this->Entries.at(index);
    if (entry.Threshold > tolerance)
    {
      VertexSigns signs = next->second;
      this->Complete(index, signs);
      refinement.Subdivided[index] = true;
      refinement.Signs[index] = signs;
      this->FollowArcs(index, signs, reached);
    }
    else if (!entry.IsCreation)
    {
      refinement.Front[index] = true;
    }
  }

  for (const auto& [index, vertexSigns] : refinement.Signs)
  {
    VertexSigns signs = vertexSigns;
    signs[this->Geometry.At(index).Center] = this->Entries.at(index).CenterSign;
    for (const Tetrahedron& tetrahedron : this->Geometry.At(index).Tetrahedra)
    {
      for (const Tetrahedron& half : Hierarchy::Bisect(tetrahedron))
      {
        this->AddPatches(half, signs, refinement.Subdivided, refinement.Patches);
      }
    }
  }
  if (!refinement.Subdivided[0])
  {
    for (const Tetrahedron& tetrahedron : this->Geometry.BaseTetrahedra())
    {
      this->AddPatches(tetrahedron, this->BaseSigns(), refinement.Subdivided, refinement.Patches);
    }
  }
  std::sort(refinement.Patches.begin(), refinement.Patches.end());
  return refinement;
}

VertexSigns MinimalHierarchy::BaseSigns() const
{
  VertexSigns signs;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int size = this->Geometry.BaseSize();
    const Point position{ (corner & 1) * size, (corner >> 1 & 1) * size, (corner >> 2) * size };
    if (this->Geometry.IsSampled(position))
    {
      signs[position] = this->CornerSigns >> corner & 1;
    }
  }
  return signs;
}

VertexSigns MinimalHierarchy::CreationSigns(int index) const
{
  VertexSigns signs;
  for (const Point& vertex : this->Geometry.At(index).Vertices)
  {
    if (this->Geometry.IsSampled(vertex))
    {
      signs[vertex] = 1 - this->Entries.at(index).CenterSign;
    }
  }
  return signs;
}

void MinimalHierarchy::Complete(int index, VertexSigns& signs) const
{
  const std::vector<Tetrahedron>& tetrahedra = this->Geometry.At(index).Tetrahedra;
  bool hasChanged = true;
  while (hasChanged)
  {
    hasChanged = false;
    for (const Tetrahedron& tetrahedron : tetrahedra)
    {
      const std::set<int> known = KnownSigns(tetrahedron, signs);
      for (const Point& vertex : tetrahedron.Vertices)
      {
        if (!known.empty() && this->Geometry.IsSampled(vertex) && signs.count(vertex) == 0)
        {
          if (known.size() != 1)
          {
            throw std::logic_error("a duet that is not active has vertices of two signs");
          }
          signs[vertex] = *known.begin();
          hasChanged = true;
        }
      }
    }
  }
}

void MinimalHierarchy::FollowArcs(
  int index, const VertexSigns& signs, std::map<int, VertexSigns>& reached) const
{
  const Diamond& diamond = this->Geometry.At(index);
  VertexSigns allSigns = signs;
  if (this->Geometry.IsSampled(diamond.Center))
  {
    allSigns[diamond.Center] = this->Entries.at(index).CenterSign;
  }

  for (const int child : diamond.Children)
  {
    const auto entry = this->Entries.find(child);
    if (entry == this->Entries.end() || entry->second.IsCreation)
    {
      continue;
    }
    VertexSigns duetSigns;
    bool isActive = false;
    const Diamond& childDiamond = this->Geometry.At(child);
    for (std::size_t i = 0; i < childDiamond.Tetrahedra.size(); ++i)
    {
      if (childDiamond.Origins[i] == index)
      {
        const Tetrahedron& tetrahedron = childDiamond.Tetrahedra[i];
        isActive = isActive || KnownSigns(tetrahedron, allSigns).size() == 2;
        for (const Point& vertex : tetrahedron.Vertices)
        {
          if (this->Geometry.IsSampled(vertex))
          {
            duetSigns[vertex] = allSigns.at(vertex);
          }
        }
      }
    }
    if (isActive)
    {
      reached[child].insert(duetSigns.begin(), duetSigns.end());
    }
  }
}

void MinimalHierarchy::AddPatches(const Tetrahedron& leaf, const VertexSigns& signs,
  const DiamondSet& subdivided, std::vector<Patch>& patches) const
{
  const int diamond = this->Geometry.DiamondOf(leaf);
  if (!this->Geometry.BelongsToGrid(leaf) || (diamond >= 0 && subdivided[diamond]))
  {
    return;
  }
  std::array<int, 4> leafSigns;
  for (int i = 0; i < 4; ++i)
  {
    if (!this->Geometry.IsSampled(leaf.Vertices[i]))
    {
      return;
    }
    leafSigns[i] = signs.at(leaf.Vertices[i]);
  }
  const Patch patch = PatchOf(this->Geometry, leaf, leafSigns);
  if (!patch.Corners.empty())
  {
    patches.push_back(patch);
  }
}

}
