// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondPortion_h
#define isodiamond_DiamondPortion_h

#include "Lattice/DiamondSet.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace isodiamond
{

/** Cuts a row of things into parts of about the same size. @return the first thing of each part */
inline std::vector<int> EvenCuts(const std::vector<std::int64_t>& sizes, int parts)
{
  std::vector<std::int64_t> before(sizes.size() + 1, 0);
  std::partial_sum(sizes.begin(), sizes.end(), before.begin() + 1);
  std::vector<int> begins(parts, 0);
  for (int part = 1; part < parts; ++part)
  {
    const std::int64_t share = before.back() * part / parts;
    const auto above = std::lower_bound(before.begin(), before.end(), share);
    const bool isBelowNearer =
      above != before.begin() && share - *std::prev(above) < *above - share;
    begins[part] = static_cast<int>((isBelowNearer ? std::prev(above) : above) - before.begin());
  }
  return begins;
}

/**
 * The diamonds of one of several processes that build a hierarchy together: its portion.
 *
 * The slices of the lattice are cut into consecutive portions. A diamond is *owned* by the portion
 * that has the slice of its centre. Beyond its own, a portion *has* the diamonds nearby, at each
 * scale within the same number of slices of that scale: all whose domain touches its slices, and
 * all ancestors of these. So the diamonds of a portion are a closed set, as those of a whole
 * hierarchy are; missing ones look as if they did not lead to the surface.
 */
class DiamondPortion
{
public:
  /** Every brick of scale 0 has one owner: portions begin where a brick does. */
  static constexpr int Step = 8;

  /** @param begins the first slice of each portion, ascending, in multiples of Step, the first 0
   *  @param number of the portion */
  DiamondPortion(std::vector<int> begins, int number)
    : Begins(std::move(begins))
    , Number(number)
  {
    assert(this->Begins.front() == 0 && std::is_sorted(this->Begins.begin(), this->Begins.end()));
  }

  int Begin() const { return this->Begins[this->Number]; }

  /** The last portion also has everything behind it. */
  int End() const
  {
    const auto next = static_cast<std::size_t>(this->Number) + 1;
    return next < this->Begins.size() ? this->Begins[next] : std::numeric_limits<int>::max();
  }

  /** Whether it owns the diamonds centred in a slice. */
  bool Owns(int slice) const { return slice >= this->Begin() && slice < this->End(); }

  /** The diamonds of a brick's word that it has. @param z position of the word */
  std::uint64_t Has(int scale, int z) const
  {
    return BitsWhere(z,
      [&](int diamondClass)
      {
        const std::int64_t slice = z * (std::int64_t{ 1 } << scale);
        const std::int64_t reach = Reach(scale, diamondClass);
        return slice + reach >= this->Begin() && slice - reach <= this->End();
      });
  }

  /** Those that several portions have in common. */
  std::uint64_t AreCommon(int scale, int z) const
  {
    return BitsWhere(z,
      [&](int diamondClass)
      {
        const std::int64_t slice = z * (std::int64_t{ 1 } << scale);
        const std::int64_t reach = Reach(scale, diamondClass);
        const auto next =
          std::lower_bound(this->Begins.begin() + 1, this->Begins.end(), slice - reach);
        return next != this->Begins.end() && *next <= slice + reach;
      });
  }

private:
  /** How many slices around its own a portion has diamonds of. A domain reaches one step of its
   *  scale from its centre. Parents are of the next older class and at most a step away: after
   *  three classes that is no more than the youngest class of the next scale has. */
  static std::int64_t Reach(int scale, int diamondClass)
  {
    constexpr int youngest = 3;
    static_assert(youngest + 3 <= 2 * youngest, "parents are there, too");
    return std::int64_t{ youngest + 2 - diamondClass } << scale;
  }

  template <typename Condition>
  static std::uint64_t BitsWhere(int z, const Condition& condition)
  {
    std::uint64_t bits = 0;
    for (int diamondClass = 0; diamondClass < 3; ++diamondClass)
    {
      bits |= condition(diamondClass) ? tables::ClassBits[diamondClass][z & 1] : 0;
    }
    return bits;
  }

  std::vector<int> Begins;
  int Number;
};

}

#endif
