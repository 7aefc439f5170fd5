// A substep that fails midway leaves the potential unchanged.

#include "Support/AnalyticShapes.h"
#include "Support/FailingTarget.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

using namespace activesurface;

namespace TestFailedSubsteps
{
const double H = VoxelSizeOf(64);

/** Fails after this number of evaluations. */
FailingTarget::Rule FailAfter(int evaluations)
{
  return [evaluations](const AskedTarget& asked) { return asked.Evaluations > evaluations; };
}

bool Fails(NarrowBand& band, double time, const Motion& motion, Target& target)
{
  try
  {
    band.Advance(time, motion, target);
  }
  catch (const std::runtime_error&)
  {
    return true;
  }
  return false;
}

TEST(TestFailedSubsteps, AnErrorHalfWayKeepsTheLastSubstep)
{
  for (const double tension : { 0.0, .001 })
  {
    int failures = 0;
    for (int evaluations = 0; evaluations < 4000; evaluations += 150)
    {
      NarrowBand band(H);
      StartOn(band, MakeBall(CentreA, .3));
      const auto before = band.Clone();
      FailingTarget target(MakeBall(CentreA, .7), FailAfter(evaluations));
      if (Fails(band, .5, MakeMotion(1.0, tension), target))
      {
        ++failures;
        if (band.GetTime() == 0.0)
        {
          EXPECT_TRUE(AreIdentical(*before, band)) << evaluations << " evaluations";
        }
      }
    }
    EXPECT_GT(failures, 3) << "targets that failed, tension " << tension;
  }
}

/** A moving ball, and two balls that appear. New leaves precede the leaves of the moving ball in
 * the tree. The large ball contains leaves that are entirely inside. */
RegionTarget MakeBirths()
{
  const auto ballsAt = [](double time)
  {
    return std::vector<Ball>{ { { .55 + time, .5, .5 }, .3 }, { { -.4, -.4, -.4 }, .5 },
      { { -.5, .6, .6 }, .15 } };
  };
  return { [ballsAt](double time) { return MakeBalls(ballsAt(time)); },
    [ballsAt](double time)
    {
      std::vector<TargetRegion> regions;
      for (const Ball& ball : ballsAt(time))
      {
        regions.push_back(RegionAround(ball, RegionSeeds::PartAtCentre));
      }
      return regions;
    } };
}

// Leaves get new numbers when parts are created.
TEST(TestFailedSubsteps, AnErrorAfterABirthTakesTheBirthBack)
{
  Motion motion = MakeMotion(1.0, .001);
  motion.CreateParts = true;
  NarrowBand band(H);
  StartOn(band, MakeBall({ .55, .5, .5 }, .3));
  const auto before = band.Clone();
  FailingTarget sound(MakeBirths(), nullptr);
  sound.MoveTo(0.0);
  ASSERT_EQ(band.Clone()->CreateParts(motion, sound), 2u);
  const int ofBirths = sound.CountEvaluations();
  FailingTarget target(
    MakeBirths(), [ofBirths](const AskedTarget& asked) { return asked.Evaluations > ofBirths; });
  EXPECT_TRUE(Fails(band, .05, motion, target));
  EXPECT_EQ(band.GetWork().CreatedParts, 2u) << "before the error";
  EXPECT_EQ(band.GetTime(), 0.0);
  EXPECT_TRUE(AreIdentical(*before, band));
  EXPECT_EQ(band.Pack(), before->Pack());
}

TEST(TestFailedSubsteps, ATooSmallStepTakesTheBirthBack)
{
  Motion motion = MakeMotion(1.0, .001);
  motion.CreateParts = true;
  motion.LongestStep = 1e-60;
  NarrowBand band(H);
  StartOn(band, MakeBall({ .55, .5, .5 }, .3));
  const auto before = band.Clone();
  FailingTarget target(MakeBirths(), nullptr);
  EXPECT_TRUE(Fails(band, .05, motion, target));
  EXPECT_EQ(band.GetWork().CreatedParts, 2u) << "before the error";
  EXPECT_EQ(band.GetTime(), 0.0);
  EXPECT_TRUE(AreIdentical(*before, band));
}

}
