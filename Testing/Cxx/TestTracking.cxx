// Attraction alone or nearly so: the surface on its way to a target, still or moving.

#include "Check.h"
#include "RandomShapes.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace activesurface;

namespace
{
Motion MotionOf(double attraction, double tension)
{
  Motion motion;
  motion.Attraction = attraction;
  motion.Tension = tension;
  return motion;
}

std::string Number(double value)
{
  return std::to_string(value).substr(0, 5);
}

// V = 1 or -1 everywhere moves a sphere by t. The gradient is upwind and of second order, the step
// in time of first: a distance stays one, and the ghosts' error is left, a tenth of a voxel.
void CheckUniformSpeed(Check& check, int n, const Point& centre, double from, double to)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, MakeBall(centre, from));
  ShapeTarget target(MakeConstant(to > from ? -1.0 : 1.0));
  band.Advance(std::abs(to - from), MotionOf(1.0, 0.0), target);
  const Range radii = GetRadii(Polygonise(band), centre);
  const std::string name =
    "n = " + std::to_string(n) + ", from " + Number(from) + " to " + Number(to);
  check.Near((radii.Mean - to) / h, 0.0, 0.15, "error of the mean radius [h], " + name);
  check.Less(radii.GetSpread() / h, 0.25, "spread of the radii [h], " + name);
}

void UniformSpeedMovesASphereByTheTime(Check& check)
{
  for (const int n : { 32, 64, 128 })
  {
    CheckUniformSpeed(check, n, CentreA, 0.3, 0.6);
    CheckUniformSpeed(check, n, CentreA, 0.6, 0.3);
  }
  CheckUniformSpeed(check, 32, CentreB, 0.25, 0.6);
  CheckUniformSpeed(check, 32, CentreB, 0.6, 0.25);
}

void UniformSpeedMovesASphereByTheTimeAtRandom(Check& check)
{
  RandomShapes random(4);
  for (const int n : { 32, 32, 64 })
  {
    const Ball small = random.DrawBallNear({ CentreA, 0.3 });
    const Ball large = random.DrawBallNear({ CentreA, 0.6 });
    CheckUniformSpeed(check, n, small.Centre, small.Radius, large.Radius);
    CheckUniformSpeed(check, n, large.Centre, large.Radius, small.Radius);
  }
}

// dr/dt = a (R - r): r = R + (r0 - R) e^(-a t). Frames of .1 make the forward Euler step .1 at
// most, which alone is behind by up to .05 a dt (R - r0) e^-1 = .0037 = .06 h at n = 32, .12 h at n
// = 64.
void CheckApproach(Check& check, int n, const Ball& from, double to, double tolerance)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, MakeBall(from.Centre, from.Radius));
  ShapeTarget target(MakeBall(from.Centre, to));
  double largest = 0.0;
  for (int frame = 1; frame <= 40; ++frame)
  {
    band.Advance(0.1 * frame, MotionOf(1.0, 0.0), target);
    const double exact = to + (from.Radius - to) * std::exp(-0.1 * frame);
    const double mean = GetRadii(Polygonise(band), from.Centre).Mean;
    largest = std::max(largest, std::abs(mean - exact) / h);
  }
  check.Less(largest, tolerance, "largest error of the radius [h], n = " + std::to_string(n));
}

void ApproachToABallIsExponential(Check& check)
{
  CheckApproach(check, 32, { CentreA, 0.4 }, 0.6, 0.1);
  CheckApproach(check, 64, { CentreA, 0.4 }, 0.6, 0.2);
}

// The way is half as long again at most: .09 h at n = 32, .18 h at n = 64.
void ApproachToABallIsExponentialAtRandom(Check& check)
{
  RandomShapes random(5);
  for (const auto& [n, tolerance] : { std::pair(32, 0.1), std::pair(32, 0.1), std::pair(64, 0.2) })
  {
    const Ball from = random.DrawBallNear({ CentreA, 0.4 });
    CheckApproach(check, n, from, random.DrawLengthNear(0.6), tolerance);
  }
}

void CheckJourney(Check& check, int n, double from, const Shape& to, double time, double exact)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, MakeBall(CentreA, from));
  ShapeTarget target(to);
  band.Advance(time, MotionOf(1.0, 0.0), target);
  const Range radii = GetRadii(Polygonise(band), CentreA);
  const Range slopes = GetSlopes(band);
  const std::string name = "n = " + std::to_string(n) + ", from " + Number(from) + " to " +
    Number(exact) + " in " + Number(time);
  check.Near((radii.Mean - exact) / h, 0.0, 0.25, "error of the mean radius [h], " + name);
  check.Less(radii.GetSpread() / h, 0.25, "spread of the radii [h], " + name);
  check.Less(0.5, slopes.Minimum, "least slope, " + name);
  check.Less(slopes.Maximum, 1.5, "largest slope, " + name);
}

