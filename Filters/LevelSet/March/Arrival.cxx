#include "March/Arrival.h"

#include "Base/PortableMath.h"
#include "Base/ReportSum.h"
#include "Base/Target.h"
#include "March/PartCores.h"
#include "March/RemainingDistance.h"
#include "NarrowBandGrid.h"
#include "Surface/SkinMotion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace activesurface
{

namespace
{

/**
 * A static target for a surface that has to arrive at a given time. The target's value is the
 * remaining distance of the surface.
 */
class ArrivingTarget : public Target
{
public:
  /** The caller owns all arguments. */
  ArrivingTarget(Target& target, const RemainingDistance& remaining, double voxelSize)
    : Wrapped(target)
    , Remaining(remaining)
    , VoxelSize(voxelSize)
  {
  }

  /** Called when the attraction changes: converged leaves may then move again. */
  void Wake() { this->IsAwake = this->HasWoken = true; }

  void MoveTo(double time) override;
  bool MayHaveChanged(const double bounds[6]) const override;
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;
  bool IsThreadSafe() const override { return this->Wrapped.IsThreadSafe(); }

private:
  void Lengthen(double remaining, double& value, double& slope) const;

  Target& Wrapped;
  const RemainingDistance& Remaining;
  const double VoxelSize;
  bool IsAwake = true;  //< all leaves count as changed in the current substep
  bool HasWoken = true; //< all leaves count as changed in the next substep
};

void ArrivingTarget::MoveTo(double time)
{
  this->Wrapped.MoveTo(time);
  this->IsAwake = this->HasWoken;
  this->HasWoken = false;
}

bool ArrivingTarget::MayHaveChanged(const double bounds[6]) const
{
  return this->IsAwake || this->Wrapped.MayHaveChanged(bounds);
}

void ArrivingTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  this->Wrapped.Evaluate(count, points, results);
  constexpr std::size_t batch = 128;
  bool grow[batch];
  double remaining[batch];
  for (std::size_t first = 0; first < count; first += batch)
  {
    const std::size_t size = std::min(batch, count - first);
    double* values = results.Values + first;
    std::transform(values, values + size, grow, [](double value) { return value < 0.0; });
    this->Remaining.Find(size, points + 3 * first, grow, remaining);
    for (std::size_t i = 0; i < size; ++i)
    {
      this->Lengthen(remaining[i], values[i], results.Slopes[first + i]);
    }
  }
}

// If remaining >= 0 and the value F is finite, replaces F by the remaining distance, with the sign
// of F. The magnitude is max(remaining * min(|F| / h, 1), min(|F|, 2 h)), where h is the voxel
// size.
void ArrivingTarget::Lengthen(double remaining, double& value, double& slope) const
{
  const double distance = std::fabs(value), voxel = this->VoxelSize;
  if (!(remaining >= 0.0) || !std::isfinite(value))
  {
    return;
  }
  const double near = std::min(distance, 2.0 * voxel);
  const double far = remaining * std::min(distance / voxel, 1.0);
  if (far > near)
  {
    slope = distance < voxel ? slope * remaining / voxel : 1.0;
  }
  value = std::copysign(std::max(far, near), value);
}

/**
 * Attraction * duration of each interval: the decrease of ln(distance) and, except in the last
 * interval, of ln(remaining time). The decays sum to 10, which leaves 1/22000 of the distances.
 */
constexpr std::array<double, 24> Decays = { .25, .25, .25, .25, .25, .25, .25, .25, .25, .25, .25,
  .25, .25, .25, .25, .25, .5, .5, .5, .5, 1., 1., 1., 1. };

struct Interval
{
  double End;
  double Attraction;
};

/** Returns the interval that contains a time before `end`. The intervals divide [0, end] and depend
 * only on `end`, not on the requested times or on interruptions. */
Interval FindInterval(double time, double end)
{
  Interval interval{ 0.0, 0.0 };
  double left = 0.0; // ln(remaining time / end)
  for (std::size_t i = 0; i < Decays.size() && !(time < interval.End); ++i)
  {
    left -= Decays[i];
    const double begin = interval.End;
    interval.End = i + 1 < Decays.size() ? -end * ExponentialMinusOne(left) : end;
    interval.Attraction = Decays[i] / (interval.End - begin);
  }
  return interval;
}

ArrivalSearch MakeSearch(const NarrowBand& band, const Target& target, const double bounds[6])
{
  ArrivalSearch search{ band.GetLeaves(), GetPotential(band)->tree(), band.GetVoxelSize(), target,
    {} };
  std::copy_n(bounds, 6, search.Bounds.begin());
  return search;
}

}

std::size_t CreateCores(
  NarrowBand& band, const Motion& motion, Target& target, const double bounds[6])
{
  target.MoveTo(band.GetTime());
  std::vector<PartCore> cores;
  band.Run([&] { cores = FindPartCores(MakeSearch(band, target, bounds)); });
  if (cores.empty())
  {
    return 0;
  }
  // The Attraction of the motion, which decides how wide a part has to be under Tension, does not
  // act before the arrival.
  Motion withoutTension = motion;
  withoutTension.Tension = 0.0;
  return band.CreateParts(withoutTension, CoreTarget(cores));
}

struct Arrival::Members
{
  activesurface::Target& Target;
  RemainingDistance Remaining;
};

Arrival::Arrival(const NarrowBand& band, Target& target, const double bounds[6])
  : State(
      [&]
      {
        target.MoveTo(band.GetTime());
        std::unique_ptr<Members> members;
        band.Run(
          [&] {
            members.reset(
              new Members{ target, RemainingDistance(MakeSearch(band, target, bounds)) });
          });
        return members;
      }())
{
}

Arrival::~Arrival() = default;

AdvanceReport Arrival::Advance(NarrowBand& band, double time, double end, const Motion& motion,
  const ProgressFunction& progress) const
{
  ArrivingTarget target(this->State->Target, this->State->Remaining, band.GetVoxelSize());
  AdvanceReport sum;
  Motion part = motion;
  part.CreateParts = false;
  const double begin = band.GetTime();
  double from = begin, to = begin;
  const ProgressFunction inPart = [&](double done)
  { return !progress || progress((from - begin + done * (to - from)) / (time - begin)); };
  while (from < std::min(time, end) && !sum.Aborted)
  {
    const Interval interval = FindInterval(from, end);
    part.Attraction = interval.Attraction;
    target.Wake();
    to = std::min(interval.End, time);
    const AdvanceReport report = band.Advance(to, part, target, inPart);
    AddWork(sum, report);
    sum.Aborted = report.Aborted;
    from = band.GetTime();
  }
  if (from < time && !sum.Aborted)
  {
    to = time;
    const AdvanceReport report = band.Advance(to, motion, this->State->Target, inPart);
    AddWork(sum, report);
    sum.Aborted = report.Aborted;
  }
  sum.Vanished = band.IsEmpty();
  return sum;
}

std::vector<float> Arrival::FindSpeeds(
  const NarrowBand& band, double end, const SkinForces& forces) const
{
  ArrivingTarget target(this->State->Target, this->State->Remaining, band.GetVoxelSize());
  Motion motion = forces.Parameters;
  motion.Attraction = 1.0 / (end - band.GetTime());
  return activesurface::FindSpeeds(band, { motion, target, forces.StartArea, forces.StartVolume });
}

}
