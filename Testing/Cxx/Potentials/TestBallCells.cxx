// Search for the balls near a point or box, compared with a search through all balls.

#include "BallCells.h"

#include "Support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestBallCells
{

namespace
{

using Balls = UnsetVector<BallCells::Ball>;

struct Cloud
{
  const char* Name;
  Point Size;
  Point Offset;
  double Radius;
  double LeastShare; // of a ball, as a fraction of Radius
};

const std::vector<Cloud> Clouds = { { "dense", { 1.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 }, 0.1, 1.0 },
  { "of many sizes", { 1.0, 1.0, 1.0 }, { -0.5, -0.5, -0.5 }, 0.3, 1e-4 },
  { "far from the origin", { 1.0, 1.0, 1.0 }, { 1e9, -1e9, 1e9 }, 0.1, 0.6 },
  { "radius below the rounding", { 1e3, 1e3, 1e3 }, { 1e9, 0.0, 0.0 }, 1e-12, 0.6 },
  { "sparse", { 1e12, 1e12, 1e12 }, { 0.0, 0.0, 0.0 }, 1e-3, 0.6 },
  { "all in one place", { 0.0, 0.0, 0.0 }, { 1.0, 2.0, 3.0 }, 0.1, 1.0 },
  { "in a plane", { 1.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, 0.1, 1.0 },
  { "huge", { 1e99, 1e99, 1e99 }, { 0.0, 0.0, 0.0 }, 1e98, 0.6 } };

Point PointIn(const Cloud& cloud, Random& random)
{
  const Point p = random.In(0.0, 1.0);
  return { cloud.Offset[0] + p[0] * cloud.Size[0], cloud.Offset[1] + p[1] * cloud.Size[1],
    cloud.Offset[2] + p[2] * cloud.Size[2] };
}

Balls MakeBalls(const Cloud& cloud, Random& random, int count = 600)
{
  Balls balls;
  for (int i = 0; i < count; ++i)
  {
    const Point p = PointIn(cloud, random);
    const double share = std::pow(cloud.LeastShare, random.Between(0.0, 1.0));
    balls.push_back({ { p[0], p[1], p[2] }, cloud.Radius * share });
  }
  return balls;
}

// Points and boxes of all sizes up to that of a group, near the balls and anywhere.
std::vector<BallCells::Place> MakePlaces(
  const Cloud& cloud, const Balls& balls, double size, Random& random)
{
  std::vector<BallCells::Place> places;
  for (int i = 0; i < 300; ++i)
  {
    const BallCells::Ball& ball = balls[i % balls.size()];
    const Point at =
      i % 3 ? Point{ ball.Centre[0], ball.Centre[1], ball.Centre[2] } : PointIn(cloud, random);
    const Point away = random.In(-1.5, 1.5), wide = random.In(0.0, i % 2 ? size : 0.0);
    BallCells::Place place;
    for (int axis = 0; axis < 3; ++axis)
    {
      place.Low[axis] = at[axis] + away[axis] * ball.Radius;
      place.High[axis] = place.Low[axis] + wide[axis];
    }
    places.push_back(place);
  }
  return places;
}

bool Touches(const BallCells::Ball& ball, const BallCells::Place& place)
{
  double gap[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double x = ball.Centre[axis];
    gap[axis] = std::max({ place.Low[axis] - x, x - place.High[axis], 0.0 });
  }
  return std::hypot(gap[0], gap[1], gap[2]) <= ball.Radius;
}

// Indices of balls, in the order of their visits.
std::vector<std::size_t> FindHits(const BallCells& cells, const BallCells::Place& place)
{
  std::vector<std::size_t> found;
  cells.VisitHits(place,
    [&](const BallCells::Index* hits, std::size_t count)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        found.push_back(cells.GetOrder()[hits[i]]);
      }
    });
  return found;
}

double LargestOf(const Balls& balls)
{
  return std::max_element(
    balls.begin(), balls.end(), [](const auto& a, const auto& b) { return a.Radius < b.Radius; })
    ->Radius;
}

}

