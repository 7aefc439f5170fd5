// Estimates the spacing of the particles of a series from several of its frames.

#include "Simulation/TargetBuilder.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// Least number of particles of a sampled frame, over the largest number: fewer may be strays.
constexpr double EnoughParticles = 0.1;
constexpr double Same = 1.01;

}

bool TargetBuilder::WantsSpacing() const
{
  const SurfaceSettings& settings = this->Settings;
  const ParticleSettings& particles = settings.Particles;
  const bool isGiven =
    particles.Spacing > 0.0 || (particles.Model == ParticleModel::Sum && particles.Radius > 0.0);
  return !isGiven && settings.UsesInput() && settings.Inputs.TargetMoves &&
    !settings.Inputs.OnlyForward && this->EstimatedSpacing == 0.0 && !this->Frames.Has(0);
}

std::vector<int> TargetBuilder::ListSpacingSteps() const
{
  const int last = this->Settings.GetNumberOfSteps() - 1;
  std::vector<int> steps;
  for (const int step : { last / 2, last })
  {
    if (step > 0 && (steps.empty() || steps.back() != step))
    {
      steps.push_back(step);
    }
  }
  return steps;
}

TargetBuilder::SpacingSample TargetBuilder::SampleSpacing(
  const InputShape& shape, const PeriodicBox& box)
{
  SpacingSample sample;
  if (const ParticleFrame* frame = shape.GetParticles())
  {
    sample.Particles = frame->Particles.size();
    sample.Spacing = ShapePreparation::FindSpacingOf(*frame, box);
    sample.HasRadii = frame->HasRadii;
  }
  return sample;
}

void TargetBuilder::SettleSpacing(const std::vector<SpacingSample>& samples)
{
  std::size_t most = 0;
  for (const SpacingSample& sample : samples)
  {
    most = std::max(most, sample.Particles);
  }
  double densest = 0.0;
  bool haveRadii = false;
  for (const SpacingSample& sample : samples)
  {
    const bool counts = sample.Spacing > 0.0 &&
      static_cast<double>(sample.Particles) >= EnoughParticles * static_cast<double>(most);
    if (counts && (densest == 0.0 || sample.Spacing < densest))
    {
      densest = sample.Spacing;
      haveRadii = sample.HasRadii;
    }
  }
  const double first = samples.front().Spacing;
  const bool isSame = first >= densest / Same && first <= densest * Same;
  this->EstimatedSpacing = isSame ? first : densest;
  if (densest > 0.0)
  {
    this->GetPreparation().ReportSpacing(haveRadii);
  }
}

}
