// Ranks that start together: the bytes of one process, and each evaluates the function at its part.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/ThreadRanks.h"
#include "Support/Throws.h"

#include "LatticeShape.h"
#include "LatticeSurface.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestRankedStart
{

namespace
{
constexpr int Nodes = 64;
constexpr double H = VoxelSizeOf(Nodes);

const std::vector<Ball> Balls = { { { -.4, -.3, .1 }, .45 }, { { .5, .3, -.2 }, .35 } };

InitialFunction MakePlain()
{
  return MakeInitialFunction(MakeBalls(Balls));
}

InitialFunction MakeWithRegions()
{
  InitialFunction function = MakePlain();
  function.ForEachRegion = [](const RegionVisitor& visit)
  {
    for (const Ball& ball : Balls)
    {
      TargetRegion region;
      for (int axis = 0; axis < 3; ++axis)
      {
        region.Bounds[2 * axis] = ball.Centre[axis] - ball.Radius;
        region.Bounds[2 * axis + 1] = ball.Centre[axis] + ball.Radius;
      }
      visit(region);
    }
  };
  return function;
}

InitialFunction MakeWithSurface()
{
  const Shape shape = MakeBalls(Balls);
  LatticeShape lattice;
  for (openvdb::Vec3d& axis : lattice.Axis)
  {
    axis *= H;
  }
  for (auto it = openvdb::CoordBBox::createCube(openvdb::Coord(-Nodes / 2), Nodes).begin(); it;
       ++it)
  {
    const openvdb::Vec3d place = lattice.PlaceOf((*it).asVec3d());
    if (shape.Value({ place[0], place[1], place[2] }) < 0.0)
    {
      lattice.Inside.setValueOn(*it);
    }
  }
  InitialFunction function = MakePlain();
  function.Surface = FindSurfacePoints(lattice);
  return function;
}

struct Kind
{
  std::string Name;
  InitialFunction Function;
};

std::vector<Kind> MakeKinds()
{
  std::vector<Kind> kinds = { { "everywhere", MakePlain() }, { "in regions", MakeWithRegions() },
    { "near a surface", MakeWithSurface() } };
  kinds.push_back(kinds[0]);
  kinds.back().Name += ", by one thread";
  kinds.back().Function.ThreadSafe = false;
  return kinds;
}

struct Started
{
  std::unique_ptr<NarrowBand> Band;
  std::size_t Evaluations;
};

// Without ranks, alone.
Started StartOf(InitialFunction function, Agreement* ranks)
{
  std::atomic<std::size_t> evaluations{ 0 };
  const auto evaluate = function.Evaluate;
  function.Evaluate = [&](std::size_t count, const double* points, double* values)
  {
    evaluations += count;
    evaluate(count, points, values);
  };
  Started started{ std::make_unique<NarrowBand>(H), 0 };
  started.Band->SetRanks(ranks);
  EXPECT_TRUE(started.Band->Start(0.0, Box, function, [&](double) { return true; }));
  started.Evaluations = evaluations;
  return started;
}

void CheckOnRanks(const Kind& kind, int size)
{
  const Started alone = StartOf(kind.Function, nullptr);
  std::vector<Started> onRanks(static_cast<std::size_t>(size));
  RunOnRanks(size,
    [&](Agreement& ranks)
    { onRanks[static_cast<std::size_t>(ranks.GetRank())] = StartOf(kind.Function, &ranks); });
  for (const Started& started : onRanks)
  {
    const std::string name = kind.Name + ", one of " + std::to_string(size);
    EXPECT_EQ(alone.Band->Pack(), started.Band->Pack()) << name;
    EXPECT_LT(1.0 * started.Evaluations, 1.25 * alone.Evaluations / size) << name;
  }
}
}

TEST(TestRankedStart, RanksShareTheEvaluationsAndGetTheSameBytes)
{
  for (const Kind& kind : MakeKinds())
  {
    for (const int size : { 2, 3, 5 })
    {
      CheckOnRanks(kind, size);
    }
  }
}

TEST(TestRankedStart, AFunctionThatFailsOnOneRankFailsOnAll)
{
  for (const Kind& kind : MakeKinds())
  {
    RunOnRanks(3,
      [&](Agreement& ranks)
      {
        InitialFunction function = kind.Function;
        if (ranks.GetRank() == 1)
        {
          function.Evaluate = [](std::size_t, const double*, double*)
          { throw std::runtime_error("no such function."); };
        }
        const auto start = [&] { RunTogether(ranks, [&] { StartOf(function, &ranks); }); };
        EXPECT_TRUE(Throws<RankError>(start, "On rank 1 of 3: no such function.")) << kind.Name;
      });
  }
}

}
