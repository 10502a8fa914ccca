// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Fit_h
#define isodiamond_Fit_h

#include <algorithm>

namespace isodiamond
{

/** How well some triangles fit what lies over them, and how they are shaped: whether a change of
 *  them that removes none, as the flip of an edge, is worth it. */
struct Fit
{
  double Squares = 0.0; ///< the sum of the samples' squared distances
  double Allowed = 0.0; ///< of their squared allowances
  double Sine = 1.0;    ///< of the smallest angle

  /** More squares than this are better than these in no shape. */
  double MostSquares() const { return this->Squares + PriceOfShape * this->Allowed; }

  /** Whether samples are nearer overall, or not much farther if a bad shape gets better. */
  bool IsBetterThan(const Fit& before) const
  {
    const bool isBetterShape = this->Sine > BetterShape * before.Sine;
    if (isBetterShape && before.Sine < ShapelySine)
    {
      return this->Squares <= before.MostSquares();
    }
    const bool isSliver = this->Sine < std::min(before.Sine, SliverSine);
    return this->Squares < (isSliver ? WorthPartOfSliver : WorthPart) * before.Squares;
  }

private:
  /** The part of the squares that a change may leave; and one that makes a sliver. */
  static constexpr double WorthPart = 0.95;
  static constexpr double WorthPartOfSliver = 0.75;

  /** The sine of the smallest angle of a triangle that is no sliver: of 10 degrees. */
  static constexpr double SliverSine = 0.17;

  /** The sine below which a shape could be better: of 30 degrees; how much better it has to get;
   *  and how much the squares may grow for that, as a part of what is allowed. */
  static constexpr double ShapelySine = 0.5;
  static constexpr double BetterShape = 1.2;
  static constexpr double PriceOfShape = 0.05;
};

}

#endif