TEST(TestBallCells, FindsWhatTouchesOnce)
{
  for (const Cloud& cloud : Clouds)
  {
    Random random(7);
    const Balls balls = MakeBalls(cloud, random);
    for (const double cellSize : { LargestOf(balls), 0.3 * LargestOf(balls) })
    {
      BallCells cells;
      cells.Build(balls, cellSize);
      std::size_t missed = 0, twice = 0, touching = 0;
      for (const auto& place : MakePlaces(cloud, balls, cells.GetGroupSize(), random))
      {
        const std::vector<std::size_t> hits = FindHits(cells, place);
        const std::set<std::size_t> found(hits.begin(), hits.end());
        twice += hits.size() - found.size();
        for (std::size_t i = 0; i < balls.size(); ++i)
        {
          const bool touches = Touches(balls[i], place);
          touching += touches ? 1 : 0;
          missed += touches && found.count(i) == 0 ? 1 : 0;
        }
      }
      EXPECT_EQ(missed, 0u) << cloud.Name;
      EXPECT_EQ(twice, 0u) << cloud.Name;
      EXPECT_GT(touching, 50u) << cloud.Name;
    }
  }
}

// Float coordinates limit the search: the margin of a ball is 1e-5 of its cell.
TEST(TestBallCells, FindsLittleElse)
{
  for (const Cloud& cloud : { Clouds[0], Clouds[1], Clouds[6] })
  {
    Random random(8);
    const Balls balls = MakeBalls(cloud, random);
    BallCells cells;
    cells.Build(balls, LargestOf(balls));
    std::size_t found = 0, touching = 0;
    for (const auto& place : MakePlaces(cloud, balls, cells.GetGroupSize(), random))
    {
      found += FindHits(cells, place).size();
      touching += std::count_if(
        balls.begin(), balls.end(), [&](const auto& ball) { return Touches(ball, place); });
    }
    EXPECT_LE(found, touching + touching / 1000 + 1) << cloud.Name;
  }
}

// The number of balls is so large that several tasks list them.
TEST(TestBallCells, OrderDoesNotDependOnWhatElseThereIs)
{
  Random random(9);
  const Cloud cloud = { "", { 2.0, 2.0, 2.0 }, { -1.0, -1.0, -1.0 }, 0.2, 0.2 };
  const Balls few = MakeBalls(cloud, random, 20000);
  Balls many;
  std::vector<std::size_t> numbers; // indices of the few among the many
  for (const BallCells::Ball& ball : few)
  {
    numbers.push_back(many.size());
    many.push_back(ball);
    const Point p = random.In(-9.0, 9.0);
    many.push_back({ { p[0], p[1], p[2] }, random.Between(0.01, 0.4) });
  }
  many.push_back({ { 1e30, 0.0, 0.0 }, 1.0 });
  BallCells alone, among;
  alone.Build(few, 0.1);
  among.Build(many, 0.1);
  std::size_t compared = 0;
  for (const auto& place : MakePlaces(cloud, few, 0.0, random))
  {
    std::vector<std::size_t> expected, found;
    for (const std::size_t hit : FindHits(alone, place))
    {
      if (Touches(few[hit], place))
      {
        expected.push_back(numbers[hit]);
      }
    }
    for (const std::size_t hit : FindHits(among, place))
    {
      const bool isOneOfTheFew = std::binary_search(numbers.begin(), numbers.end(), hit);
      if (isOneOfTheFew && Touches(many[hit], place))
      {
        found.push_back(hit);
      }
    }
    EXPECT_EQ(found, expected);
    compared += found.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(compared, 100u);
}

TEST(TestBallCells, NoBallsAreNoHits)
{
  BallCells cells;
  cells.Build({ { { 0.0, 0.0, 0.0 }, 1.0 } }, 1.0);
  cells.Build({}, 1.0);
  EXPECT_TRUE(FindHits(cells, { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } }).empty());
  EXPECT_TRUE(cells.GetOrder().empty());
}

}
