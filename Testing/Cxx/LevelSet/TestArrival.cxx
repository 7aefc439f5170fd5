// A surface reaches a static target at a given time, at constant speed, from any start.

#include "Support/AnalyticShapes.h"
#include "Support/SurfaceMeasures.h"

#include "March/Arrival.h"
#include "Surface/SkinMotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using namespace activesurface;

namespace TestArrival
{
constexpr double H = VoxelSizeOf(64);
constexpr double End = 2.0;
constexpr double CoreRadius = 2.5 * H;

// Distances are marched through nodes, while the surface passes between them. The last node of a
// path is up to 0.87 voxel from its end, which adds to the remaining distance.
constexpr double OnTheWay = 1.0; // [voxels]
constexpr double AtTheEnd = .1;

/** A metamorphosis from one shape to another. */
class Morph
{
public:
  Morph(const Shape& from, const Shape& to, const Motion& law = MakeMotion(1.0, 0.0))
    : Band(H)
    , Goal(to)
    , Law(law)
  {
    StartOn(this->Band, from);
    this->Cores = CreateCores(this->Band, this->Law, this->Goal, Box);
  }

  /** Advances in `frames` equal frames. */
  void Advance(double time, int frames = 1)
  {
    const double begin = this->Band.GetTime();
    for (int i = 1; i <= frames; ++i)
    {
      const Arrival way(this->Band, this->Goal, Box);
      way.Advance(this->Band, begin + (time - begin) * i / frames, End, this->Law);
    }
  }

  void CheckArrived(const Shape& goal)
  {
    this->Advance(End);
    const Mesh mesh = Polygonise(this->Band);
    EXPECT_LE(GetDeviation(mesh, goal, H).LargestDistance, AtTheEnd);
  }

  NarrowBand Band;
  ShapeTarget Goal;
  Motion Law;
  std::size_t Cores = 0;
};

/** Extent of a mesh along x. */
Range GetExtent(const Mesh& mesh)
{
  Range extent{ 0.0, mesh.GetPoint(0)[0], mesh.GetPoint(0)[0] };
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    extent.Minimum = std::min(extent.Minimum, mesh.GetPoint(i)[0]);
    extent.Maximum = std::max(extent.Maximum, mesh.GetPoint(i)[0]);
  }
  return extent;
}

/** Vertices on the same side of the plane x = 0 as `point`. */
Mesh HalfOf(const Mesh& mesh, const Point& point)
{
  Mesh half;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    if (mesh.Points[i] * point[0] > 0.0)
    {
      half.Points.insert(half.Points.end(), &mesh.Points[i], &mesh.Points[i] + 3);
    }
  }
  return half;
}

void CheckRadius(const Mesh& mesh, const Point& centre, double radius)
{
  const Range radii = GetRadii(mesh, centre);
  EXPECT_NEAR((radii.Minimum - radius) / H, 0.0, OnTheWay);
  EXPECT_NEAR((radii.Maximum - radius) / H, 0.0, OnTheWay);
}

TEST(TestArrival, BallGrowsEvenly)
{
  Morph morph(MakeBall(CentreA, .3), MakeBall(CentreA, .7));
  EXPECT_EQ(morph.Cores, 0u);
  for (int quarter = 1; quarter < 4; ++quarter)
  {
    morph.Advance(quarter * End / 4.0, 3);
    CheckRadius(Polygonise(morph.Band), CentreA, .3 + .1 * quarter);
  }
  morph.CheckArrived(MakeBall(CentreA, .7));
}

TEST(TestArrival, BallShrinksEvenly)
{
  Morph morph(MakeBall(CentreA, .7), MakeBall(CentreA, .3));
  for (int quarter = 1; quarter < 4; ++quarter)
  {
    morph.Advance(quarter * End / 4.0);
    CheckRadius(Polygonise(morph.Band), CentreA, .7 - .1 * quarter);
  }
  morph.CheckArrived(MakeBall(CentreA, .3));
}

// The remaining distance is recomputed in each frame. A bump must not get a smaller distance than
// its surroundings: the bump would move more slowly and grow.
TEST(TestArrival, BallThatVanishesStaysRound)
{
  const Point centre = { 0.0, 0.0, 0.0 };
  Morph morph(MakeBall(centre, .6), MakeBall({ .8, 0.0, 0.0 }, .15));
  morph.Advance(.75 * End, 12);
  const Mesh mesh = Polygonise(morph.Band);
  Mesh ball;
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    const Point x = mesh.GetPoint(i);
    if (std::hypot(x[0], x[1], x[2]) < .4)
    {
      ball.Points.insert(ball.Points.end(), x.begin(), x.end());
    }
  }
  const Range radii = GetRadii(ball, centre);
  EXPECT_LE((radii.Maximum - radii.Minimum) / H, .5);
  EXPECT_NEAR(radii.Mean / H, .15 / H, OnTheWay);
}

