// A surface of which a part is at rest: that part stays as it is and costs little, and leaves no
// trace of having been left out.

#include "Check.h"
#include "SurfaceMeasures.h"

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

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

// Two metaballs, of which the right one goes its way. Values change within its support alone.
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

Motion MakeMotion()
{
  Motion motion;
  motion.Attraction = 5.0;
  return motion;
}

Point Stay(double)
{
  return Right;
}

// Stays until 2, then goes up and down.
Point Swing(double time)
{
  return { Right[0], Right[1] + (time < 2.0 ? 0.0 : 0.2 * std::sin(3.0 * (time - 2.0))), Right[2] };
}

// Stays until 2, then comes over to the left.
Point Approach(double time)
{
  return { Right[0] - 0.8 * std::min(std::max(time - 2.0, 0.0), 1.0), Right[1], Right[2] };
}

// At time 2, at rest.
void Rest(Check& check, NarrowBand& band, Target& target)
{
  StartOn(band, MakePair(Left, Right));
  const AdvanceReport report = band.Advance(2.0, MakeMotion(), target);
  check.Less(0, report.Sleeps, "substeps that were skipped before time 2");
}

// The potential at the active nodes left of 0.
std::vector<float> GetLeftHalf(const NarrowBand& band)
{
  std::vector<float> values;
  for (auto node = band.GetPotential()->cbeginValueOn(); node; ++node)
  {
    if (node.getCoord()[0] < 0)
    {
      values.push_back(*node);
    }
  }
  return values;
}

}

void WhatRestsStaysToTheBitWhileTheOtherPartMoves(Check& check)
{
  NarrowBand band(VoxelSize);
  PairTarget target(Swing, true);
  Rest(check, band, target);
  const std::vector<float> before = GetLeftHalf(band);
  check.Less(1000, before.size(), "active nodes left of 0");
  const AdvanceReport report = band.Advance(2.5, MakeMotion(), target);
  check.True(GetLeftHalf(band) == before, "the left ball is the same to the bit");
  check.Less(report.Sleeps, 2, "substeps in which nothing moved: the first, until the target does");

  // The right one follows with the lag U / Attraction.
  const double lag = 0.2 * 3.0 * std::cos(1.5) / 5.0 / VoxelSize;
  const double off =
    GetDeviation(Polygonise(band), MakePair(Left, Swing(2.5)), VoxelSize).LargestDistance;
  check.Less(off, 2.0 * lag, "farthest from the target [h]");
}

// The same bytes whether speeds are remembered or found anew, by any number of threads.
void RememberedSpeedsLeaveNoTrace(Check& check)
{
  for (const auto& [name, path] : { std::pair<std::string, Way>("swinging", Swing),
         std::pair<std::string, Way>("approaching", Approach) })
  {
    NarrowBand anew(VoxelSize), remembered(VoxelSize), threaded(VoxelSize);
    threaded.SetNumberOfThreads(3);
    PairTarget changes(path, false), tells(path, true), tellsAll(path, true);
    Rest(check, anew, changes);
    Rest(check, remembered, tells);
    Rest(check, threaded, tellsAll);
    for (const double time : { 2.3, 2.9, 3.5 })
    {
      const AdvanceReport all = anew.Advance(time, MakeMotion(), changes);
      const AdvanceReport few = remembered.Advance(time, MakeMotion(), tells);
      threaded.Advance(time, MakeMotion(), tellsAll);
      const std::string when = name + ", at " + std::to_string(time);
      check.Equal(few.Substeps, all.Substeps, "substeps, " + when);
      check.True(AreIdentical(anew, remembered), "the same to the bit, " + when);
      check.True(AreIdentical(anew, threaded), "the same by three threads, " + when);
      check.Less(few.TargetEvaluations, all.TargetEvaluations, "evaluations, " + when);
    }
  }
}

// Taken up again from a checkpoint before each step, of which a part rests.
void RestartsLeaveNoTrace(Check& check)
{
  for (const auto& [name, path] : { std::pair<std::string, Way>("swinging", Swing),
         std::pair<std::string, Way>("approaching", Approach) })
  {
    auto kept = std::make_unique<NarrowBand>(VoxelSize);
    NarrowBand straight(VoxelSize);
    PairTarget one(path, true), other(path, true);
    Rest(check, straight, one);
    Rest(check, *kept, other);
    for (double time = 2.05; time < 3.5; time += 0.05)
    {
      straight.Advance(time, MakeMotion(), one);
      kept = NarrowBand::Unpack(kept->Pack());
      kept->Advance(time, MakeMotion(), other);
      check.True(
        AreIdentical(straight, *kept), name + ", the same to the bit at " + std::to_string(time));
    }
  }
}

void WhatRestsCostsNoEvaluations(Check& check)
{
  NarrowBand band(VoxelSize);
  PairTarget target(Stay, true);
  Rest(check, band, target);
  const std::size_t points = Polygonise(band).GetNumberOfPoints();
  const AdvanceReport report = band.Advance(4.0, MakeMotion(), target);
  check.Less(10, report.Sleeps, "substeps at rest");
  check.Equal(report.Substeps, std::size_t(0), "other substeps");
  check.Equal(report.TargetEvaluations, points, "evaluations: each sample point once");
}

// The right ball comes and merges with the left one, which was at rest.
void WhatRestsWakesWhenItsTargetChanges(Check& check)
{
  NarrowBand band(VoxelSize);
  PairTarget target(Approach, true);
  Rest(check, band, target);
  check.Equal(GetTopology(Polygonise(band)).Components, 2, "bodies before");
  band.Advance(6.0, MakeMotion(), target);
  const Mesh mesh = Polygonise(band);
  check.Equal(GetTopology(mesh).Components, 1, "bodies after");
  const Deviation deviation = GetDeviation(mesh, MakePair(Left, Approach(6.0)), VoxelSize);
  check.Less(deviation.MeanDistance, 0.02, "mean distance to the target [h]");
  check.Less(deviation.LargestDistance, 0.1, "largest distance to the target [h]");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "WhatRestsStaysToTheBitWhileTheOtherPartMoves",
        WhatRestsStaysToTheBitWhileTheOtherPartMoves },
      { "RememberedSpeedsLeaveNoTrace", RememberedSpeedsLeaveNoTrace },
      { "RestartsLeaveNoTrace", RestartsLeaveNoTrace },
      { "WhatRestsCostsNoEvaluations", WhatRestsCostsNoEvaluations },
      { "WhatRestsWakesWhenItsTargetChanges", WhatRestsWakesWhenItsTargetChanges } });
}
