#include "Substep/SteadyWindow.h"

#include <algorithm>

namespace activesurface
{

namespace
{

constexpr std::size_t FirstWindow = 16; // substeps
constexpr double LeastDecay = 8.0;
constexpr double MostShare = .05;

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
  this->Share = this->Since.GetShareBeyond(table, SteadyStateCriterion::Still);
  const bool isLong = attraction * (time - this->BeganAt) >= LeastDecay;
  // Never after the first window, as nothing is known of one before.
  this->Steady = isLong && this->Share <= MostShare && this->Share >= .5 * before;
  this->Begin(table, time);
}

}