// With plain distances the limb would arrive late. The shape of its front, flat or a cap, is
// unspecified, so the tolerance of the tip is the limb's radius.
TEST(TestArrival, ThinLimbGrowsAsFastAsAThickOne)
{
  const double y = .02, z = -.013, half = .6, radius = .15;
  for (const double neck : { 2.0 * H, 3.0 * H })
  {
    const Shape goal = MakeDumbbell({ { .01, y, z }, { 1.0, 0.0, 0.0 }, half, radius, neck });
    Morph morph(MakeBall({ .01 - half, y, z }, radius), goal);
    const double begin = .01 - half + radius, end = .01 + half + radius;
    for (int quarter = 1; quarter < 4; ++quarter)
    {
      morph.Advance(quarter * End / 4.0, 3);
      const double tip = GetExtent(Polygonise(morph.Band)).Maximum;
      EXPECT_NEAR(tip, begin + (end - begin) * quarter / 4.0, neck) << neck / H;
    }
    morph.CheckArrived(goal);
  }
}

// The last node of a part that shrinks to nothing is up to 0.87 voxel from its centre. The
// tolerance is twice that.
TEST(TestArrival, PartsGrowAndShrinkEvenly)
{
  const Ball left = { { -.5, .013, -.021 }, .35 }, right = { { .5, .03, .01 }, .4 };
  Morph morph(MakeBalls({ left }), MakeBalls({ right }));
  EXPECT_EQ(morph.Cores, 1u);
  for (int quarter = 1; quarter < 4; ++quarter)
  {
    morph.Advance(quarter * End / 4.0);
    const Mesh mesh = Polygonise(morph.Band);
    const double share = quarter / 4.0;
    CheckRadius(
      HalfOf(mesh, right.Centre), right.Centre, CoreRadius + (right.Radius - CoreRadius) * share);
    const Range shrinking = GetRadii(HalfOf(mesh, left.Centre), left.Centre);
    EXPECT_NEAR((shrinking.Mean - left.Radius * (1.0 - share)) / H, 0.0, 2.0 * .87);
  }
  morph.CheckArrived(MakeBalls({ right }));
}

TEST(TestArrival, HollowOpensEvenly)
{
  const Shape goal = MakeShell(.7, .4);
  Morph morph(MakeBall({ 0.0, 0.0, 0.0 }, .7), goal);
  EXPECT_EQ(morph.Cores, 1u);
  morph.Advance(End / 2.0);
  const Topology topology = GetTopology(Polygonise(morph.Band));
  EXPECT_EQ(topology.Voids, 1);
  EXPECT_NEAR(GetRadii(Polygonise(morph.Band), { 0.0, 0.0, 0.0 }).Minimum / H,
    (CoreRadius + .4) / 2.0 / H, OnTheWay);
  morph.CheckArrived(goal);
}

// Until the arrival, Attraction does not act. A core opens if its speed, (0.4 - CoreRadius) / End =
// 0.16, exceeds the speed of tension, 2 Tension / CoreRadius, at most 0.08 here.
TEST(TestArrival, HollowOpensAlsoAgainstTension)
{
  const Shape goal = MakeShell(.7, .4);
  for (const double tension : { 1e-4, 3e-3 })
  {
    Morph morph(MakeBall({ 0.0, 0.0, 0.0 }, .7), goal, MakeMotion(1.0, tension));
    EXPECT_EQ(morph.Cores, 1u) << tension;
    morph.Advance(End);
    EXPECT_EQ(GetTopology(Polygonise(morph.Band)).Voids, 1) << tension;
  }
}

TEST(TestArrival, NarrowHollowOpens)
{
  const Shape goal = MakeShell(.7, .8 * H);
  Morph morph(MakeBall({ 0.0, 0.0, 0.0 }, .7), goal);
  EXPECT_EQ(morph.Cores, 1u);
  morph.Advance(End);
  EXPECT_EQ(GetTopology(Polygonise(morph.Band)).Voids, 1);
}

// F / |grad F|, limited to 0.3, is wrong by up to a third where the surface starts.
TEST(TestArrival, TargetNeedNotBeADistance)
{
  const Shape goal = Normalise(MakeAlgebraicBall(CentreA, .6), .3);
  Morph morph(MakeBall(CentreB, .2), goal);
  morph.Advance(End / 2.0);
  const Range radii = GetRadii(Polygonise(morph.Band), CentreA);
  EXPECT_NEAR(radii.Mean / H, .4 / H, OnTheWay);
  morph.CheckArrived(goal);
}

// Same tolerance as without Tension, which displaces the steady state by up to 0.02 voxel.
TEST(TestArrival, TensionDoesNotMakeItLate)
{
  const Shape goal = MakeTorus(CentreA, .5, .2);
  Morph morph(MakeBall({ .5, 0.0, 0.0 }, .25), goal, MakeMotion(1.0, 1e-4));
  morph.Advance(End, 10);
  EXPECT_EQ(GetTopology(Polygonise(morph.Band)).EulerCharacteristic, 0);
  morph.CheckArrived(goal);
}

