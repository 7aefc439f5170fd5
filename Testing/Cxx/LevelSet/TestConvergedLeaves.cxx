// Converged parts of a surface are skipped: they stay unchanged, cost little, and give the same
// result as if they had not been skipped.

#include "NarrowBandGrid.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestConvergedLeaves
{

namespace
{
constexpr double Support = 0.45;
constexpr double Threshold = 0.5;
constexpr Point Left = { -0.637, 0.011, 0.023 };
constexpr Point Right = { 0.641, -0.017, 0.009 };
const double VoxelSize = VoxelSizeOf(64);

using Way = std::function<Point(double)>;

Shape MakePair(const Point& left, const Point& right)
{
  return MakeMetaballs({ left, right }, Support, Threshold);
}

// Two metaballs, the right one moving along a path. Only values within its support change.
class PairTarget : public ShapeTarget
{
public:
  PairTarget(Way path, bool tells)
    : ShapeTarget([path](double time) { return MakePair(Left, path(time)); })
    , Path(std::move(path))
    , Tells(tells)
  {
  }

  void MoveTo(double time) override
  {
    this->Before = this->Now;
    this->Now = this->Path(time);
    ShapeTarget::MoveTo(time);
  }

  bool MayHaveChanged(const double bounds[6]) const override
  {
    return !this->Tells ||
      (this->Before != this->Now && (Touches(this->Before, bounds) || Touches(this->Now, bounds)));
  }

private:
  static bool Touches(const Point& centre, const double bounds[6])
  {
    bool touches = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      touches = touches && centre[axis] + Support >= bounds[2 * axis] &&
        centre[axis] - Support <= bounds[2 * axis + 1];
    }
    return touches;
  }

  Way Path;
  bool Tells;
  Point Before{}, Now{};
};

// With the second tension the balls are in a steady state 0.2 voxel within their target.
constexpr double Tensions[] = { 0.0, 0.01 };

Motion MakeMotion(double tension)
{
  Motion motion = activesurface::MakeMotion(1.0, 0.0);
  motion.Attraction = 5.0;
  motion.Tension = tension;
  return motion;
}

Point Stay(double)
{
  return Right;
}

// Static until time 2, then swings up and down.
Point Swing(double time)
{
  return { Right[0], Right[1] + (time < 2.0 ? 0.0 : 0.2 * std::sin(3.0 * (time - 2.0))), Right[2] };
}

// Static until time 2, then approaches the left metaball.
Point Approach(double time)
{
  return { Right[0] - 0.8 * std::min(std::max(time - 2.0, 0.0), 1.0), Right[1], Right[2] };
}

// Advances to the steady state, at time 2.
void Rest(NarrowBand& band, double tension, Target& target)
{
  StartOn(band, MakePair(Left, Right));
  const AdvanceReport report = band.Advance(2.0, MakeMotion(tension), target);
  EXPECT_GT(report.SkippedSubsteps, 0u) << "substeps that were skipped before time 2";
}

std::vector<float> GetLeftHalf(const NarrowBand& band)
{
  std::vector<float> values;
  for (auto node = GetPotential(band)->cbeginValueOn(); node; ++node)
  {
    if (node.getCoord()[0] < 0)
    {
      values.push_back(*node);
    }
  }
  return values;
}

}

TEST(TestConvergedLeaves, WhatRestsStaysToTheBitWhileTheOtherPartMoves)
{
  for (const double tension : Tensions)
  {
    NarrowBand band(VoxelSize);
    PairTarget target(Swing, true);
    Rest(band, tension, target);
    const std::vector<float> before = GetLeftHalf(band);
    EXPECT_GT(before.size(), 1000u) << "active nodes left of 0";
    const AdvanceReport report = band.Advance(2.5, MakeMotion(tension), target);
    EXPECT_TRUE(GetLeftHalf(band) == before) << "the left ball is the same to the bit";
    EXPECT_LT(report.SkippedSubsteps, 2u)
      << "substeps in which nothing moved: the first, until the target does";

    // The skin follows the right metaball, of the speed U, with a lag of about U / Attraction.
    // Tension adds an offset of about 2 / r * Tension / Attraction. The target's slope, 3.8,
    // reduces lag and offset.
    const double lag = 0.2 * 3.0 * std::cos(1.5) / 5.0 / VoxelSize;
    const double within = 2.0 * tension / (Support * 0.5) / 5.0 / VoxelSize;
    const double off =
      GetDeviation(Polygonise(band), MakePair(Left, Swing(2.5)), VoxelSize).LargestDistance;
    EXPECT_LT(off, 2.0 * (lag + within)) << "farthest from the target [h]";
  }
}

