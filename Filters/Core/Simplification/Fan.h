// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Fan_h
#define isodiamond_Fan_h

#include "Simplification/Fit.h"
#include "Simplification/Hole.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The triangles around a vertex, with what lies over them: would they fit better around another one
 * of the points there?
 *
 * Seen from above (Hole.h), a fan stays the same polygon, covered once, from whichever place in it
 * that sees all of its border the triangles are drawn. Few points are tried: the one nearest to
 * where the sum of squared distances would be least, the one that is farthest from its triangle,
 * and those nearest to the polygon's centre and to half the way there, where shapes are good.
 */
class Fan
{
public:
  /** Something that lies over a triangle, or the vertex itself. */
  struct Sample
  {
    Vector From{}; ///< from the vertex
    double Allowance = 0.0;
    std::uint32_t Number = 0;
    int Triangle = 0;     ///< its number in the hole
    bool IsPoint = false; ///< which may take the vertex's place
  };

  /** By number in the hole. */
  template <typename Item>
  using ByTriangle = std::array<Item, Hole::MostPoints>;

  /** Begins a fan; its samples are added then.
   *  @param hole as it is seen from above, not open
   *  @param ring the hole's points, from the vertex
   *  @param normals of its triangles */
  void Begin(const Hole& hole, const ByTriangle<Vector>& ring, const ByTriangle<Vector>& normals);

  void Add(const Sample& sample);

  /** Finds the point around which the triangles fit best.
   *  @param leastSine of angles, unless one is less already
   *  @return whether that is better than around the vertex */
  bool FindBetter(double leastSine);

  ///@{
  /** As was found: the point's number, and the normals around it. */
  std::uint32_t Point() const { return this->Samples[this->Best].Number; }
  const Vector& NewNormal(int triangle) const { return this->BestNormals[triangle]; }
  ///@}

  /** Calls visit(number, triangle that it will lie over) for all samples but the point. */
  template <typename Visit>
  void ForEachSample(Visit&& visit) const
  {
    for (std::size_t i = 0; i < this->Samples.size(); ++i)
    {
      if (i != this->Best)
      {
        visit(this->Samples[i].Number, this->BestTriangles[i]);
      }
    }
  }

  const Hole& Border() const { return this->Around; }
  int After(int triangle) const { return triangle + 1 < this->Around.Count ? triangle + 1 : 0; }

private:
  static constexpr std::size_t Nothing = ~std::size_t{ 0 };
  using Candidates = std::array<std::size_t, 4>; ///< samples, or nothing

  Candidates FindCandidates() const;
  Vector LeastSquaresMove() const;
  Hole::Place Centre() const;
  bool Draw(std::size_t point);
  bool TakesSamples(std::size_t point, double most);

  Hole Around;
  ByTriangle<Vector> Ring;
  ByTriangle<Vector> Normals;
  std::vector<Sample> Samples;
  std::vector<Hole::Place> Seen; ///< by sample
  std::vector<double> Distances; ///< by sample, from its triangle
  Fit Now;

  // What is tried.
  ByTriangle<Vector> NewNormals;
  ByTriangle<Hole::Place> Spokes;
  std::vector<int> NewTriangles; ///< by sample
  Fit New;
  // The best so far.
  std::size_t Best = Nothing;
  ByTriangle<Vector> BestNormals;
  std::vector<int> BestTriangles;
};

}

#endif
