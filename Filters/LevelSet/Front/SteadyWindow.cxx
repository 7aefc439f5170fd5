#include "Front/SteadyWindow.h"

#include <algorithm>
#include <utility>

namespace activesurface
{

namespace
{

constexpr std::size_t FirstWindow = 16; // substeps
constexpr double LeastDecay = 8.0;
constexpr double MostMean = .25;                    // voxels
constexpr double LeastRatio = .5, MostRatio = 1.25; // of a mean to the usual mean

}

void SteadyWindow::Begin(const LeafTable& table, double time)
{
  this->Since.Begin(table);
  this->BeganAt = time;
  this->End = this->Substeps + std::max(this->Substeps, FirstWindow);
}

void SteadyWindow::Observe(const LeafTable& table, double time, double attraction)
{
  this->Steady = false;
  ++this->Substeps;
  if (this->End == 0)
  {
    this->Begin(table, time);
    return;
  }
  if (this->Substeps < this->End)
  {
    return;
  }
  const double before = this->Share;
  const auto [share, mean] = this->Since.GetStatistics(table, SteadyStateCriterion::Still);
  this->Share = share;
  const bool isLong = attraction * (time - this->BeganAt) >= LeastDecay;
  // The first comparisons are with NaN and return false.
  const bool fewMove = this->Share <= SteadyStateCriterion::FewMoving && this->Share >= .5 * before;
  const double usual = .5 * (this->Mean + this->MeanBefore);
  const bool swings = mean <= MostMean && mean >= LeastRatio * usual && mean <= MostRatio * usual;
  this->Steady = isLong && (fewMove || swings);
  this->MeanBefore = std::exchange(this->Mean, mean);
  this->Begin(table, time);
}

}