// Ten voxels and more at the largest time step, 20 to 60 substeps: transport and the relaxation of
// the slope share them, and what is unstable has grown beyond any bound. Tolerances of the uniform
// speed; an Euler step of h/2 is behind e^(-t) by t h / 4.
void LongJourneyLeavesABallSmooth(Check& check)
{
  for (const int n : { 64, 128 })
  {
    const double approach = 0.6 * std::exp(-1.0);
    CheckJourney(check, n, 0.2, MakeBall(CentreA, 0.8), 1.0, 0.8 - approach);
    CheckJourney(check, n, 0.8, MakeBall(CentreA, 0.2), 1.0, 0.2 + approach);
    // As a target is that is known near its surface alone: .1 per unit of time at most.
    CheckJourney(check, n, 0.2, Normalise(MakeBall(CentreA, 0.75), 0.1), 4.0, 0.6);
    CheckJourney(check, n, 0.7, Normalise(MakeBall(CentreA, 0.15), 0.1), 4.0, 0.3);
  }
}

struct Tips
{
  double Leading = -1e30;
  double Trailing = 1e30;
};

// The foremost and the hindmost sample points within 2 voxels of the axis y = cy, z = cz.
Tips FindTips(const Mesh& mesh, const Point& centre)
{
  Tips tips;
  for (std::size_t vertex = 0; vertex < mesh.GetNumberOfPoints(); ++vertex)
  {
    const Point point = mesh.GetPoint(vertex);
    if (std::abs(point[1] - centre[1]) + std::abs(point[2] - centre[2]) < 0.12)
    {
      tips.Leading = std::max(tips.Leading, point[0]);
      tips.Trailing = std::min(tips.Trailing, point[0]);
    }
  }
  return tips;
}

// A ball that moves at the speed U is followed at the distance U/a (1 - e^(-a t)), before it and
// behind it. .12 h: .04 h because a sample point is up to .7 h off the axis, the rest first order
// in the frames of .01.
void CheckLag(Check& check, const Ball& start, double attraction)
{
  const double h = VoxelSizeOf(32);
  const auto centreAt = [&start](double time) {
    return Point{ start.Centre[0] + 0.8 * time, start.Centre[1], start.Centre[2] };
  };
  NarrowBand band(h);
  StartOn(band, MakeBall(start.Centre, start.Radius));
  ShapeTarget target([&](double time) { return MakeBall(centreAt(time), start.Radius); });
  for (int frame = 1; frame <= 100; ++frame)
  {
    band.Advance(0.01 * frame, MotionOf(attraction, 0.0), target);
  }
  const Point centre = centreAt(1.0);
  const Tips tips = FindTips(Polygonise(band), centre);
  const double lag = 0.8 / attraction * (1.0 - std::exp(-attraction));
  const double before = centre[0] + start.Radius - tips.Leading;
  const double behind = centre[0] - start.Radius - tips.Trailing;
  const std::string name = "attraction " + Number(attraction);
  check.Near((before - lag) / h, 0.0, 0.12, "lag before [h], " + name);
  check.Near((behind - lag) / h, 0.0, 0.12, "lag behind [h], " + name);
}

void SurfaceLagsBehindAMovingBallByTheExactDistance(Check& check)
{
  for (const double attraction : { 2.0, 5.0, 10.0, 20.0, 50.0 })
  {
    CheckLag(check, { { -0.4, 0.013, -0.007 }, 0.4 }, attraction);
  }
}

// The radius is at least .4: with attraction 2 the lag is .346, so that the tip of a ball of .36
// would be where the target's distance has its kink, at the centre, and be too sharp for the
// lattice: .15 h at n = 32.
void SurfaceLagsBehindAMovingBallByTheExactDistanceAtRandom(Check& check)
{
  RandomShapes random(12);
  for (const double attraction : { 2.0, 2.0, 5.0, 10.0, 20.0, 50.0 })
  {
    const Point centre = random.DrawPointNear({ -0.4, 0.013, -0.007 });
    CheckLag(check, { centre, random.DrawBetween(0.4, 0.44) }, attraction);
  }
}

