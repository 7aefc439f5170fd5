// Exact control of volume or area on surfaces that are not smooth: creases, parts that meet, thin
// sheets. A potential that diverges is an error.

#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

using namespace activesurface;

namespace TestExactControl
{

// Box with these half sides. Outside, the value is the distance to the nearest corner, edge or
// face.
Shape MakeBlock(const Point& centre, const Point& halfSides)
{
  return { [=](const Point& p)
    {
      double inside = -std::numeric_limits<double>::max(), outside = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double beyond = std::fabs(p[axis] - centre[axis]) - halfSides[axis];
        inside = std::max(inside, beyond);
        outside += beyond > 0.0 ? beyond * beyond : 0.0;
      }
      return outside > 0.0 ? std::sqrt(outside) : inside;
    },
    {} };
}

Shape MakeCube()
{
  return MakeBlock({ 0.0, 0.0, 0.0 }, { 0.5, 0.5, 0.5 });
}

Shape MakePlate()
{
  return MakeBlock({ 0.0, 0.0, 0.0 }, { 0.7, 0.7, 0.06 });
}

Shape MakeTwoBlocks()
{
  const Shape left = MakeBlock({ -0.5, 0.0, 0.0 }, { 0.3, 0.3, 0.3 });
  const Shape right = MakeBlock({ 0.5, 0.0, 0.0 }, { 0.3, 0.3, 0.3 });
  return { [=](const Point& p) { return std::min(left.Value(p), right.Value(p)); }, {} };
}

// Advances one substep of any length.
void StepOnce(NarrowBand& band, const Motion& motion, Target& target)
{
  bool first = true;
  band.Advance(band.GetTime() + 10.0, motion, target,
    [&first](double) { return std::exchange(first, false); });
}

struct Scene
{
  std::string Name;
  Shape Start;
  Shape End;
  double Reach;
  double VoxelSize;
  int Parts; //< at most, at any time
};

struct Way
{
  bool IsSound = true; //< all numbers finite, and the skin closed
  int MostParts = 0;
  int LastParts = 0;
  double WorstError = 0.0; //< of the controlled quantity, relative
};

Way Follow(const Scene& scene, Control area, double cfl)
{
  constexpr double bounds[6] = { -1.5, 1.5, -1.5, 1.5, -1.5, 1.5 };
  NarrowBand band(scene.VoxelSize);
  band.SetMaximumNumberOfActiveVoxels(500000); // four times the count of a sound band
  band.Start(0.0, bounds, MakeInitialFunction(scene.Start));
  ShapeTarget target(Normalise(scene.End, scene.Reach));
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Attraction = 20.0;
  motion.CFL = cfl;
  (area == Control::Exact ? motion.AreaControl : motion.VolumeControl) = Control::Exact;
  const auto measure = area == Control::Exact ? &NarrowBand::GetArea : &NarrowBand::GetVolume;
  const double held = (band.*measure)();
  Way way;
  while (band.GetTime() < 0.6)
  {
    StepOnce(band, motion, target);
    const double error = std::fabs((band.*measure)() / held - 1.0);
    const Mesh skin = Polygonise(band);
    const MeshDefects defects = FindDefects(skin);
    way.IsSound = way.IsSound && std::isfinite(error) && defects.Edges == 0 &&
      std::all_of(skin.Points.begin(), skin.Points.end(), [](float x) { return std::isfinite(x); });
    way.WorstError = std::max(way.WorstError, error);
    way.LastParts = GetTopology(skin).Components;
    way.MostParts = std::max(way.MostParts, way.LastParts);
  }
  return way;
}

// Runs at the largest stable time step, slightly below, and well below.
void CheckScene(const Scene& scene, Control area, double tolerance)
{
  for (const double cfl : { 1.0, 0.9, 0.5 })
  {
    const std::string name = scene.Name + ", CFL " + std::to_string(cfl);
    const Way way = Follow(scene, area, cfl);
    EXPECT_TRUE(way.IsSound) << "finite and closed: " << name;
    EXPECT_LT(way.MostParts, scene.Parts + 1) << "most parts at any step: " << name;
    EXPECT_EQ(way.LastParts, 1) << "parts at last: " << name;
    EXPECT_LT(way.WorstError, tolerance) << "largest relative error of all steps: " << name;
  }
}

// The control aims at a relative error of 1e-9. Potentials are floats, hence the tolerance of 1e-6.
TEST(TestExactControl, ACubeKeepsItsVolumeOnItsWayToABall)
{
  const Shape ball = MakeBall({ 0.6, 0.2, 0.1 }, 0.3);
  CheckScene({ "cube", MakeCube(), ball, 0.03, 0.03, 1 }, Control::None, 1e-6);
}