TEST(TestArrival, AfterItTheAttractionOfTheMotionHolds)
{
  Morph morph(MakeBall(CentreA, .3), MakeBall(CentreA, .6));
  const Arrival way(morph.Band, morph.Goal, Box);
  way.Advance(morph.Band, 2.0 * End, End, morph.Law);
  EXPECT_EQ(morph.Band.GetTime(), 2.0 * End);
  morph.CheckArrived(MakeBall(CentreA, .6));
}

// Each update is aborted after one substep, then resumed.
TEST(TestArrival, InterruptionDoesNotChangeIt)
{
  const Shape from = MakeBall(CentreA, .3), to = MakeSixMetaballs();
  Morph whole(from, to), parts(from, to);
  const Arrival way(whole.Band, whole.Goal, Box), other(parts.Band, parts.Goal, Box);
  way.Advance(whole.Band, 1.7, End, whole.Law);
  int calls = 0;
  bool isDone = false;
  while (!isDone && calls < 1000)
  {
    const auto everyOther = [&](double) { return ++calls % 2 != 0; };
    isDone = !other.Advance(parts.Band, 1.7, End, parts.Law, everyOther).Aborted;
  }
  EXPECT_GT(calls, 6);
  EXPECT_TRUE(AreIdentical(whole.Band, parts.Band));
}

TEST(TestArrival, ProgressGoesOn)
{
  Morph morph(MakeBall(CentreA, .3), MakeBall(CentreA, .6));
  std::vector<double> told;
  const Arrival way(morph.Band, morph.Goal, Box);
  way.Advance(morph.Band, End, End, morph.Law,
    [&](double done)
    {
      told.push_back(done);
      return true;
    });
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.front(), 0.0);
  EXPECT_LT(told.back(), 1.0);
  EXPECT_GT(told.back(), .99);
}

TEST(TestArrival, ThreadsDoNotChangeIt)
{
  const Shape from = MakeBalls({ { CentreA, .3 } }), to = MakeTorus(CentreB, .5, .15);
  Morph one(from, to), many(from, to);
  one.Band.SetNumberOfThreads(1);
  many.Band.SetNumberOfThreads(3);
  one.Advance(1.5, 2);
  many.Advance(1.5, 2);
  EXPECT_TRUE(AreIdentical(one.Band, many.Band));
}

// Speed is the remaining distance, 0.4 at the start, over the remaining time.
TEST(TestArrival, SpeedIsWhatIsLeftOverTheTimeThatIsLeft)
{
  Morph morph(MakeBall(CentreA, .3), MakeBall(CentreA, .7));
  const Arrival way(morph.Band, morph.Goal, Box);
  const std::vector<float> speeds =
    way.FindSpeeds(morph.Band, End, { morph.Law, morph.Goal, 0.0, 0.0 });
  for (const float speed : speeds)
  {
    EXPECT_NEAR(speed * End / H, .4 / H, OnTheWay);
  }
}

// An unbounded target is not filled beyond the bounds.
TEST(TestArrival, HalfSpaceIsReachedWithinTheBounds)
{
  const Shape goal = { [](const Point& p) { return p[0]; }, {} };
  Morph morph(MakeBall({ .2, 0.0, 0.0 }, .4), goal);
  morph.Law.Box = { true, { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 } };
  morph.Advance(End, 4);
  const Range extent = GetExtent(Polygonise(morph.Band));
  EXPECT_NEAR(extent.Minimum, -1.0, H * AtTheEnd);
  EXPECT_NEAR(extent.Maximum, 0.0, H * AtTheEnd);
}
// The corners of a box within a ring graze the ring or miss it by up to three voxels. The overlap
// is too thin to grow from, so the box needs a core of its own.
TEST(TestArrival, ShapesThatGrazeEachOtherArrive)
{
  const Shape ring = {
    [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 0.6, p[2]) - 0.18; }, {}
  };
  const double corner = std::sqrt(0.5) * 0.42; // on the ring's inner edge
  for (const double half : { corner - 0.06, corner - 0.03, corner, corner + 0.02 })
  {
    const Shape box = { [half](const Point& p)
      {
        return std::max({ std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2]) }) - half;
      },
      {} };
    Morph there(ring, box);
    EXPECT_EQ(there.Cores, 1u) << "cores, box of half side " << half;
    there.Advance(End, 4);
    EXPECT_NEAR(there.Band.GetVolume(), 8 * half * half * half, 0.1 * 8 * half * half * half);
    Morph back(box, ring);
    back.Advance(End, 4);
    const double whole = 2.0 * M_PI * M_PI * 0.6 * 0.18 * 0.18;
    EXPECT_NEAR(back.Band.GetVolume(), whole, 0.1 * whole);
  }
}

}
