#include "Index/ElementIndex.h"

#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Maximum number of balls of a segment. A segment of up to MostBalls radii has one ball per radius
// of length; a longer segment has MostBalls larger balls.
constexpr double MostBalls = 64.0;
// Factor of squared radii: allows for the rounding of squared distances.
constexpr double Rounding = 1.0 + 1e-9;

}

void ElementIndex::AddBall(const double centre[3], double radius)
{
  this->Add(
    { { centre[0], centre[1], centre[2] }, { centre[0], centre[1], centre[2] }, radius, radius });
}

void ElementIndex::Add(const Capsule& support)
{
  const bool isFirst = this->Supports.empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low =
      std::min(support.Start[axis] - support.StartRadius, support.End[axis] - support.EndRadius);
    const double high =
      std::max(support.Start[axis] + support.StartRadius, support.End[axis] + support.EndRadius);
    double* bounds = this->Bounds + 2 * axis;
    bounds[0] = isFirst ? low : std::min(bounds[0], low);
    bounds[1] = isFirst ? high : std::max(bounds[1], high);
  }
  this->Supports.push_back(support);
}

void ElementIndex::Build()
{
  double farthest = 0.0;
  for (int side = 0; side < 6 && !this->Supports.empty(); ++side)
  {
    farthest = std::max(farthest, std::fabs(this->Bounds[side]));
  }
  this->Slack = 32.0 * std::numeric_limits<double>::epsilon() * farthest;
  this->Balls.clear();
  for (std::size_t i = 0; i < this->Supports.size(); ++i)
  {
    this->AddBalls(static_cast<Index>(i), this->Supports[i]);
  }
  if (this->Balls.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw std::length_error(
      "The skeleton has too many points and segments: its index needs more than 2^31 - 1 balls, up "
      "to 64 for each segment; use fewer elements.");
  }
  this->MakeLattices();
  this->FillCells();
}

// Adds balls that together contain the support.
void ElementIndex::AddBalls(Index element, const Capsule& support)
{
  double edge[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    edge[axis] = support.End[axis] - support.Start[axis];
  }
  const double length = std::hypot(edge[0], edge[1], edge[2]);
  const double radius = std::max(support.StartRadius, support.EndRadius);
  const int pieces = static_cast<int>(std::clamp(std::ceil(length / radius), 1.0, MostBalls));
  const double reach = radius + 0.5 * length / pieces + (length > 0.0 ? this->Slack : 0.0);
  for (int piece = 0; piece < pieces; ++piece)
  {
    Ball ball{ {}, reach, element };
    for (int axis = 0; axis < 3; ++axis)
    {
      const double middle = (piece + 0.5) / pieces;
      ball.Centre[axis] = support.Start[axis] + (length > 0.0 ? middle * edge[axis] : 0.0);
    }
    this->Balls.push_back(ball);
  }
}

// Returns the number of a ball's lattice: the binary exponent of the larger of the radius and
// Slack.
int ElementIndex::LevelOf(const Ball& ball) const
{
  return std::ilogb(std::max(ball.Radius, this->Slack));
}

void ElementIndex::MakeLattices()
{
  this->Lattices.clear();
  for (const Ball& ball : this->Balls)
  {
    const int level = this->LevelOf(ball);
    auto lattice = std::find_if(this->Lattices.begin(), this->Lattices.end(),
      [level](const Lattice& other) { return other.Number == level; });
    if (lattice == this->Lattices.end())
    {
      this->Lattices.push_back({ level, 0.0 });
      lattice = std::prev(this->Lattices.end());
    }
    lattice->CellSize = std::max({ lattice->CellSize, ball.Radius, this->Slack });
  }
  std::sort(this->Lattices.begin(), this->Lattices.end(),
    [](const Lattice& a, const Lattice& b) { return a.Number < b.Number; });
}

// Sorts the balls by cell (counting sort).
void ElementIndex::FillCells()
{
  const std::size_t count = this->Balls.size();
  this->Cells.Clear(count);
  this->CellOfBall.resize(count);
  this->Starts.assign(1, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Ball& ball = this->Balls[i];
    const int level = this->LevelOf(ball);
    const Lattice& lattice = *std::find_if(this->Lattices.begin(), this->Lattices.end(),
      [level](const Lattice& other) { return other.Number == level; });
    std::int64_t cell[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = static_cast<std::int64_t>(CellOf(ball.Centre[axis], lattice.CellSize));
    }
    this->CellOfBall[i] = static_cast<Index>(this->Cells.Add(KeyOf(lattice, cell)));
    if (this->CellOfBall[i] + 2 > this->Starts.size())
    {
      this->Starts.push_back(0);
    }
    ++this->Starts[this->CellOfBall[i] + 1];
  }
  for (std::size_t cell = 1; cell < this->Starts.size(); ++cell)
  {
    this->Starts[cell] += this->Starts[cell - 1];
  }
  for (std::vector<double>* column : { &this->X, &this->Y, &this->Z, &this->Radius2 })
  {
    column->resize(count);
  }
  this->Elements.resize(count);
  for (std::size_t i = count; i-- > 0;)
  {
    const Ball& ball = this->Balls[i];
    const Index at = --this->Starts[this->CellOfBall[i] + 1];
    this->X[at] = ball.Centre[0];
    this->Y[at] = ball.Centre[1];
    this->Z[at] = ball.Centre[2];
    this->Radius2[at] = ball.Radius * ball.Radius * Rounding;
    this->Elements[at] = ball.Element;
  }
  // Starts[c + 1] now is the start of cell c.
  this->Starts.erase(this->Starts.begin());
  this->Starts.push_back(static_cast<Index>(count));
}

bool ElementIndex::FindCell(const double x[3], NodeIndex& cell) const
{
  constexpr double farthest = 1 << 30;
  bool isNear = !this->Lattices.empty();
  for (int axis = 0; axis < 3 && isNear; ++axis)
  {
    const double place = CellOf(x[axis], this->Lattices.front().CellSize);
    isNear = std::fabs(place) < farthest;
    cell[axis] = isNear ? static_cast<int>(place) : 0;
  }
  return isNear;
}

}
