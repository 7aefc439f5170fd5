// Creation of parts in combination with other features: empty surfaces, restarts, walls, steady
// states, wrong or too large input.

#include "NarrowBandGrid.h"
#include "Support/RegionTargets.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace activesurface;
using namespace activesurface::twoballs;

namespace TestNewPartsRules
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

TEST(TestNewPartsRules, EmptySurfaceBegins)
{
  RegionTarget target = MakeStandingBalls({ Right });
  const auto band = StartWith(MakeConstant(1.0));
  ASSERT_TRUE(band->IsEmpty());
  Motion motion = MakeCreating();
  motion.Tension = 0.001;
  const AdvanceReport report = band->Advance(0.1, motion, target);
  EXPECT_EQ(report.CreatedParts, 1u);
  EXPECT_FALSE(report.Vanished);
  CheckSound(*band, { 1, 0, 2 });
  RegionTarget nothing = MakeStandingBalls({});
  const auto empty = StartWith(MakeConstant(1.0));
  EXPECT_TRUE(empty->Advance(0.1, motion, nothing).Vanished);
  EXPECT_EQ(empty->GetTime(), 0.1);
}

TEST(TestNewPartsRules, RestartGivesTheSameBytes)
{
  RegionTarget target = MakeMovingBalls(
    [](double time) {
      return std::vector<Ball>{ Left, { Right.Centre, 0.01 + 0.3 * time } };
    });
  const auto whole = StartWith(MakeBalls({ Left }));
  Motion motion = MakeCreating(10.0);
  motion.LongestStep = 0.01;
  whole->Advance(0.2, motion, target);
  const auto again = NarrowBand::Unpack(whole->Pack());
  const auto fromGrid = FromGrid(*ToGrid(*whole));
  EXPECT_TRUE(AreIdentical(*whole, *again));
  for (NarrowBand* band : { whole.get(), again.get(), fromGrid.get() })
  {
    band->Advance(0.4, motion, target);
  }
  CheckSound(*whole, { 2, 0, 4 });
  EXPECT_TRUE(AreIdentical(*whole, *again));
  EXPECT_TRUE(AreIdentical(*whole, *fromGrid));
}

TEST(TestNewPartsRules, WallsCutThem)
{
  const Ball beyond = { { 0.5, 0.7, 0.0 }, 0.1 };
  RegionTarget target = MakeStandingBalls({ Left, Right, beyond });
  Motion motion = MakeCreating();
  motion.Box = { true, { -0.9, 0.6, -0.5, 0.5, -0.9, 0.9 } };
  const auto band = StartWith(MakeBalls({ Left }));
  EXPECT_EQ(band->Advance(1e-3, motion, target).CreatedParts, 1u);
  CheckSound(*band, { 2, 0, 4 });
  const Mesh mesh = Polygonise(*band);
  double most = -1.0;
  for (std::size_t v = 0; v < mesh.GetNumberOfPoints(); ++v)
  {
    most = std::max(most, mesh.GetPoint(v)[0]);
  }
  // The rim is accurate to 0.14 voxel (method.md of LevelSet).
  EXPECT_LE((most - 0.6) / H, 0.14);
}

TEST(TestNewPartsRules, SteadyStateHasThem)
{
  RegionTarget target = MakeStandingBalls({ Left, Right });
  const auto band = StartWith(MakeBalls({ Left }));
  const AdvanceReport report = band->AdvanceToSteadyState(MakeCreating(), {}, target);
  EXPECT_TRUE(report.IsSteady);
  EXPECT_EQ(report.CreatedParts, 1u);
  // A part created in the last substep has not been observed to be steady.
  EXPECT_GE(report.Substeps + report.SkippedSubsteps, 2u);
  CheckSound(*band, { 2, 0, 4 });
}

// The penalty of a tiny area removes each new part at once, in short substeps. Creating the part
// again in each of them would take minutes.
TEST(TestNewPartsRules, PenaltyRemovesThemOnceInAFrame)
{
  RegionTarget target = MakeStandingBalls({ Right });
  Motion motion = MakeCreating();
  motion.AreaControl = Control::Penalty;
  motion.TargetArea = 1e-3;
  const auto band = StartWith(MakeConstant(1.0));
  for (const double time : { 0.01, 0.02 })
  {
    const AdvanceReport report = band->Advance(time, motion, target);
    EXPECT_TRUE(report.Vanished);
    EXPECT_EQ(report.CreatedParts, 1u) << "until " << time;
    EXPECT_EQ(band->GetTime(), time);
  }
  for (int run = 0; run < 2; ++run)
  {
    const AdvanceReport report = band->AdvanceToSteadyState(motion, {}, target);
    EXPECT_TRUE(report.IsSteady && report.Vanished);
    EXPECT_EQ(report.CreatedParts, 1u) << "run " << run;
  }
}

TEST(TestNewPartsRules, NothingFiniteCreatesNothing)
{
  Shape spoilt = {
    [](const Point& point) { return point[0] > 0.0 ? NaN : MakeBalls({ Left }).Value(point); }, {}
  };
  TargetRegion wrong = RegionAround(Right, RegionSeeds::AllNodes);
  wrong.Bounds[3] = NaN;
  TargetRegion turned = RegionAround(Right, RegionSeeds::Centre);
  std::swap(turned.Bounds[0], turned.Bounds[1]);
  const std::vector<std::pair<Shape, std::vector<TargetRegion>>> cases = {
    { spoilt,
      { RegionAround(Right, RegionSeeds::AllNodes),
        RegionAround(Right, RegionSeeds::PartAtCentre) } },
    { MakeBalls({ Left, Right }), {} }, { MakeBalls({ Left, Right }), { wrong, turned } }
  };
  for (const auto& [shape, regions] : cases)
  {
    RegionTarget target = MakeStanding(shape, regions);
    const auto band = StartWith(MakeBalls({ Left }));
    EXPECT_EQ(band->Advance(0.1, MakeCreating(), target).CreatedParts, 0u);
    CheckSound(*band, { 1, 0, 2 });
  }
}

TEST(TestNewPartsRules, MoreThanTheMaximumIsRefused)
{
  const Ball large = { Right.Centre, 0.4 };
  RegionTarget bounded = MakeStandingBalls({ { Left.Centre, 0.2 }, large });
  RegionTarget unbounded =
    MakeStanding({ [](const Point& point) { return point[0] > 0.1 ? -1.0 : 0.2; }, {} },
      { RegionAround(Right, RegionSeeds::PartAtCentre) });
  for (RegionTarget* target : { &bounded, &unbounded })
  {
    const auto band = StartWith(MakeBalls({ { Left.Centre, 0.2 } }));
    band->SetMaximumNumberOfActiveVoxels(band->GetNumberOfActiveNodes() + 1000);
    const auto before = band->Clone();
    EXPECT_TRUE(Throws<std::runtime_error>(
      [&] { band->Advance(1e-3, MakeCreating(), *target); }, "MaximumNumberOfActiveVoxels"));
    EXPECT_TRUE(AreIdentical(*band, *before));
  }
}

TEST(TestNewPartsRules, PaperHasNone)
{
  RegionTarget target = MakeStandingBalls({ Left, Right });
  const auto band = StartWith(MakeBalls({ Left }));
  Motion motion = MakeCreating();
  motion.Paper = true;
  EXPECT_TRUE(
    Throws<std::invalid_argument>([&] { band->Advance(0.1, motion, target); }, "CreateParts"));
}
}
