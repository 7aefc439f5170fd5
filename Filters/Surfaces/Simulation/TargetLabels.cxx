// Labels of a target: images that are smoothed within their pixels (LabelTarget.h).

#include "Simulation/TargetBuilder.h"

#include "Grid/LabelSamples.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

bool TargetBuilder::IsOnNodes(int first, int last) const
{
  return this->Settings.UsesNodes() &&
    (this->HasParticles(first, last) || this->FindLabelPixel(first, last) > 0.0);
}

double TargetBuilder::FindLabelPixel(int first, int last) const
{
  const bool moves = this->Settings.Inputs.TargetMoves;
  double least = HUGE_VAL;
  bool hasLabel = false;
  for (int step = moves ? first : 0; step <= (moves ? last : 0); ++step)
  {
    const InputShape* shape = this->Frames.Find(step);
    const LabelFacts* label = this->Frames.GetLabel(step);
    if (shape && shape->HasPoints() && !label)
    {
      return 0.0;
    }
    hasLabel = hasLabel || (label && label->Volume > 0.0);
    least = label ? std::min(least, label->LeastPixel) : least;
  }
  return hasLabel ? least : 0.0;
}

double TargetBuilder::FindLabelVolume(int step, double fraction) const
{
  const auto volumeOf = [this](int at)
  {
    const LabelFacts* label = this->Frames.GetLabel(at);
    return label ? label->Volume : 0.0;
  };
  return fraction > 0.0 ? (1.0 - fraction) * volumeOf(step) + fraction * volumeOf(step + 1)
                        : volumeOf(step);
}

}
