// SPDX-License-Identifier: BSD-3-Clause
#include "Field/SmallPieces.h"

#include "Lattice/DiamondSet.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>
#include <vector>

namespace isodiamond
{
namespace
{

constexpr std::int64_t RowGrain = 64;
constexpr std::int64_t RunGrain = 4096;

/** Calls body(word, changes) for the words of a row: bits of changes are set where a run of a side
 *  begins, and just after it. @return whether the last run reaches the end of the last word */
template <typename Body>
bool ForEachWordOfChanges(const SignRows& rows, std::int64_t row, bool above, Body&& body)
{
  const std::uint64_t* words = rows.Bits + row * rows.Words;
  const std::uint64_t flip = above ? 0 : ~std::uint64_t{ 0 };
  const int rest = rows.Count[0] & 63;
  const std::uint64_t last = rest != 0 ? (std::uint64_t{ 1 } << rest) - 1 : ~std::uint64_t{ 0 };
  std::uint64_t before = 0; // the bit before the word
  for (std::int64_t i = 0; i < rows.Words; ++i)
  {
    const std::uint64_t side =
      (words[i] ^ flip) & (i + 1 < rows.Words ? ~std::uint64_t{ 0 } : last);
    body(i, side ^ ((side << 1) | before));
    before = side >> 63;
  }
  return before != 0;
}

/** Changes the signs of the samples [begin, end) of a row. */
void FlipSigns(std::uint64_t* words, int begin, int end)
{
  while (begin < end)
  {
    const int first = begin & 63;
    const int count = std::min(end - begin, 64 - first);
    words[begin >> 6] ^= (~std::uint64_t{ 0 } >> (64 - count)) << first;
    begin += count;
  }
}

/**
 * Disjoint sets of indices, which threads join concurrently without locks.
 *
 * Each points to a smaller one of its set, the smallest to itself: so the sets and the indices that
 * stand for them do not depend on the order of joins. Whatever once was an ancestor remains one, so
 * that a thread may shorten a path while others walk it.
 */
class DisjointSets
{
public:
  explicit DisjointSets(std::int64_t size, const ParallelFor& parallelFor)
    : Parents(size)
  {
    ForEachIndex(parallelFor, size, RunGrain,
      [this](std::int64_t i)
      { this->Parents[i].store(static_cast<std::uint32_t>(i), std::memory_order_relaxed); });
  }

  std::uint32_t Root(std::uint32_t i)
  {
    std::uint32_t parent = this->Parent(i);
    while (parent != i)
    {
      const std::uint32_t next = this->Parent(parent);
      if (next != parent)
      {
        this->Parents[i].store(next, std::memory_order_relaxed);
      }
      i = parent;
      parent = next;
    }
    return i;
  }

  void Join(std::uint32_t a, std::uint32_t b)
  {
    while (true)
    {
      a = this->Root(a);
      b = this->Root(b);
      if (a == b)
      {
        return;
      }
      std::uint32_t larger = std::max(a, b);
      const std::uint32_t smaller = std::min(a, b);
      if (this->Parents[larger].compare_exchange_strong(larger, smaller, std::memory_order_relaxed))
      {
        return; // otherwise another thread was faster: it is no longer a root
      }
    }
  }

private:
  std::uint32_t Parent(std::uint32_t i) const
  {
    return this->Parents[i].load(std::memory_order_relaxed);
  }

  std::vector<std::atomic<std::uint32_t>> Parents;
};

/** Samples [Begin, End) of a row, all on the side in question; those next to them are not. */
struct Run
{
  std::int32_t Begin = 0;
  std::int32_t End = 0;
};

/** The pieces of one side, as sets of runs. */
class Pieces
{
public:
  Pieces(const SignRows& rows, bool above, std::int64_t minimumSize, const ParallelFor& parallelFor)
    : Rows(rows)
    , Above(above)
    , MinimumSize(minimumSize)
    , Parallel(parallelFor)
    , First(this->CountRuns())
    , Runs(this->FindRuns())
    , Sets(static_cast<std::int64_t>(this->Runs.size()), parallelFor)
    , Sizes(this->Runs.size())
  {
    this->ConnectRuns();
    this->AddUpSizes();
  }

  /** Flips the signs of pieces that are too small. @return how many there are */
  std::int64_t RemoveSmall()
  {
    std::atomic<std::int64_t> removed{ 0 };
    this->Parallel(this->Rows.RowCount(), RowGrain,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t roots = 0;
        for (std::int64_t row = begin; row < end; ++row)
        {
          roots += this->RemoveFromRow(row);
        }
        removed.fetch_add(roots, std::memory_order_relaxed);
      });
    return removed;
  }

private:
  /** For each row the number of runs before it, then the number of all. */
  std::vector<std::int64_t> CountRuns() const
  {
    std::vector<std::int64_t> first(this->Rows.RowCount() + 1);
    ForEachIndex(this->Parallel, this->Rows.RowCount(), RowGrain,
      [&](std::int64_t row)
      {
        int changes = 0;
        ForEachWordOfChanges(this->Rows, row, this->Above,
          [&](std::int64_t /*word*/, std::uint64_t bits) { changes += PopCount(bits); });
        first[row + 1] = (changes + 1) / 2; // the last run may have no end
      });
    for (std::int64_t row = 0; row < this->Rows.RowCount(); ++row)
    {
      first[row + 1] += first[row];
    }
    if (first.back() > std::numeric_limits<std::uint32_t>::max())
    {
      throw std::length_error("more than 2^32 - 1 runs of equal signs");
    }
    return first;
  }