// The steady state is the same as if no leaf had ever been skipped.
TEST(TestConvergedLeaves, RestUnderTensionIsTheBalance)
{
  NarrowBand resting(VoxelSize), settled(VoxelSize);
  PairTarget one(Stay, true), other(Stay, true);
  Rest(resting, Tensions[1], one);
  StartOn(settled, MakePair(Left, Right));
  settled.AdvanceToSteadyState(MakeMotion(Tensions[1]), { 1e-6, 2000 }, other);
  const double volume = settled.GetVolume();
  const double voxels = (resting.GetVolume() - volume) / (settled.GetArea() * VoxelSize);
  EXPECT_NEAR(voxels, 0.0, 1e-3) << "mean distance between both [h]";
  // No point moves faster than the limit: a thousandth of a voxel times Attraction.
  const AdvanceReport next =
    resting.Clone()->AdvanceToSteadyState(MakeMotion(Tensions[1]), { 0.0, 1 }, one);
  EXPECT_LT(next.SurfaceSpeed, 1e-3 * 5.0) << "largest speed of the steady surface [h/time]";
  const AdvanceReport report = resting.Advance(40.0, MakeMotion(Tensions[1]), one);
  EXPECT_EQ(report.Substeps, 0u) << "substeps that are not skipped, from then on";
}

// Convergence is measured by the differences of the scheme in use.
TEST(TestConvergedLeaves, CentralDifferencesComeToRestToo)
{
  NarrowBand band(VoxelSize);
  PairTarget target(Stay, true);
  StartOn(band, MakePair(Left, Right));
  Motion motion = MakeMotion(Tensions[1]);
  motion.Gradient = GradientScheme::Central;
  band.Advance(4.0, motion, target);
  const AdvanceReport report = band.Advance(6.0, motion, target);
  EXPECT_GT(report.SkippedSubsteps, 0u) << "substeps at rest";
  EXPECT_EQ(report.Substeps, 0u) << "other substeps";
}

// A dent of the target wakes the surface at any point within a leaf. The dent is half a voxel deep
// and smaller than a leaf. The body loses the dent's volume, less what Tension fills.
TEST(TestConvergedLeaves, ADentWakesTheSurfaceAnywhere)
{
  const Ball ball = { { 0.013, -0.007, 0.021 }, 0.6 };
  const double width = 1.5 * VoxelSize, depth = 0.5 * VoxelSize;
  const double volume = depth * 2.0 * std::acos(-1.0) * width * width;
  NarrowBand whole(VoxelSize);
  const Shape sphere = MakeBall(ball.Centre, ball.Radius);
  ShapeTarget still(sphere);
  const Motion motion = MakeMotion(1e-4);
  StartOn(whole, sphere);
  whole.Advance(4.0, motion, still);
  constexpr int places = 40;
  for (int i = 0; i < places; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / places, angle = 2.4 * i;
    const double across = ball.Radius * std::sqrt(1.0 - z * z);
    const Point middle = { ball.Centre[0] + across * std::cos(angle),
      ball.Centre[1] + across * std::sin(angle), ball.Centre[2] + ball.Radius * z };
    ShapeTarget dented(Shape{ [&](const Point& x)
      {
        const double distance =
          std::hypot(x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]) / width;
        return sphere.Value(x) + depth * std::exp(-0.5 * distance * distance);
      },
      {} });
    const auto band = whole.Clone();
    band->Advance(5.5, motion, dented);
    const double lost = (whole.GetVolume() - band->GetVolume()) / volume;
    EXPECT_NEAR(lost, 0.9, 0.15) << "share of the dent that is there, place " << i;
  }
}

struct Course
{
  std::string Name;
  Way Path;
  double Tension;
};

std::vector<Course> MakeCourses()
{
  std::vector<Course> courses;
  for (const double tension : Tensions)
  {
    const std::string name = ", tension " + std::to_string(tension);
    courses.push_back({ "swinging" + name, Swing, tension });
    courses.push_back({ "approaching" + name, Approach, tension });
  }
  return courses;
}

// Remembered speeds give results bitwise identical to recomputed ones.
TEST(TestConvergedLeaves, RememberedSpeedsLeaveNoTrace)
{
  for (const auto& [name, path, tension] : MakeCourses())
  {
    NarrowBand anew(VoxelSize), remembered(VoxelSize), threaded(VoxelSize);
    threaded.SetNumberOfThreads(3);
    PairTarget changes(path, false), tells(path, true), tellsAll(path, true);
    Rest(anew, tension, changes);
    Rest(remembered, tension, tells);
    Rest(threaded, tension, tellsAll);
    std::size_t spared = 0;
    for (const double time : { 2.3, 2.9, 3.5 })
    {
      const AdvanceReport all = anew.Advance(time, MakeMotion(tension), changes);
      const AdvanceReport few = remembered.Advance(time, MakeMotion(tension), tells);
      threaded.Advance(time, MakeMotion(tension), tellsAll);
      const std::string when = name + ", at " + std::to_string(time);
      EXPECT_EQ(few.Substeps, all.Substeps) << "substeps, " << when;
      EXPECT_TRUE(AreIdentical(anew, remembered)) << "the same to the bit, " << when;
      EXPECT_TRUE(AreIdentical(anew, threaded)) << "the same by three threads, " << when;
      EXPECT_TRUE(few.TargetEvaluations <= all.TargetEvaluations)
        << "no more evaluations, " << when;
      spared += all.TargetEvaluations - few.TargetEvaluations;
    }
    EXPECT_GT(spared, 10000) << "evaluations that are spared, " << name;
  }
}

