// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Fan.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** Keeps the least squares' equations solvable where samples tell nothing of some direction. */
constexpr double LittleWeight = 0.01;

Hole::Place Between(const Hole::Place& from, const Hole::Place& to)
{
  return { to[0] - from[0], to[1] - from[1] };
}

double SquaredLength(const Hole::Place& way)
{
  return way[0] * way[0] + way[1] * way[1];
}

}

void Fan::Begin(const Hole& hole, const ByTriangle<Vector>& ring, const ByTriangle<Vector>& normals)
{
  this->Around = hole;
  this->Ring = ring;
  this->Normals = normals;
  this->Samples.clear();
  this->Seen.clear();
  this->Distances.clear();
  this->Now = {};
  for (int i = 0; i < hole.Count; ++i)
  {
    this->Now.Sine = std::min(this->Now.Sine, SmallestSine({}, ring[i], ring[this->After(i)]));
  }
}

void Fan::Add(const Sample& sample)
{
  const double distance = Dot(sample.From, this->Normals[sample.Triangle]);
  this->Samples.push_back(sample);
  this->Seen.push_back(this->Around.See(sample.From));
  this->Distances.push_back(distance);
  this->Now.Squares += distance * distance;
  this->Now.Allowed += sample.Allowance * sample.Allowance;
}

bool Fan::FindBetter(double leastSine)
{
  this->Best = Nothing;
  double most = this->Now.MostSquares();
  const Candidates candidates = this->FindCandidates();
  for (auto at = candidates.begin(); at != candidates.end(); ++at)
  {
    const bool isNew = *at != Nothing && std::find(candidates.begin(), at, *at) == at;
    if (isNew && this->Draw(*at) && this->New.Sine >= std::min(this->Now.Sine, leastSine) &&
      this->TakesSamples(*at, most) && this->New.IsBetterThan(this->Now))
    {
      most = this->New.Squares;
      this->Best = *at;
      this->BestNormals = this->NewNormals;
      this->BestTriangles.swap(this->NewTriangles);
    }
  }
  return this->Best != Nothing;
}

Fan::Candidates Fan::FindCandidates() const
{
  const Vector move = this->LeastSquaresMove();
  const Hole::Place centre = this->Centre();
  const Hole::Place half = { 0.5 * centre[0], 0.5 * centre[1] };
  Candidates best;
  best.fill(Nothing);
  std::array<double, 4> least;
  least.fill(HUGE_VAL);
  for (std::size_t i = 0; i < this->Samples.size(); ++i)
  {
    if (!this->Samples[i].IsPoint)
    {
      continue;
    }
    const Vector off = this->Samples[i].From - move;
    const std::array<double, 4> costs = { Dot(off, off), -std::abs(this->Distances[i]),
      SquaredLength(Between(this->Seen[i], centre)), SquaredLength(Between(this->Seen[i], half)) };
    for (std::size_t k = 0; k < costs.size(); ++k)
    {
      if (costs[k] < least[k])
      {
        least[k] = costs[k];
        best[k] = i;
      }
    }
  }
  return best;
}

/** Where the sum of squared distances would be least, if the vertex moved a triangle's plane by its
 *  own move across it at the vertex, by nothing at the far edge, and linearly between. */
Vector Fan::LeastSquaresMove() const
{
  Vector squares{};  // of x, y, z
  Vector products{}; // of y and z, z and x, x and y
  Vector right{};
  for (std::size_t i = 0; i < this->Samples.size(); ++i)
  {
    const int triangle = this->Samples[i].Triangle;
    const Hole::Place& from = this->Around.Places[triangle];
    const Hole::Place edge = Between(from, this->Around.Places[this->After(triangle)]);
    const double part = 1.0 - Cross2(this->Seen[i], edge) / Cross2(from, edge);
    const Vector row = part * this->Normals[triangle];
    squares = squares + Vector{ row[0] * row[0], row[1] * row[1], row[2] * row[2] };
    products = products + Vector{ row[1] * row[2], row[2] * row[0], row[0] * row[1] };
    right = right + this->Distances[i] * row;
  }
  const double little = LittleWeight * (squares[0] + squares[1] + squares[2]);
  const auto [a, b, c] = squares + Vector{ little, little, little };
  const auto [d, e, f] = products;
  // By cofactors of the symmetric matrix.
  const Vector x = { b * c - d * d, d * e - f * c, f * d - b * e };
  const Vector y = { x[1], a * c - e * e, e * f - a * d };
  const Vector z = { x[2], y[2], a * b - f * f };
  const double determinant = Dot(x, { a, f, e });
  return determinant > 0.0
    ? (1.0 / determinant) * Vector{ Dot(x, right), Dot(y, right), Dot(z, right) }
    : Vector{};
}

/** Of the polygon. */
Hole::Place Fan::Centre() const
{
  Hole::Place sum{};
  double area = 0.0; // six times
  for (int i = 0; i < this->Around.Count; ++i)
  {
    const Hole::Place& a = this->Around.Places[i];
    const Hole::Place& b = this->Around.Places[this->After(i)];
    const double twice = Cross2(a, b);
    area += 3.0 * twice;
    sum = { sum[0] + twice * (a[0] + b[0]), sum[1] + twice * (a[1] + b[1]) };
  }
  return { sum[0] / area, sum[1] / area };
}

/** Draws the triangles around another point, a sample. @return whether all are seen from above */
bool Fan::Draw(std::size_t point)
{
  const Vector& from = this->Samples[point].From;
  this->New = {};
  for (int i = 0; i < this->Around.Count; ++i)
  {
    const Vector& a = this->Ring[i];
    const Vector& b = this->Ring[this->After(i)];
    const Vector across = Cross(a - from, b - from);
    const double length = std::sqrt(Dot(across, across));
    if (!(Dot(across, this->Around.Normal) > this->Around.LeastCosine * length))
    {
      return false;
    }
    this->NewNormals[i] = (1.0 / length) * across;
    this->Spokes[i] = Between(this->Seen[point], this->Around.Places[i]);
    this->New.Sine = std::min(this->New.Sine, SmallestSine(from, a, b));
  }
  return true;
}

/** Puts all samples over what was drawn around a point. @param most squares
 *  @return whether each is near enough, and all of them together are */
bool Fan::TakesSamples(std::size_t point, double most)
{
  ByTriangle<double> heights;
  for (int i = 0; i < this->Around.Count; ++i)
  {
    heights[i] = Dot(this->Samples[point].From, this->NewNormals[i]);
  }
  this->NewTriangles.resize(this->Samples.size());
  for (std::size_t k = 0; k < this->Samples.size(); ++k)
  {
    const Sample& sample = this->Samples[k];
    const Hole::Place from = Between(this->Seen[point], this->Seen[k]);
    const auto isOver = [&](int i)
    {
      return Cross2(this->Spokes[i], from) >= 0.0 &&
        Cross2(from, this->Spokes[this->After(i)]) >= 0.0;
    };
    int at = sample.Triangle; // mostly the same one
    for (int turns = 0; !isOver(at); at = this->After(at))
    {
      if (++turns == this->Around.Count)
      {
        return false;
      }
    }
    const double distance = Dot(sample.From, this->NewNormals[at]) - heights[at];
    this->New.Squares += distance * distance;
    if (!(std::abs(distance) <= sample.Allowance) || !(this->New.Squares <= most))
    {
      return false;
    }
    this->NewTriangles[k] = at;
  }
  return true;
}

}