  std::vector<Run> FindRuns() const
  {
    std::vector<Run> runs(this->First.back());
    ForEachIndex(this->Parallel, this->Rows.RowCount(), RowGrain,
      [&](std::int64_t row)
      {
        Run* next = runs.data() + this->First[row];
        bool isOpen = false;
        const auto change = [&](int x)
        {
          (isOpen ? next->End : next->Begin) = x;
          next += isOpen ? 1 : 0;
          isOpen = !isOpen;
        };
        const bool reachesEnd = ForEachWordOfChanges(this->Rows, row, this->Above,
          [&](std::int64_t word, std::uint64_t bits)
          { ForEachBit(bits, [&](int bit) { change(static_cast<int>(64 * word) + bit); }); });
        if (reachesEnd)
        {
          change(this->Rows.Count[0]);
        }
      });
    return runs;
  }

  /** Joins the runs of all pairs of neighbouring rows. */
  void ConnectRuns()
  {
    ForEachIndex(this->Parallel, this->Rows.RowCount(), RowGrain,
      [&](std::int64_t row)
      {
        const int rows = this->Rows.Count[1];
        const int y = static_cast<int>(row % rows);
        const bool hasNextSlice = row / rows + 1 < this->Rows.Count[2];
        const int parityY = y & 1;
        const int parityZ = static_cast<int>(row / rows) & 1;
        if (y + 1 < rows)
        {
          this->ConnectRows(row, row + 1, parityY);
        }
        if (hasNextSlice)
        {
          this->ConnectRows(row, row + rows, parityZ);
        }
        const bool hasDiagonals = hasNextSlice && parityY == parityZ;
        if (hasDiagonals && y + 1 < rows)
        {
          this->ConnectRows(row, row + rows + 1, parityY);
        }
        if (hasDiagonals && y > 0)
        {
          this->ConnectRows(row, row + rows - 1, parityY);
        }
      });
  }

  /** Joins runs that have an edge between them: those that overlap, and those of which one begins
   *  where the other ends, if there is an edge that moves along x as well.
   *  @param parity of the row's coordinates on the axes on which the other row differs */
  void ConnectRows(std::int64_t row, std::int64_t otherRow, int parity)
  {
    std::int64_t i = this->First[row];
    std::int64_t j = this->First[otherRow];
    while (i < this->First[row + 1] && j < this->First[otherRow + 1])
    {
      const Run& run = this->Runs[i];
      const Run& other = this->Runs[j];
      const bool overlap = run.Begin < other.End && other.Begin < run.End;
      const bool isBefore = run.End == other.Begin && ((run.End - 1) & 1) == parity;
      const bool isAfter = other.End == run.Begin && (run.Begin & 1) == parity;
      if (overlap || isBefore || isAfter)
      {
        this->Sets.Join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      }
      ++(run.End < other.End ? i : j);
    }
  }

  /** Adds up sizes of pieces, at their roots. Those that have reached the minimum are not added to:
   *  most runs are in a few pieces, and all threads would write to these. */
  void AddUpSizes()
  {
    ForEachIndex(this->Parallel, this->Runs.size(), RunGrain,
      [&](std::int64_t i)
      {
        std::atomic<std::int64_t>& size =
          this->Sizes[this->Sets.Root(static_cast<std::uint32_t>(i))];
        if (size.load(std::memory_order_relaxed) < this->MinimumSize)
        {
          size.fetch_add(this->Runs[i].End - this->Runs[i].Begin, std::memory_order_relaxed);
        }
      });
  }

  /** @return the number of small pieces that have their first run here */
  std::int64_t RemoveFromRow(std::int64_t row)
  {
    std::int64_t roots = 0;
    for (std::int64_t i = this->First[row]; i < this->First[row + 1]; ++i)
    {
      const std::uint32_t root = this->Sets.Root(static_cast<std::uint32_t>(i));
      if (this->Sizes[root].load(std::memory_order_relaxed) < this->MinimumSize)
      {
        FlipSigns(this->Rows.Bits + row * this->Rows.Words, this->Runs[i].Begin, this->Runs[i].End);
        roots += root == i ? 1 : 0;
      }
    }
    return roots;
  }

  const SignRows& Rows;
  bool Above;
  std::int64_t MinimumSize;
  const ParallelFor& Parallel;
  std::vector<std::int64_t> First; ///< run of each row, then the number of all
  std::vector<Run> Runs;
  DisjointSets Sets;
  std::vector<std::atomic<std::int64_t>> Sizes; ///< at least the minimum means large enough
};

}

std::int64_t RemoveSmallPieces(
  const SignRows& rows, std::int64_t minimumSize, const ParallelFor& parallelFor)
{
  const std::int64_t solids = Pieces(rows, true, minimumSize, parallelFor).RemoveSmall();
  return solids + Pieces(rows, false, minimumSize, parallelFor).RemoveSmall();
}

}