ShapeTarget::Trajectory MakeShuttlingBall(const Ball& start)
{
  return [start](double time)
  {
    const double phase = std::fmod(time, 2.0);
    Point centre = start.Centre;
    centre[0] += 0.8 * std::min(phase, 2.0 - phase);
    return MakeBall(centre, start.Radius);
  };
}

ShapeTarget::Trajectory MakeTurningDumbbell(const Dumbbell& dumbbell)
{
  return [dumbbell](double time)
  {
    const double angle = 1.5 * time;
    Dumbbell turned = dumbbell;
    turned.Direction = { std::cos(angle), 0.8 * std::sin(angle), 0.6 * std::sin(angle) };
    return MakeDumbbell(turned);
  };
}

ShapeTarget::Trajectory MakePulsatingBall(const Ball& mean, double amplitude)
{
  return [mean, amplitude](double time)
  { return MakeBall(mean.Centre, mean.Radius + amplitude * std::sin(3.0 * time)); };
}

void CheckSlope(Check& check, const ShapeTarget::Trajectory& trajectory, const std::string& name)
{
  for (const double tension : { 0.0, 0.01 })
  {
    NarrowBand band(VoxelSizeOf(32));
    StartOn(band, trajectory(0.0));
    ShapeTarget target(trajectory);
    double least = 1e30;
    double largest = 0.0;
    for (int frame = 1; frame <= 200; ++frame)
    {
      band.Advance(0.05 * frame, MotionOf(10.0, tension), target);
      const Range slopes = GetSlopes(band);
      least = std::min(least, slopes.Minimum);
      largest = std::max(largest, slopes.Maximum);
    }
    const std::string full = name + ", tension " + Number(tension);
    check.Less(0.5, least, "least slope in 200 frames, " + full);
    check.Less(largest, 1.5, "largest slope in 200 frames, " + full);
  }
}

// The potential is worth its name while its slope is near 1: below .5 a sample point is ill
// determined, above 1.5 the time step no longer keeps it from crossing two voxels.
void SlopeStaysNearOneWhileMoving(Check& check)
{
  const Point centre = { 0.01, 0.02, -0.013 };
  CheckSlope(check, MakeShuttlingBall({ { -0.4, 0.013, -0.007 }, 0.4 }), "shuttling ball");
  CheckSlope(check, MakeTurningDumbbell({ centre, {}, 0.45, 0.3, 0.15 }), "turning dumbbell");
  CheckSlope(check, MakePulsatingBall({ centre, 0.5 }, 0.2), "pulsating ball");
}

void SlopeStaysNearOneWhileMovingAtRandom(Check& check)
{
  RandomShapes random(15);
  const Point centre = { 0.01, 0.02, -0.013 };
  const Ball shuttle = random.DrawBallNear({ { -0.4, 0.013, -0.007 }, 0.4 });
  CheckSlope(check, MakeShuttlingBall(shuttle), "shuttling ball");
  const Dumbbell dumbbell = { random.DrawPointNear(centre), {}, random.DrawLengthNear(0.45),
    random.DrawLengthNear(0.3), random.DrawLengthNear(0.15) };
  CheckSlope(check, MakeTurningDumbbell(dumbbell), "turning dumbbell");
  const Ball mean = random.DrawBallNear({ centre, 0.5 });
  CheckSlope(check, MakePulsatingBall(mean, random.DrawLengthNear(0.2)), "pulsating ball");
}
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "UniformSpeedMovesASphereByTheTime", UniformSpeedMovesASphereByTheTime },
      { "UniformSpeedMovesASphereByTheTimeAtRandom", UniformSpeedMovesASphereByTheTimeAtRandom },
      { "ApproachToABallIsExponential", ApproachToABallIsExponential },
      { "ApproachToABallIsExponentialAtRandom", ApproachToABallIsExponentialAtRandom },
      { "LongJourneyLeavesABallSmooth", LongJourneyLeavesABallSmooth },
      { "SurfaceLagsBehindAMovingBallByTheExactDistance",
        SurfaceLagsBehindAMovingBallByTheExactDistance },
      { "SurfaceLagsBehindAMovingBallByTheExactDistanceAtRandom",
        SurfaceLagsBehindAMovingBallByTheExactDistanceAtRandom },
      { "SlopeStaysNearOneWhileMoving", SlopeStaysNearOneWhileMoving },
      { "SlopeStaysNearOneWhileMovingAtRandom", SlopeStaysNearOneWhileMovingAtRandom } });
}
