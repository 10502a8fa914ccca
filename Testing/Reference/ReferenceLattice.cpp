// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceLattice.h"

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>

namespace reference
{

namespace
{

/** Whether a point in doubled coordinates, like the sum of an edge's ends, is a lattice point. */
bool IsLatticePoint(const Point& doubled)
{
  return doubled[0] % 2 == 0 && doubled[1] % 2 == 0 && doubled[2] % 2 == 0;
}

Point Halved(const Point& doubled)
{
  return { doubled[0] / 2, doubled[1] / 2, doubled[2] / 2 };
}

long long SquaredLength(const Point& a, const Point& b)
{
  long long sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const long long difference = a[axis] - b[axis];
    sum += difference * difference;
  }
  return sum;
}

void InsertSorted(std::vector<int>& list, int value)
{
  const auto place = std::lower_bound(list.begin(), list.end(), value);
  if (place == list.end() || *place != value)
  {
    list.insert(place, value);
  }
}

}

std::size_t PointHash::operator()(const Point& point) const
{
  std::size_t hash = 0;
  for (const int coordinate : point)
  {
    hash = hash * 1000003u + std::hash<int>()(coordinate);
  }
  return hash;
}

bool InGridOrder(const Point& a, const Point& b)
{
  return std::array<int, 3>{ a[2], a[1], a[0] } < std::array<int, 3>{ b[2], b[1], b[0] };
}

Point Sum(const Point& a, const Point& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

std::array<Point, 2> Tetrahedron::LongestEdge() const
{
  std::array<Point, 2> longest{ this->Vertices[0], this->Vertices[1] };
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      if (SquaredLength(this->Vertices[i], this->Vertices[j]) >
        SquaredLength(longest[0], longest[1]))
      {
        longest = { this->Vertices[i], this->Vertices[j] };
      }
    }
  }
  if (InGridOrder(longest[1], longest[0]))
  {
    std::swap(longest[0], longest[1]);
  }
  return longest;
}

Hierarchy::Hierarchy(const Point& dims)
  : GridDims(dims)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (dims[axis] < 2)
    {
      throw std::invalid_argument("a grid needs at least two samples along every axis");
    }
    while (this->BaseSize() < dims[axis] - 1)
    {
      ++this->Exponent;
    }
  }

  for (const Tetrahedron& tetrahedron : this->BaseTetrahedra())
  {
    this->AddTetrahedron(tetrahedron, -1, 0);
  }
  // Breadth first: diamonds are appended while others are visited. When a diamond is visited, all
  // diamonds of its depth have all their tetrahedra, which the diamonds of the depth before made.
  for (int index = 0; index < this->Size(); ++index)
  {
    this->ListVertices(this->AllDiamonds[index]);
    const int depth = this->AllDiamonds[index].Depth;
    const std::vector<Tetrahedron> tetrahedra = this->AllDiamonds[index].Tetrahedra;
    for (const Tetrahedron& tetrahedron : tetrahedra)
    {
      for (const Tetrahedron& half : Hierarchy::Bisect(tetrahedron))
      {
        this->AddTetrahedron(half, index, depth + 1);
      }
    }
  }
}

void Hierarchy::AddTetrahedron(const Tetrahedron& tetrahedron, int origin, int depth)
{
  const std::array<Point, 2> spine = tetrahedron.LongestEdge();
  const Point doubledCenter = Sum(spine[0], spine[1]);
  if (!this->BelongsToGrid(tetrahedron) || !IsLatticePoint(doubledCenter))
  {
    return;
  }
  const Point center = Halved(doubledCenter);
  int index = this->Find(center);
  if (index < 0)
  {
    index = this->Size();
    this->Indices[center] = index;
    Diamond diamond;
    diamond.Center = center;
    diamond.Spine = spine;
    diamond.Depth = depth;
    this->AllDiamonds.push_back(diamond);
  }

  Diamond& diamond = this->AllDiamonds[index];
  if (diamond.Spine != spine || diamond.Depth != depth)
  {
    throw std::logic_error("two diamonds have one central vertex");
  }
  diamond.Tetrahedra.push_back(tetrahedron);
  diamond.Origins.push_back(origin);
  if (origin >= 0)
  {
    InsertSorted(diamond.Parents, origin);
    InsertSorted(this->AllDiamonds[origin].Children, index);
  }
}

