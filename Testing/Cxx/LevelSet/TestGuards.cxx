// Wrong, empty or too large input gives an error message or a documented behaviour. The potential
// always remains usable.

#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

using namespace activesurface;

namespace TestGuards
{
constexpr Point Origin = { 0.0, 0.0, 0.0 };
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

// Distance of a ball, with another value beyond x = 0.2.
Shape MakeSpoiltBall(double radius, double spoilt)
{
  const Shape ball = MakeBall(Origin, radius);
  return {
    [ball, spoilt](const Point& point) { return point[0] > 0.2 ? spoilt : ball.Value(point); }, {}
  };
}

// Radii of the skin where x < -0.2, away from all dropped sample points.
Range GetRadiiOfTheSoundHalf(const Mesh& mesh)
{
  Mesh half;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    if (mesh.Points[i] < -0.2f)
    {
      half.Points.insert(half.Points.end(), &mesh.Points[i], &mesh.Points[i] + 3);
    }
  }
  return GetRadii(half, Origin);
}

void CheckClosed(const NarrowBand& band, const std::string& name)
{
  const Mesh mesh = Polygonise(band);
  EXPECT_EQ(FindDefects(mesh).Edges, 0u) << "edges that are not in two triangles, " << name;
  EXPECT_GT(GetVolume(mesh), 0.0) << "volume, " << name;
}

// A single NaN in the potential would empty the surface within two substeps.
TEST(TestGuards, SamplesThatAreNotFiniteAreDropped)
{
  for (const double spoilt : { NaN, Infinity, -Infinity })
  {
    const double h = VoxelSizeOf(32);
    NarrowBand band(h);
    StartOn(band, MakeBall(Origin, 0.6));
    ShapeTarget target(MakeSpoiltBall(0.5, spoilt));
    const AdvanceReport report = band.Advance(8.0, Motion(), target);
    const std::string name = "target " + std::to_string(spoilt);
    EXPECT_TRUE(report.DroppedSamples > 0) << "dropped samples are counted, " << name;
    EXPECT_TRUE(report.DroppedSamples < report.TargetEvaluations) << "others are not, " << name;
    CheckClosed(band, name);
    // Linear crossings are off by up to h^2 / 8 r = 0.016 h.
    const Range radii = GetRadiiOfTheSoundHalf(Polygonise(band));
    EXPECT_NEAR((radii.Minimum - 0.5) / h, 0.0, 0.04) << "least radius of the sound half, " << name;
    EXPECT_NEAR((radii.Maximum - 0.5) / h, 0.0, 0.04)
      << "largest radius of the sound half, " << name;
  }
}

TEST(TestGuards, TargetThatIsNowhereFiniteMovesNothing)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(CentreA, 0.6));
  const Mesh before = Polygonise(band);
  ShapeTarget target(MakeConstant(NaN));
  const AdvanceReport report = band.Advance(1.0, Motion(), target);
  const std::size_t samples =
    before.GetNumberOfPoints() * (report.Substeps + report.SkippedSubsteps);
  EXPECT_TRUE(Polygonise(band).Points == before.Points) << "no vertex has moved";
  EXPECT_EQ(report.TargetEvaluations, samples) << "every sample point is evaluated";
  EXPECT_EQ(report.DroppedSamples, samples) << "and dropped, in every substep";
  EXPECT_EQ(report.MaxSpeed, 0.0) << "largest speed";
  EXPECT_EQ(band.GetTime(), 1.0) << "time advances";
}

TEST(TestGuards, VoxelSizeMustBeFiniteAndPositive)
{
  for (const double size : { 0.0, -0.1, NaN, Infinity })
  {
    EXPECT_TRUE(
      Throws<std::invalid_argument>([size] { NarrowBand band(size); }, "VoxelSize must be"))
      << "a voxel size of " << size;
  }
}

TEST(TestGuards, BoundsMustBeFiniteAndOrdered)
{
  const double bad[][6] = { { 1, -1, -1, 1, -1, 1 }, { 0, 0, -1, 1, -1, 1 },
    { -1, 1, NaN, 1, -1, 1 }, { -1, 1, -1, 1, -1, Infinity }, { -1e30, 1e30, -1, 1, -1, 1 } };
  for (const double(&bounds)[6] : bad)
  {
    NarrowBand band(VoxelSizeOf(32));
    EXPECT_TRUE(Throws<std::invalid_argument>(
      [&] { band.Start(0.0, bounds, MakeInitialFunction(MakeBall(Origin, 0.5))); }, "The bounds"))
      << "bounds from " << bounds[0] << " to " << bounds[1];
    EXPECT_TRUE(band.IsEmpty()) << "a refused start leaves an empty surface empty";
  }
}

