// Ranks that advance a band together share its work: the bytes are those of one process, for any
// number of them and any motion.

#include "Support/AnalyticShapes.h"
#include "Support/CheckedTarget.h"
#include "Support/FailingTarget.h"
#include "Support/SurfaceMeasures.h"
#include "Support/ThreadRanks.h"
#include "Support/Throws.h"

#include "Leaves/RankedLeaves.h"
#include "Leaves/WholeBand.h"
#include "Obstacle.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestRankedBand
{

namespace
{

/** A way of a band: its start, its law, and the times that it is taken to. */
struct Way
{
  std::string Name;
  Motion Law;
  Shape Start;
  std::function<std::unique_ptr<Target>()> MakeTarget;
  std::vector<double> Times;
  std::function<std::unique_ptr<Obstacle>()> MakeObstacle = nullptr;
};

using Band = std::unique_ptr<NarrowBand>;

AdvanceReport Go(NarrowBand& band, const Way& way, Target& target)
{
  const std::unique_ptr<Obstacle> solid = way.MakeObstacle ? way.MakeObstacle() : nullptr;
  Motion law = way.Law;
  law.Solid = solid.get();
  AdvanceReport last;
  for (const double time : way.Times)
  {
    last = band.Advance(time, law, target);
  }
  return last;
}

Band MakeBand(const Way& way)
{
  auto band = std::make_unique<NarrowBand>(VoxelSizeOf(64));
  band->SetNumberOfThreads(1);
  StartOn(*band, way.Start);
  return band;
}

Band RunAlone(const Way& way)
{
  Band band = MakeBand(way);
  Go(*band, way, *way.MakeTarget());
  EXPECT_GT(band->GetWork().Substeps, 0u) << way.Name << " moves";
  return band;
}

bool AreSameReports(const AdvanceReport& a, const AdvanceReport& b)
{
  return a.Substeps == b.Substeps && a.SkippedSubsteps == b.SkippedSubsteps &&
    a.TargetEvaluations == b.TargetEvaluations && a.DroppedSamples == b.DroppedSamples &&
    a.UniformPulls == b.UniformPulls && a.CreatedParts == b.CreatedParts &&
    a.MaxSpeed == b.MaxSpeed && a.Vanished == b.Vanished;
}

void CheckOnRanks(const Way& way)
{
  const Band alone = RunAlone(way);
  for (const int size : { 2, 3, 5 })
  {
    std::vector<Band> bands(static_cast<std::size_t>(size));
    RunOnRanks(size,
      [&](Agreement& ranks)
      {
        Band band = MakeBand(way);
        band->SetRanks(&ranks);
        CheckedTarget target(way.MakeTarget());
        Go(*band, way, target);
        EXPECT_EQ(target.CountAstray(), 0u) << "points near a rank's own leaves, " << way.Name;
        EXPECT_EQ(target.CountNear() > 0, way.Law.Attraction > 0.0) << way.Name;
        bands[static_cast<std::size_t>(ranks.GetRank())] = std::move(band);
      });
    for (int rank = 0; rank < size; ++rank)
    {
      const NarrowBand& band = *bands[static_cast<std::size_t>(rank)];
      const std::string name =
        way.Name + ", rank " + std::to_string(rank) + " of " + std::to_string(size);
      EXPECT_TRUE(AreIdentical(*alone, band)) << "the same potential, " << name;
      EXPECT_EQ(alone->Pack(), band.Pack()) << "the same state, " << name;
      EXPECT_TRUE(AreSameReports(alone->GetWork(), band.GetWork())) << "the same work, " << name;
    }
  }
}

std::unique_ptr<Target> MakeRing()
{
  return std::make_unique<ShapeTarget>(MakeTorus({ 0.01, 0.02, 0.013 }, 0.5, 0.22));
}

constexpr double TimeOfBirth = .25;

/** Three balls of which one moves, and a fourth one that appears. */
RegionTarget MakeMovingBalls()
{
  const auto ballsAt = [](double time)
  {
    std::vector<Ball> balls = { { { -.6, -.5, .1 }, .2 }, { { -.5 + time, .3, -.3 }, .25 },
      { { .5, -.4, .2 }, .3 } };
    if (time > TimeOfBirth)
    {
      balls.push_back({ { .1, .6, .55 }, .18 });
    }
    return balls;
  };
  return { [=](double time) { return MakeBalls(ballsAt(time)); },
    [=](double time)
    {
      std::vector<TargetRegion> regions;
      for (const Ball& ball : ballsAt(time))
      {
        regions.push_back(RegionAround(ball, RegionSeeds::Centre));
      }
      return regions;
    } };
}

std::unique_ptr<Obstacle> MakeBallObstacle()
{
  const auto distances = [](std::size_t count, const double* points, double* values)
  {
    for (std::size_t n = 0; n < count; ++n)
    {
      values[n] = std::hypot(points[3 * n] - .45, points[3 * n + 1], points[3 * n + 2] - .1) - .25;
    }
  };
  return std::make_unique<Obstacle>(VoxelSizeOf(64), distances, true);
}

/** A ball that comes to one that has grown and converged, along an axis. */
std::unique_ptr<Target> MakeComingBall(int axis)
{
  return std::make_unique<ShapeTarget>(
    [axis](double time)
    {
      std::vector<Ball> balls = { { { .03, .03, .03 }, .3 }, { { .03, .03, .03 }, .2 } };
      balls[0].Centre[axis] = .5;
      balls[1].Centre[axis] = -.6 + .6 * time;
      return MakeBalls(balls);
    });
}

Shape MakeThreeBalls()
{
  return MakeBalls(
    { { { -.6, -.5, .1 }, .2 }, { { -.5, .3, -.3 }, .25 }, { { .5, -.4, .2 }, .3 } });
}

Way MakeWay(const char* name, double attraction, double tension)
{
  return { name, MakeMotion(attraction, tension), MakeSixMetaballs(), MakeRing, { .15, .3 } };
}

Way MakeMovingBallsWay()
{
  Way way = MakeWay("moving balls and a new one", 8.0, 0.001);
  way.Law.CreateParts = true;
  way.Start = MakeThreeBalls();
  way.MakeTarget = [] { return std::make_unique<RegionTarget>(MakeMovingBalls()); };
  way.Times = { .1, .2, .3, .4, .5 };
  return way;
}

std::vector<Way> MakeWays()
{
  std::vector<Way> ways = { MakeWay("tracking", 1.0, 0.0),
    MakeWay("tracking under tension", 1.0, 0.02), MakeWay("tension alone", 0.0, 0.02) };
  ways.push_back(MakeWay("penalties", 1.0, 0.02));
  ways.back().Law.AreaControl = ways.back().Law.VolumeControl = Control::Penalty;
  ways.push_back(MakeWay("exact volume", 1.0, 0.02));
  ways.back().Law.VolumeControl = Control::Exact;
  ways.push_back(MakeWay("exact volume, pulled in vain", 1.0, 0.02));
  ways.back().Law.VolumeControl = Control::Exact;
  ways.back().MakeTarget = [] { return std::make_unique<ShapeTarget>(MakeConstant(0.3)); };
  ways.push_back(MakeWay("within walls", 1.0, 0.02));
  ways.back().Law.Box = { true, { -0.6, 0.6, -0.6, 0.6, -0.6, 0.6 } };
  ways.push_back(MakeWay("balls that grow fast", 1.0, 0.0));
  ways.back().Start = MakeThreeBalls();
  ways.back().MakeTarget = [] { return std::make_unique<ShapeTarget>(MakeConstant(-1.0)); };
  for (int axis = 0; axis < 3; ++axis)
  {
    ways.push_back(MakeWay("a ball comes to one that has converged", 40.0, 0.0));
    std::vector<Ball> balls = { { { .03, .03, .03 }, .24 }, { { .03, .03, .03 }, .2 } };
    balls[0].Centre[axis] = .5;
    balls[1].Centre[axis] = -.6;
    ways.back().Start = MakeBalls(balls);
    ways.back().MakeTarget = [axis] { return MakeComingBall(axis); };
    ways.back().Times = { 1.0 };
  }
  ways.push_back(MakeWay("around an obstacle", 1.0, 0.02));
  ways.back().MakeObstacle = MakeBallObstacle;
  ways.push_back(MakeMovingBallsWay());
  return ways;
}

}

TEST(TestRankedBand, AnyNumberOfRanksGivesTheSameBytes)
{
  for (const Way& way : MakeWays())
  {
    CheckOnRanks(way);
  }
}

namespace
{

/** A target that fails, or one that does not. */
using MakeFailing = std::function<FailingTarget(bool fails)>;

FailingTarget FailInThirdSubstep(bool fails)
{
  const FailingTarget::Rule inThird = [](const AskedTarget& asked) { return asked.Moves == 3; };
  return { MakeTorus({ 0, 0, 0 }, .5, .22), fails ? inThird : nullptr };
}

// The substep that fails on one rank is not taken by any, and they can go on from there.
void CheckFailure(const Way& way, const MakeFailing& make)
{
  constexpr int size = 3;
  std::vector<Band> bands(size), later(size);
  std::vector<std::string> sentences(size);
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      const auto rank = static_cast<std::size_t>(ranks.GetRank());
      bands[rank] = MakeBand(way);
      bands[rank]->SetRanks(&ranks);
      FailingTarget target = make(rank == 1);
      try
      {
        bands[rank]->Advance(way.Times.back(), way.Law, target);
      }
      catch (const RankError& error)
      {
        sentences[rank] = error.what();
      }
      later[rank] = bands[rank]->Clone();
      later[rank]->SetRanks(&ranks);
      FailingTarget sound = make(false);
      later[rank]->Advance(way.Times.back(), way.Law, sound);
    });
  const Band alone = MakeBand(way);
  FailingTarget target = make(true);
  EXPECT_THROW(alone->Advance(way.Times.back(), way.Law, target), std::runtime_error) << way.Name;
  EXPECT_GT(alone->GetTime(), 0.0) << way.Name;
  FailingTarget sound = make(false);
  const Band aloneLater = alone->Clone();
  aloneLater->Advance(way.Times.back(), way.Law, sound);
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    EXPECT_EQ(sentences[rank], "On rank 1 of 3: no such target.") << way.Name;
    EXPECT_EQ(alone->GetTime(), bands[rank]->GetTime()) << way.Name << ", rank " << rank;
    EXPECT_TRUE(AreIdentical(*alone, *bands[rank])) << way.Name << ", rank " << rank;
    EXPECT_TRUE(AreIdentical(*aloneLater, *later[rank])) << way.Name << ", later, rank " << rank;
  }
}

}

TEST(TestRankedBand, ASubstepThatFailsOnOneRankIsTakenByNone)
{
  Way way = MakeWay("tracking under tension", 1.0, 0.02);
  CheckFailure(way, FailInThirdSubstep);
}

// As where memory ended on one of them: nothing is better than a skin of which parts are old.
TEST(TestRankedBand, RanksWhoseTablesDifferLoseTheSkin)
{
  RunOnRanks(2,
    [](Agreement& ranks)
    {
      openvdb::FloatTree tree(Far);
      for (int leaf = 0; leaf < 3 + ranks.GetRank(); ++leaf)
      {
        tree.touchLeaf({ 8 * leaf, 0, 0 });
      }
      LeafTable table;
      table.SetBackground(Far);
      table.Rebuild(tree);
      RankedLeaves shared(ranks, table);
      table.SetRanks(&shared);
      EXPECT_TRUE(Throws<RankError>([&] { LeaveRanks(table, tree); }, "lost each other's skin"));
      EXPECT_EQ(table.GetRanks(), nullptr);
      EXPECT_EQ(table.Size(), 0u);
    });
}

}
