// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** The cosine between the normals of two triangles at an edge; sharper edges are not made, unless
 *  one as sharp was there before. */
constexpr double SharpestCosine = -0.7;

/** The sharpest of some creases. */
class Sharpest
{
public:
  explicit Sharpest(double cosine)
    : Cosine(cosine)
  {
  }
  void Add(const Vector& a, const Vector& b) { this->Cosine = std::min(this->Cosine, Dot(a, b)); }
  bool IsSharperThan(const Sharpest& other) const { return this->Cosine < other.Cosine; }

private:
  double Cosine;
};

}

/** Whether new triangles in a hole make a crease, among them or at its border, sharper than any
 *  before.
 *  @param goesRound whether the last of them is beside the first
 *  @param newNormal (i) of what will be at the border from the hole's point i to the next */
template <typename NewNormal>
bool EdgeCollapses::MakesCrease(const Hole& hole, bool goesRound, NewNormal&& newNormal) const
{
  Sharpest before(SharpestCosine);
  Sharpest after(1.0);
  for (int i = 0; i < hole.Count; ++i)
  {
    const int next = i + 1 < hole.Count ? i + 1 : 0;
    if (next > 0 || goesRound)
    {
      after.Add(newNormal(i), newNormal(next));
    }
    const std::uint32_t triangle = hole.Triangles[i];
    if (triangle == None)
    {
      continue;
    }
    if (hole.Triangles[next] != None)
    {
      before.Add(this->Normals[triangle], this->Normals[hole.Triangles[next]]);
    }
    const std::uint32_t outer =
      this->Neighbours[triangle][PlaceOf(this->Triangles[triangle], hole.Points[i])];
    if (outer != None)
    {
      before.Add(this->Normals[triangle], this->Normals[outer]);
      after.Add(newNormal(i), this->Normals[outer]);
    }
  }
  return after.IsSharperThan(before);
}

/** The same for what fills the hole of a vertex: the first triangle and the last are gone. */
bool EdgeCollapses::MakesCrease(const Hole& hole) const
{
  return this->MakesCrease(hole, false,
    [&](int i) -> const Vector&
    { return this->Fillings[std::clamp(i, 1, hole.Count - 2)].Normal; });
}

/** The same for a vertex that moves. */
bool EdgeCollapses::MakesCrease(const Fan& fan) const
{
  return this->MakesCrease(
    fan.Border(), true, [&](int i) -> const Vector& { return fan.NewNormal(i); });
}

/** The same for a flip. */
bool EdgeCollapses::MakesCrease(const Flip& flip) const
{
  Sharpest before(SharpestCosine);
  Sharpest after(1.0);
  before.Add(this->Normals[flip.First], this->Normals[flip.Second]);
  after.Add(flip.FirstNormal, flip.SecondNormal);
  for (const std::uint32_t triangle : { flip.First, flip.Second })
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::uint32_t outer = this->Neighbours[triangle][edge];
      if (outer != None && outer != flip.First && outer != flip.Second)
      {
        // Afterwards the first triangle has A, the second one B.
        const std::uint32_t from = this->Triangles[triangle][edge];
        const std::uint32_t to = this->Triangles[triangle][(edge + 1) % 3];
        const bool hasA = from == flip.A || to == flip.A;
        before.Add(this->Normals[triangle], this->Normals[outer]);
        after.Add(hasA ? flip.FirstNormal : flip.SecondNormal, this->Normals[outer]);
      }
    }
  }
  return after.IsSharperThan(before);
}

}