TEST(TestGuards, StartBeyondTheMaximumIsRefused)
{
  NarrowBand band(VoxelSizeOf(32));
  band.SetMaximumNumberOfActiveVoxels(1000);
  EXPECT_TRUE(Throws<std::runtime_error>([&]
    { band.Start(0.0, Box, MakeInitialFunction(MakeBall(Origin, 0.6))); },
    "MaximumNumberOfActiveVoxels"))
    << "7000 nodes are more than 1000";
  StartOn(band, MakeBall(Origin, 0.6));
  CheckClosed(band, "started with a larger maximum");
}

TEST(TestGuards, GrowthBeyondTheMaximumKeepsTheLastSubstep)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.3));
  const std::size_t maximum = 2 * band.GetNumberOfActiveNodes();
  band.SetMaximumNumberOfActiveVoxels(maximum);
  ShapeTarget target(MakeBall(Origin, 0.7));
  EXPECT_TRUE(Throws<std::runtime_error>(
    [&] { band.Advance(8.0, Motion(), target); }, "MaximumNumberOfActiveVoxels"))
    << "a ball of twice the radius has four times the nodes";
  EXPECT_GT(band.GetTime(), 0.0) << "time of the last finished substep";
  EXPECT_LT(band.GetTime(), 8.0) << "time of the last finished substep";
  CheckClosed(band, "after the exception");
  const double time = band.GetTime();
  for (const double later : { time, 8.0 })
  {
    EXPECT_TRUE(Throws<std::runtime_error>(
      [&] { band.Advance(later, Motion(), target); }, "MaximumNumberOfActiveVoxels"))
      << "asked again for " << later;
    EXPECT_EQ(band.GetTime(), time) << "it does not grow on";
  }
  band.SetMaximumNumberOfActiveVoxels(100000);
  band.Advance(8.0, Motion(), target);
  // The remaining distance is 0.4 e^-8 = 0.002 h.
  const double radius = GetRadii(Polygonise(band), Origin).Mean;
  EXPECT_NEAR(radius / VoxelSizeOf(32), 0.7 / VoxelSizeOf(32), 0.04)
    << "radius [h], with more room";
}

TEST(TestGuards, SurfaceWithoutCommonGroundVanishes)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall({ -0.5, 0.0, 0.0 }, 0.3));
  ShapeTarget target(MakeBall({ 0.5, 0.0, 0.0 }, 0.3));
  const AdvanceReport report = band.Advance(5.0, Motion(), target);
  EXPECT_TRUE(report.Vanished && band.IsEmpty()) << "the surface has vanished, and reports it";
  EXPECT_EQ(band.GetTime(), 5.0) << "time advances without a surface";
  EXPECT_TRUE(Polygonise(band).GetNumberOfPoints() == 0) << "its skin is empty";
  const AdvanceReport later = band.Advance(6.0, Motion(), target);
  EXPECT_TRUE(later.Vanished && later.TargetEvaluations == 0) << "nothing is left to move";
}

TEST(TestGuards, FunctionWithoutInsideGivesAnEmptySurface)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall({ 3.0, 0.0, 0.0 }, 0.5));
  ShapeTarget target(MakeBall(Origin, 0.5));
  EXPECT_TRUE(band.IsEmpty()) << "the surface is empty";
  EXPECT_TRUE(band.GetNumberOfActiveNodes() == 0) << "no node is kept";
  EXPECT_TRUE(Polygonise(band).GetNumberOfPoints() == 0) << "the skin is empty";
  EXPECT_TRUE(band.Advance(1.0, Motion(), target).Vanished) << "it stays empty";
  EXPECT_EQ(band.GetTime(), 1.0) << "time advances";
}

// Input such as an image with holes: nodes whose value is NaN are outside.
TEST(TestGuards, FunctionThatIsNotFiniteGivesAClosedSurface)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeSpoiltBall(0.6, NaN));
  CheckClosed(band, "a ball, not a number beyond x = .2");
}

TEST(TestGuards, TimeDoesNotRunBackwards)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.5));
  ShapeTarget target(MakeBall(Origin, 0.6));
  band.Advance(1.0, Motion(), target);
  const Mesh before = Polygonise(band);
  for (const double time : { 0.5, -1.0, NaN })
  {
    EXPECT_TRUE(Throws<std::invalid_argument>(
      [&] { band.Advance(time, Motion(), target); }, "cannot go back"))
      << "from 1 to " << time;
  }
  EXPECT_EQ(band.Advance(1.0, Motion(), target).Substeps, 0u) << "to stay takes no substep";
  EXPECT_TRUE(Polygonise(band).Points == before.Points) << "no vertex has moved";
  EXPECT_EQ(band.GetTime(), 1.0) << "time is what it was";
}

TEST(TestGuards, ProgressFunctionStopsTheStart)
{
  NarrowBand band(VoxelSizeOf(32));
  const auto stop = [](double) { return false; };
  EXPECT_FALSE(band.Start(0.0, Box, MakeInitialFunction(MakeBall(Origin, 0.5)), stop))
    << "Start returns false";
  EXPECT_TRUE(band.IsEmpty()) << "the surface is empty";
}