TEST(TestExactControl, ACubeKeepsItsAreaOnItsWayToABall)
{
  const Shape ball = MakeBall({ 0.6, 0.2, 0.1 }, 0.3);
  CheckScene({ "cube", MakeCube(), ball, 0.03, 0.03, 1 }, Control::Exact, 1e-6);
}

TEST(TestExactControl, AThinPlateKeepsItsVolume)
{
  const Shape ball = MakeBall(CentreA, 0.4);
  CheckScene({ "plate", MakePlate(), ball, 0.05, 0.03, 1 }, Control::None, 1e-6);
}

// The tolerance is 1e-5, as for any change of topology.
TEST(TestExactControl, TwoBlocksKeepTheirVolumeWhileTheyMerge)
{
  const Shape ball = MakeBall(CentreB, 0.5);
  CheckScene({ "two blocks", MakeTwoBlocks(), ball, 0.1, 0.04, 2 }, Control::None, 1e-5);
}

// A time step of thirty times the stable one makes the potential diverge.
TEST(TestExactControl, ALostPotentialIsAnErrorAndIsNotTaken)
{
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeCube());
  ShapeTarget target(Normalise(MakeBall({ 0.5, 0.2, 0.1 }, 0.3), 0.03));
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Attraction = 20.0;
  motion.CFL = 30.0;
  std::unique_ptr<NarrowBand> before;
  std::string said;
  for (int substep = 0; substep < 100 && said.empty(); ++substep)
  {
    before = band.Clone();
    try
    {
      StepOnce(band, motion, target);
      EXPECT_TRUE(std::isfinite(band.GetVolume())) << "finite after every substep that is taken";
    }
    catch (const std::runtime_error& error)
    {
      said = error.what();
    }
  }
  EXPECT_TRUE(said.find("diverge") != std::string::npos) << "an error: " << said;
  EXPECT_TRUE(said.find("Lower CFL") != std::string::npos) << "which says what to do";
  EXPECT_EQ(band.GetTime(), before->GetTime()) << "the time stays";
  EXPECT_TRUE(AreIdentical(band, *before)) << "and so does the potential";
  motion.CFL = 0.5;
  const double end = band.GetTime() + 0.1;
  band.Advance(end, motion, target);
  before->Advance(end, motion, target);
  EXPECT_TRUE(AreIdentical(band, *before)) << "with a smaller CFL the motion resumes";
}

TEST(TestExactControl, AStartHasTheTargetsAtOnce)
{
  Motion motion = MakeMotion(0.0, 0.0);
  for (const Shape& shape : { MakeCube(), MakeTwoBlocks() })
  {
    for (const double share : { 0.5, 0.9, 1.1, 2.0 })
    {
      NarrowBand band(VoxelSizeOf(48));
      StartOn(band, shape);
      motion.VolumeControl = Control::Exact;
      motion.AreaControl = Control::None;
      motion.TargetVolume = share * band.GetVolume();
      band.RestoreTargets(motion);
      EXPECT_NEAR(band.GetVolume() / motion.TargetVolume, 1.0, 1e-6) << "volume times " << share;
      EXPECT_EQ(band.GetStartVolume(), band.GetVolume()) << "it counts as the start";
      motion.VolumeControl = Control::None;
      motion.AreaControl = Control::Exact;
      motion.TargetArea = std::pow(share, 2.0 / 3.0) * band.GetArea();
      band.RestoreTargets(motion);
      EXPECT_NEAR(band.GetArea() / motion.TargetArea, 1.0, 1e-6) << "area times " << share;
    }
  }
}

TEST(TestExactControl, AStartWithoutTargetsStaysAsItIs)
{
  NarrowBand band(VoxelSizeOf(48));
  StartOn(band, MakeCube());
  const std::unique_ptr<NarrowBand> before = band.Clone();
  Motion motion = MakeMotion(0.0, 0.0);
  motion.TargetVolume = 5.0; // without a control, or with a penalty
  band.RestoreTargets(motion);
  motion.VolumeControl = Control::Penalty;
  band.RestoreTargets(motion);
  motion.VolumeControl = Control::Exact;
  motion.TargetVolume = 0.0;
  band.RestoreTargets(motion);
  EXPECT_TRUE(AreIdentical(band, *before));
  NarrowBand nothing(VoxelSizeOf(48));
  motion.TargetVolume = 1.0;
  nothing.RestoreTargets(motion);
  EXPECT_TRUE(nothing.IsEmpty());
}

}
