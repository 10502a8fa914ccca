// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/PartDistance.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isodiamond
{

PartDistance::PartDistance(MeshPart& part)
  : Part(part)
  , Links(part.Original.Mesh)
  , Cover(part.Original.Mesh, this->Links)
{
}

/** Of one mesh. */
class PartDistance::Comparison
{
public:
  Comparison(PartDistance& all, const TriangleMesh& simple,
    const std::vector<std::uint32_t>& numbers, const std::vector<bool>& isTouched)
    : Part(all.Part)
    , Links(all.Links)
    , Cover(all.Cover)
    , Simple(simple)
    , Numbers(numbers)
    , IsTouched(isTouched)
    , SimpleLinks(simple)
    , SimpleCover(simple, this->SimpleLinks)
  {
  }

  Faults Run()
  {
    for (std::uint32_t i = 0; i < this->Simple.Triangles.size(); ++i)
    {
      if (this->IsTouched[this->Numbers[i]] && !this->IsNearBack(i))
      {
        this->Found.Triangles.push_back(this->Numbers[i]);
      }
    }
    this->GoForth();
    return std::move(this->Found);
  }

private:
  static constexpr std::uint32_t None = Connectivity::None;

  /** Whether a triangle of the simpler mesh is near to the original, and faces as that does. */
  bool IsNearBack(std::uint32_t simple)
  {
    const Triangle& points = this->Simple.Triangles[simple];
    const Vector middle = this->Simple.Middle(simple);
    const auto used = std::find_if(
      points.begin(), points.end(), [&](std::uint32_t point) { return this->Links.IsUsed(point); });
    if (used == points.end())
    {
      return false;
    }
    const std::uint32_t start = this->Cover.NearestAt(*used, middle);
    Vector mean{}; // of the normals
    const bool isNear =
      this->Cover.Covers(this->Simple.Corners(simple), start, this->Part.Original.Allowances[start],
        [&](std::uint32_t original, const Vector* corners, int count)
        {
          const double allowance = this->Part.Original.Allowances[original];
          const bool isSo = this->Cover.IsNear(original, corners, count, allowance);
          if (isSo)
          {
            mean = mean + Covering::AreaOf(corners, count) * this->Cover.Normal(original);
          }
          return isSo;
        });
    return isNear && Dot(mean, this->SimpleCover.Normal(simple)) >= 0.0;
  }

  void GoForth()
  {
    std::vector<std::uint32_t> indices(this->IsTouched.size(), None); // by number
    for (std::uint32_t i = 0; i < this->Numbers.size(); ++i)
    {
      indices[this->Numbers[i]] = i;
    }
    const TriangleMesh& original = this->Part.Original.Mesh;
    std::vector<std::uint32_t> places(original.Triangles.size(), None);
    std::vector<std::uint32_t> waiting;
    std::vector<bool> isKnown(original.Triangles.size());
    for (std::uint32_t i = 0; i < original.Triangles.size(); ++i)
    {
      const IdRange near = this->Part.Near[i];
      isKnown[i] = !near.empty() &&
        std::none_of(
          near.begin(), near.end(), [&](std::uint32_t number) { return this->IsTouched[number]; });
      // Else near one of them that is left, at least.
      for (const std::uint32_t number : near)
      {
        places[i] = indices[number] != None ? indices[number] : places[i];
      }
      if (places[i] != None)
      {
        waiting.push_back(i);
      }
    }
    ForEachFromPlace(original, this->Links, this->SimpleLinks, this->SimpleCover, places, waiting,
      [&](std::uint32_t i, std::uint32_t& place)
      {
        if (!isKnown[i] && !this->IsNearForth(i, place))
        {
          this->Found.Triangles.push_back(this->Numbers[place]);
          this->MarkOriginal(i);
        }
      });
    // Where nothing of a piece is left, nothing leads.
    for (std::uint32_t i = 0; i < places.size(); ++i)
    {
      if (places[i] == None)
      {
        this->MarkOriginal(i);
      }
    }
  }

  /** Nothing is near to a triangle of the original. */
  void MarkOriginal(std::uint32_t original)
  {
    const IdRange near = this->Part.Near[original];
    this->Found.Triangles.insert(this->Found.Triangles.end(), near.begin(), near.end());
    const Triangle& points = this->Part.Original.Mesh.Triangles[original];
    std::copy_if(points.begin(), points.end(), std::back_inserter(this->Found.Points),
      [&](std::uint32_t point) { return !this->SimpleLinks.IsUsed(point); });
    this->Part.Near.Begin(original);
  }

  /** Whether a triangle of the original is near to the simpler mesh.
   *  @param place where to begin, and where it ended */
  bool IsNearForth(std::uint32_t original, std::uint32_t& place)
  {
    const double allowance = this->Part.Original.Allowances[original];
    this->NewNear.clear();
    const bool isNear =
      this->SimpleCover.Covers(this->Part.Original.Mesh.Corners(original), place, allowance,
        [&](std::uint32_t simple, const Vector* corners, int count)
        {
          if (!this->SimpleCover.IsNear(simple, corners, count, allowance))
          {
            return false;
          }
          place = simple;
          const std::uint32_t number = this->Numbers[simple];
          if (std::find(this->NewNear.begin(), this->NewNear.end(), number) == this->NewNear.end())
          {
            this->NewNear.push_back(number);
          }
          return true;
        });
    if (isNear)
    {
      this->Part.Near.Begin(original);
      for (const std::uint32_t number : this->NewNear)
      {
        this->Part.Near.Add(original, number);
      }
    }
    return isNear;
  }

  MeshPart& Part;
  const Connectivity& Links;
  const Covering& Cover;
  const TriangleMesh& Simple;
  const std::vector<std::uint32_t>& Numbers;
  const std::vector<bool>& IsTouched;
  Connectivity SimpleLinks;
  Covering SimpleCover;
  std::vector<std::uint32_t> NewNear; ///< of one triangle of the original
  Faults Found;
};

PartDistance::Faults PartDistance::Find(const std::vector<Triangle>& simple,
  const std::vector<std::uint32_t>& numbers, const std::vector<bool>& isTouched)
{
  const TriangleMesh mesh{ this->Part.Original.Mesh.Positions, simple };
  return Comparison(*this, mesh, numbers, isTouched).Run();
}

}