TEST(TestGuards, ProgressFunctionStopsTheMotion)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.3));
  ShapeTarget target(MakeBall(Origin, 0.6));
  double last = -1.0;
  bool increasing = true;
  int asked = 0;
  const ProgressFunction thrice = [&](double fraction)
  {
    increasing = increasing && fraction > last && fraction >= 0.0 && fraction < 1.0;
    last = fraction;
    return ++asked <= 3;
  };
  const AdvanceReport report = band.Advance(4.0, Motion(), target, thrice);
  EXPECT_TRUE(report.Aborted) << "aborted in the report";
  EXPECT_EQ(report.Substeps, 3u) << "substeps before the stop";
  EXPECT_TRUE(increasing) << "the fraction increases and is less than 1";
  EXPECT_NEAR(band.GetTime(), 4.0 * last, 1e-12) << "time is where it stopped";
  CheckClosed(band, "after the stop");
}

// Throws at times later than `failureTime`.
class FailingTarget : public ShapeTarget
{
public:
  FailingTarget(const Shape& shape, double failureTime)
    : ShapeTarget(shape)
    , FailureTime(failureTime)
  {
  }

  void MoveTo(double time) override { this->Fails = time > this->FailureTime; }

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    if (this->Fails)
    {
      throw std::runtime_error("The target is out of order.");
    }
    this->ShapeTarget::Evaluate(count, points, results);
  }

private:
  double FailureTime;
  bool Fails = false;
};

TEST(TestGuards, ExceptionOfTheTargetKeepsTheLastSubstep)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.3));
  FailingTarget target(MakeBall(Origin, 0.6), 0.5);
  EXPECT_TRUE(
    Throws<std::runtime_error>([&] { band.Advance(4.0, Motion(), target); }, "out of order"))
    << "the target's exception comes through";
  // The first substep that begins after 0.5 fails. Each substep is at most 1 / Attraction long.
  EXPECT_GT(band.GetTime(), 0.5) << "time of the last finished substep";
  EXPECT_LT(band.GetTime(), 1.5) << "time of the last finished substep";
  CheckClosed(band, "after the exception");
}

// Counts points, and detects concurrent calls from two threads.
class WatchingTarget : public ShapeTarget
{
public:
  WatchingTarget(const Shape& shape, bool threadSafe)
    : ShapeTarget(shape)
    , ThreadSafe(threadSafe)
  {
  }

  bool IsThreadSafe() const override { return this->ThreadSafe; }

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    const bool alone = ++this->Inside == 1;
    this->Crowded = this->Crowded || !alone;
    this->Points += count;
    this->ShapeTarget::Evaluate(count, points, results);
    for (int wait = 0; wait < this->LongestWait && !this->Crowded; ++wait)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    --this->Inside;
  }

  /** Time to wait for another thread [ms]. */
  int LongestWait = 0;
  mutable std::atomic<std::size_t> Points = 0;
  mutable std::atomic<int> Inside = 0;
  mutable std::atomic<bool> Crowded = false;

private:
  bool ThreadSafe;
};

TEST(TestGuards, EachSamplePointIsEvaluatedOncePerSubstep)
{
  NarrowBand band(VoxelSizeOf(64));
  StartOn(band, MakeBall(CentreA, 0.5));
  WatchingTarget target(MakeBall(CentreA, 0.6), true);
  std::size_t expected = 0;
  std::size_t substeps = 0;
  while (band.GetTime() < 0.5 && substeps < 1000)
  {
    expected += Polygonise(band).GetNumberOfPoints();
    bool first = true;
    const auto once = [&first](double) { return std::exchange(first, false); };
    substeps += band.Advance(0.5, Motion(), target, once).Substeps;
  }
  EXPECT_GT(double(substeps), 3.0) << "number of substeps";
  EXPECT_EQ(target.Points, expected) << "points evaluated, one per vertex";
}

TEST(TestGuards, TargetThatIsNotThreadSafeIsAskedByOneThread)
{
  const tbb::global_control twoThreads(tbb::global_control::max_allowed_parallelism, 2);
  for (const bool threadSafe : { false, true })
  {
    NarrowBand band(VoxelSizeOf(64));
    band.SetNumberOfThreads(2);
    StartOn(band, MakeBall(CentreA, 0.5));
    WatchingTarget target(MakeBall(CentreA, 0.6), threadSafe);
    // A second thread may need seconds to start on a busy machine.
    target.LongestWait = threadSafe ? 5000 : 2;
    band.Advance(0.1, Motion(), target);
    EXPECT_TRUE(target.Points > 0) << "the target was asked";
    EXPECT_TRUE(target.Crowded == threadSafe) << "by two threads at once if it may be";
  }
}
}
