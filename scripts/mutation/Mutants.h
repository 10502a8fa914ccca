// SPDX-License-Identifier: BSD-3-Clause
#ifndef Mutants_h
#define Mutants_h

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

/**
 * Faults that are switched on one at a time, by the environment: all are in one program, which is
 * built once. scripts/mutate.py puts them into a copy of the core, and this header before each
 * file.
 *
 * The operands of an operator need not be found: `a < b` becomes `a < (Tag) > b`, which binds in
 * the same way.
 */
namespace mutants
{

inline const int Active =
  std::getenv("ISODIAMONDS_MUTANT") != nullptr ? std::atoi(std::getenv("ISODIAMONDS_MUTANT")) : -1;

/** Which faults were reached, switched on or not; written to a file at the end. */
struct Reached
{
  static constexpr int Most = 1000000;
  inline static unsigned char Numbers[Most] = {};

  ~Reached()
  {
    const char* name = std::getenv("ISODIAMONDS_REACHED");
    std::FILE* file = name != nullptr ? std::fopen(name, "w") : nullptr;
    for (int number = 0; file != nullptr && number < Most; ++number)
    {
      if (Numbers[number] != 0)
      {
        std::fprintf(file, "%d\n", number);
      }
    }
    if (file != nullptr)
    {
      std::fclose(file);
    }
  }
};
inline Reached AllReached;

inline bool IsActive(int number)
{
  Reached::Numbers[number] = 1;
  return number == Active;
}

/** Never a constant expression: tables are made at the start, so that faults are in them, too. */
constexpr bool On(int number)
{
  return number < 0 || IsActive(number);
}

/** An operator and what it becomes. */
template <int Number, typename Original, typename Mutant>
struct Operator
{
  template <typename Left>
  struct Bound
  {
    const Left& First;

    template <typename Right>
    constexpr auto With(const Right& second) const
    {
      using Result = decltype(Original()(this->First, second));
      return On(Number) ? Result(Mutant()(this->First, second))
                        : Result(Original()(this->First, second));
    }
  };
};

template <int Number, typename Original, typename Mutant>
inline constexpr Operator<Number, Original, Mutant> Tag{};

#define ISODIAMONDS_MUTANT_OPERATOR(symbol)                                            \
  template <typename Left, int Number, typename Original, typename Mutant>             \
  constexpr auto operator symbol(const Left& left, Operator<Number, Original, Mutant>) \
  {                                                                                    \
    return typename Operator<Number, Original, Mutant>::template Bound<Left>{ left };  \
  }
#define ISODIAMONDS_MUTANT_RESULT(symbol)                                \
  template <typename Bound, typename Right>                              \
  constexpr auto operator symbol(const Bound& bound, const Right& right) \
    ->decltype(bound.With(right))                                        \
  {                                                                      \
    return bound.With(right);                                            \
  }
ISODIAMONDS_MUTANT_OPERATOR(<)
ISODIAMONDS_MUTANT_OPERATOR(==)
ISODIAMONDS_MUTANT_OPERATOR(+)
ISODIAMONDS_MUTANT_OPERATOR(*)
ISODIAMONDS_MUTANT_RESULT(>)
ISODIAMONDS_MUTANT_RESULT(==)
ISODIAMONDS_MUTANT_RESULT(+)
ISODIAMONDS_MUTANT_RESULT(*)

/** The lesser for the greater, or the other way round. */
template <int Number, bool IsMaximum>
struct Extreme
{
  template <typename T>
  constexpr T operator()(const T& a, const T& b) const
  {
    return On(Number) == IsMaximum ? std::min(a, b) : std::max(a, b);
  }
  template <typename T>
  constexpr T operator()(std::initializer_list<T> values) const
  {
    return On(Number) == IsMaximum ? std::min(values) : std::max(values);
  }
};

}

#endif