void Hierarchy::ListVertices(Diamond& diamond) const
{
  std::set<Point, decltype(&InGridOrder)> vertices(&InGridOrder);
  for (const Tetrahedron& tetrahedron : diamond.Tetrahedra)
  {
    vertices.insert(tetrahedron.Vertices.begin(), tetrahedron.Vertices.end());
  }
  diamond.Vertices.assign(vertices.begin(), vertices.end());
  diamond.SticksOut = std::any_of(vertices.begin(), vertices.end(),
    [this](const Point& vertex) { return !this->IsSampled(vertex); });
}

bool Hierarchy::IsSampled(const Point& point) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (point[axis] < 0 || point[axis] >= this->GridDims[axis])
    {
      return false;
    }
  }
  return true;
}

bool Hierarchy::BelongsToGrid(const Tetrahedron& tetrahedron) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    int lowest = this->BaseSize();
    for (const Point& vertex : tetrahedron.Vertices)
    {
      lowest = std::min(lowest, vertex[axis]);
    }
    if (lowest >= this->GridDims[axis] - 1)
    {
      return false;
    }
  }
  return true;
}

bool Hierarchy::IsBaseCorner(const Point& point) const
{
  return std::all_of(point.begin(), point.end(),
    [this](int coordinate) { return coordinate == 0 || coordinate == this->BaseSize(); });
}

std::vector<Tetrahedron> Hierarchy::BaseTetrahedra() const
{
  // Every order of the three axes gives a path along the cube's edges from the origin to the far
  // corner.
  std::vector<Tetrahedron> tetrahedra;
  std::array<int, 3> axes{ 0, 1, 2 };
  do
  {
    Tetrahedron tetrahedron;
    Point corner{ 0, 0, 0 };
    tetrahedron.Vertices[0] = corner;
    for (int step = 0; step < 3; ++step)
    {
      corner[axes[step]] = this->BaseSize();
      tetrahedron.Vertices[step + 1] = corner;
    }
    tetrahedra.push_back(tetrahedron);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return tetrahedra;
}

std::vector<std::array<Point, 2>> Hierarchy::BaseEdges() const
{
  std::set<std::array<Point, 2>> edges;
  for (const Tetrahedron& tetrahedron : this->BaseTetrahedra())
  {
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        edges.insert(this->YoungerFirst(tetrahedron.Vertices[i], tetrahedron.Vertices[j]));
      }
    }
  }
  return std::vector<std::array<Point, 2>>(edges.begin(), edges.end());
}

int Hierarchy::Find(const Point& center) const
{
  const auto found = this->Indices.find(center);
  return found == this->Indices.end() ? -1 : found->second;
}

int Hierarchy::DiamondOf(const Tetrahedron& tetrahedron) const
{
  const std::array<Point, 2> spine = tetrahedron.LongestEdge();
  const Point doubledCenter = Sum(spine[0], spine[1]);
  return IsLatticePoint(doubledCenter) ? this->Find(Halved(doubledCenter)) : -1;
}

std::array<Tetrahedron, 2> Hierarchy::Bisect(const Tetrahedron& tetrahedron)
{
  const std::array<Point, 2> spine = tetrahedron.LongestEdge();
  const Point center = Halved(Sum(spine[0], spine[1]));
  std::array<Tetrahedron, 2> halves{ tetrahedron, tetrahedron };
  for (int side = 0; side < 2; ++side)
  {
    std::replace(halves[side].Vertices.begin(), halves[side].Vertices.end(), spine[side], center);
  }
  return halves;
}

int Hierarchy::Age(const Point& vertex) const
{
  if (this->IsBaseCorner(vertex))
  {
    // In an endless lattice, a corner with 3, 2 or 1 coordinates equal to 2^N would be the central
    // vertex of a diamond of class 0, 1 or 2, one scale above the root; the origin is older than
    // all.
    const std::array<int, 4> ages{ -4, -1, -2, -3 };
    return ages[std::count(vertex.begin(), vertex.end(), this->BaseSize())];
  }
  const int index = this->Find(vertex);
  if (index < 0)
  {
    throw std::invalid_argument("no vertex of the hierarchy");
  }
  return this->AllDiamonds[index].Depth;
}

std::array<Point, 2> Hierarchy::YoungerFirst(const Point& a, const Point& b) const
{
  const int ageA = this->Age(a);
  const int ageB = this->Age(b);
  if (ageA == ageB)
  {
    throw std::invalid_argument("the ends of an edge are never of one age");
  }
  return ageA > ageB ? std::array<Point, 2>{ a, b } : std::array<Point, 2>{ b, a };
}

}
