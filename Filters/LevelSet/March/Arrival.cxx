#include "March/Arrival.h"

#include "Base/PortableMath.h"
#include "Base/ReportSum.h"
#include "March/ArrivingTarget.h"
#include "March/PartCores.h"
#include "NarrowBandGrid.h"
#include "Surface/SkinMotion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace activesurface
{

namespace
{

/** Decrease of ln(remaining time) in each interval; distances fall by the same factor. The sum of
 * 10 would leave 1/22000 of the distances. */
constexpr std::array<double, 24> Decays = { .25, .25, .25, .25, .25, .25, .25, .25, .25, .25, .25,
  .25, .25, .25, .25, .25, .5, .5, .5, .5, 1., 1., 1., 1. };

struct Interval
{
  double End;
  double Attraction;
};

/** Returns the interval that contains a time before `end`. The intervals depend only on `end`, not
 * on the requested times or on interruptions. */
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
  return cores.empty() ? 0 : band.CreateParts(motion, CoreTarget(cores));
}

struct Arrival::Members
{
  Target& Goal;
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
  ArrivingTarget target(this->State->Goal, this->State->Remaining, band.GetVoxelSize());
  AdvanceReport sum;
  Motion law = motion;
  law.CreateParts = false;
  const double begin = band.GetTime();
  double from = begin, to = begin;
  const ProgressFunction inPart = [&](double done)
  { return !progress || progress((from - begin + done * (to - from)) / (time - begin)); };
  while (from < std::min(time, end) && !sum.Aborted)
  {
    const Interval interval = FindInterval(from, end);
    law.Attraction = interval.Attraction;
    target.Wake();
    to = std::min(interval.End, time);
    const AdvanceReport report = band.Advance(to, law, target, inPart);
    AddWork(sum, report);
    sum.Aborted = report.Aborted;
    from = band.GetTime();
  }
  if (from < time && !sum.Aborted)
  {
    to = time;
    const AdvanceReport report = band.Advance(to, motion, this->State->Goal, inPart);
    AddWork(sum, report);
    sum.Aborted = report.Aborted;
  }
  sum.Vanished = band.IsEmpty();
  return sum;
}

std::vector<float> Arrival::FindSpeeds(
  const NarrowBand& band, double end, const SkinForces& forces) const
{
  ArrivingTarget target(this->State->Goal, this->State->Remaining, band.GetVoxelSize());
  Motion law = forces.Strategy;
  law.Attraction = 1.0 / (end - band.GetTime());
  return activesurface::FindSpeeds(band, { law, target, forces.StartArea, forces.StartVolume });
}

}
