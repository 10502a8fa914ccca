// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceWalk.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_set>

namespace reference
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** The state of the walk: a queue of candidates and a front that is a hash map. */
class Walk
{
public:
  Walk(const Hierarchy& hierarchy, const Criterion& criterion)
    : Diamonds(hierarchy)
    , IsWorthwhile(criterion)
    , Subdivided(hierarchy.Size(), false)
  {
    this->AddToFront(0);
  }

  Refinement Run()
  {
    while (!this->Candidates.empty())
    {
      const int candidate = this->Candidates.front();
      this->Candidates.pop();
      // A candidate may have been subdivided for a descendant's sake in the meantime.
      if (this->Front.count(candidate) != 0 && this->IsWorthwhile(candidate))
      {
        this->Subdivide(candidate);
      }
    }

    Refinement refinement;
    refinement.Subdivided = this->Subdivided;
    refinement.Front.assign(this->Diamonds.Size(), false);
    for (const int index : this->Front)
    {
      refinement.Front[index] = true;
    }
    return refinement;
  }

private:
  void AddToFront(int index)
  {
    if (this->Front.insert(index).second)
    {
      this->Candidates.push(index);
    }
  }

  void Subdivide(int index)
  {
    for (const int parent : this->Diamonds.At(index).Parents)
    {
      if (!this->Subdivided[parent])
      {
        this->Subdivide(parent);
      }
    }
    this->Subdivided[index] = true;
    this->Front.erase(index);
    for (const int child : this->Diamonds.At(index).Children)
    {
      if (!this->Subdivided[child])
      {
        this->AddToFront(child);
      }
    }
  }

  const Hierarchy& Diamonds;
  const Criterion& IsWorthwhile;
  std::queue<int> Candidates;
  std::unordered_set<int> Front;
  DiamondSet Subdivided;
};

bool HasParentIn(const Diamond& diamond, const DiamondSet& diamonds)
{
  return std::any_of(diamond.Parents.begin(), diamond.Parents.end(),
    [&diamonds](int parent) { return diamonds[parent]; });
}

}

std::set<Point> CentersOf(const Hierarchy& hierarchy, const DiamondSet& diamonds)
{
  std::set<Point> centers;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    if (diamonds[index])
    {
      centers.insert(hierarchy.At(index).Center);
    }
  }
  return centers;
}

DiamondSet DiamondsAt(const Hierarchy& hierarchy, const std::set<Point>& centers)
{
  DiamondSet diamonds(hierarchy.Size(), false);
  for (const Point& center : centers)
  {
    diamonds.at(hierarchy.Find(center)) = true;
  }
  return diamonds;
}

Criterion UniformCriterion(
  const std::vector<double>& errors, const std::vector<bool>& crossed, double tolerance)
{
  return [&errors, &crossed, tolerance](int index)
  { return crossed[index] && errors[index] > tolerance; };
}

Refinement Refine(const Hierarchy& hierarchy, const Criterion& criterion)
{
  return Walk(hierarchy, criterion).Run();
}

DiamondSet SmallestClosedSet(const Hierarchy& hierarchy, const Criterion& criterion)
{
  DiamondSet set(hierarchy.Size(), false);
  bool hasChanged = true;
  while (hasChanged)
  {
    hasChanged = false;
    for (int index = 0; index < hierarchy.Size(); ++index)
    {
      const Diamond& diamond = hierarchy.At(index);
      if (!set[index] && (index == 0 || HasParentIn(diamond, set)) && criterion(index))
      {
        set[index] = true;
        hasChanged = true;
      }
      for (const int parent : diamond.Parents)
      {
        if (set[index] && !set[parent])
        {
          set[parent] = true;
          hasChanged = true;
        }
      }
    }
  }
  return set;
}

DiamondSet FrontOf(const Hierarchy& hierarchy, const DiamondSet& subdivided)
{
  DiamondSet front(hierarchy.Size(), false);
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    front[index] =
      !subdivided[index] && (index == 0 || HasParentIn(hierarchy.At(index), subdivided));
  }
  return front;
}

bool IsClosed(const Hierarchy& hierarchy, const DiamondSet& diamonds)
{
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    for (const int parent : hierarchy.At(index).Parents)
    {
      if (diamonds[index] && !diamonds[parent])
      {
        return false;
      }
    }
  }
  return true;
}

std::vector<double> Thresholds(
  const Hierarchy& hierarchy, const std::vector<double>& errors, const std::vector<bool>& crossed)
{
  std::set<double> values;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    if (crossed[index])
    {
      values.insert(errors[index]);
    }
  }

  std::vector<double> thresholds(hierarchy.Size(), -Infinity);
  // Between one error and the next the criterion does not change, so neither does what is
  // subdivided: whatever is subdivided at the lower tolerance is subdivided at all tolerances below
  // the upper.
  double tolerance = -Infinity;
  for (const double value : values)
  {
    const Refinement refinement = Refine(hierarchy, UniformCriterion(errors, crossed, tolerance));
    for (int index = 0; index < hierarchy.Size(); ++index)
    {
      if (refinement.Subdivided[index])
      {
        thresholds[index] = value;
      }
    }
    tolerance = value;
  }
  return thresholds;
}

}