// Two balls. The values of the right one are `times` a distance, and `times` changes once, at time
// 2. The tolerance of convergence then decreases for the left ball too, although its target is
// unchanged.
class SofterTarget : public ShapeTarget
{
public:
  explicit SofterTarget(bool tells)
    : ShapeTarget([](double time) { return MakeBoth(time < 2.0 ? 20.0 : 1.0); })
    , Tells(tells)
  {
  }

  void MoveTo(double time) override
  {
    this->Softens = this->Time < 2.0 && time >= 2.0;
    this->Time = time;
    ShapeTarget::MoveTo(time);
  }

  bool MayHaveChanged(const double bounds[6]) const override
  {
    return !this->Tells || (this->Softens && bounds[1] > 0.0);
  }

  static Shape MakeBoth(double times)
  {
    const Shape left = MakeBall(Left, 0.3), right = MakeBall(Right, 0.3);
    return { [=](const Point& x) { return x[0] < 0.0 ? left.Value(x) : times * right.Value(x); },
      [=](const Point& x) { return x[0] < 0.0 ? 1.0 : times; } };
  }

private:
  bool Tells;
  bool Softens = false;
  double Time = 0.0;
};

TEST(TestConvergedLeaves, ATargetThatSoftensElsewhereLeavesNoTrace)
{
  NarrowBand anew(VoxelSize), remembered(VoxelSize);
  SofterTarget changes(false), tells(true);
  for (const auto& [band, target] : { std::pair{ &anew, &changes }, { &remembered, &tells } })
  {
    StartOn(*band, MakeBalls({ { Left, 0.32 }, { Right, 0.32 } }));
    band->Advance(1.5, MakeMotion(0.0), *target);
  }
  const std::vector<float> before = GetLeftHalf(remembered);
  anew.Advance(2.5, MakeMotion(0.0), changes);
  const AdvanceReport report = remembered.Advance(2.5, MakeMotion(0.0), tells);
  EXPECT_TRUE(AreIdentical(anew, remembered)) << "the same to the bit";
  EXPECT_TRUE(GetLeftHalf(remembered) != before) << "the left ball moves";
  EXPECT_GT(report.Substeps, 0u) << "substeps";
}

// Restarts from a checkpoint before each step, while a part is converged.
TEST(TestConvergedLeaves, RestartsLeaveNoTrace)
{
  for (const auto& [name, path, tension] : MakeCourses())
  {
    auto kept = std::make_unique<NarrowBand>(VoxelSize);
    NarrowBand straight(VoxelSize);
    PairTarget one(path, true), other(path, true);
    Rest(straight, tension, one);
    Rest(*kept, tension, other);
    for (double time = 2.05; time < 3.5; time += 0.05)
    {
      straight.Advance(time, MakeMotion(tension), one);
      kept = NarrowBand::Unpack(kept->Pack());
      kept->Advance(time, MakeMotion(tension), other);
      EXPECT_TRUE(AreIdentical(straight, *kept)) << name << ", the same to the bit at " << time;
    }
  }
}

TEST(TestConvergedLeaves, WhatRestsCostsNoEvaluations)
{
  for (const double tension : Tensions)
  {
    NarrowBand band(VoxelSize);
    PairTarget target(Stay, true);
    Rest(band, tension, target);
    const std::size_t points = Polygonise(band).GetNumberOfPoints();
    const AdvanceReport report = band.Advance(4.0, MakeMotion(tension), target);
    EXPECT_GT(report.SkippedSubsteps, 10) << "substeps at rest";
    EXPECT_EQ(report.Substeps, 0u) << "other substeps";
    EXPECT_EQ(report.TargetEvaluations, points) << "evaluations: each sample point once";
  }
}

// The right ball approaches and merges with the left one, which was converged.
TEST(TestConvergedLeaves, WhatRestsWakesWhenItsTargetChanges)
{
  for (const double tension : Tensions)
  {
    NarrowBand band(VoxelSize);
    PairTarget target(Approach, true);
    Rest(band, tension, target);
    EXPECT_EQ(GetTopology(Polygonise(band)).Components, 2) << "bodies before";
    band.Advance(6.0, MakeMotion(tension), target);
    const Mesh mesh = Polygonise(band);
    EXPECT_EQ(GetTopology(mesh).Components, 1) << "bodies after";
    if (tension == 0.0)
    {
      const Deviation deviation = GetDeviation(mesh, MakePair(Left, Approach(6.0)), VoxelSize);
      EXPECT_LT(deviation.MeanDistance, 0.02) << "mean distance to the target [h]";
      EXPECT_LT(deviation.LargestDistance, 0.1) << "largest distance to the target [h]";
    }
  }
}

}
