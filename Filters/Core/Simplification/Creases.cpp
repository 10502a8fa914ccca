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

/** Whether filling a hole makes a crease, in it or at its border, sharper than any before. */
bool EdgeCollapses::MakesCrease(std::uint32_t vertex, const Hole& hole) const
{
  Sharpest before(SharpestCosine);
  Sharpest after(1.0);
  const int last = hole.Count - 1;
  for (int i = 0; i <= last; ++i)
  {
    const std::uint32_t triangle = hole.Triangles[i];
    if (triangle == None)
    {
      continue;
    }
    const Triangle& neighbours = this->Neighbours[triangle];
    const int place = PlaceOf(this->Triangles[triangle], vertex);
    const std::uint32_t next = neighbours[(place + 2) % 3];
    if (next != None)
    {
      before.Add(this->Normals[triangle], this->Normals[next]);
    }
    const std::uint32_t outer = neighbours[(place + 1) % 3];
    if (outer != None)
    {
      before.Add(this->Normals[triangle], this->Normals[outer]);
      after.Add(this->Fillings[std::clamp(i, 1, last - 1)].Normal, this->Normals[outer]);
    }
  }
  for (int i = 1; i + 1 < last; ++i)
  {
    after.Add(this->Fillings[i].Normal, this->Fillings[i + 1].Normal);
  }
  return after.IsSharperThan(before);
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

/** The same for a vertex that moves. */
bool EdgeCollapses::MakesCrease(const Fan& fan) const
{
  Sharpest before(SharpestCosine);
  Sharpest after(1.0);
  const Hole& hole = fan.Border();
  for (int i = 0; i < hole.Count; ++i)
  {
    const std::uint32_t triangle = hole.Triangles[i];
    before.Add(this->Normals[triangle], this->Normals[hole.Triangles[fan.After(i)]]);
    after.Add(fan.NewNormal(i), fan.NewNormal(fan.After(i)));
    const std::uint32_t outer =
      this->Neighbours[triangle][PlaceOf(this->Triangles[triangle], hole.Points[i])];
    if (outer != None)
    {
      before.Add(this->Normals[triangle], this->Normals[outer]);
      after.Add(fan.NewNormal(i), this->Normals[outer]);
    }
  }
  return after.IsSharperThan(before);
}

}
