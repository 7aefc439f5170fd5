// Estimates the spacing of the particles of a series from several of its frames.

#include "Simulation/TargetBuilder.h"

#include "Frames/ParticleSpacing.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Frames with fewer particles than this fraction of the largest number are ignored: such particles
// may be strays.
constexpr double EnoughParticles = 0.1;
constexpr double Same = 1.01;
// Diameters of particles, compared with the distances of FindSpacing: with radii of half of the
// spacing, 0.86 to 1.16 times.
constexpr double MostOverlap = 1.2;
constexpr std::size_t LeastParticles = 4; // those with three neighbours

ParticleFrame Wrapped(const ParticleFrame& frame, const PeriodicBox& box)
{
  ParticleFrame wrapped;
  wrapped.ReachPerRadius = frame.ReachPerRadius;
  for (SkeletonVertex particle : frame.Particles)
  {
    box.Wrap(particle.Position);
    wrapped.Particles.Add(particle);
  }
  return wrapped;
}

// Returns the spacing of a frame's particles (ParticleSpacing.h). With radii: at most the median
// diameter. If all particles coincide: the median diameter, or 0 without radii.
double FindSpacingOf(const ParticleFrame& frame, const PeriodicBox& box)
{
  const double spacing = FindSpacing(box.Any() ? Wrapped(frame, box) : frame);
  if (!frame.HasRadii || frame.Particles.empty())
  {
    return spacing;
  }
  const double diameter = 2.0 * FindMedianRadius(frame) / frame.ReachPerRadius;
  return spacing > 0.0 ? std::min(spacing, diameter) : diameter; // balls may be far apart
}

}

double TargetBuilder::FindSpacing() const
{
  const double known = this->Settings.Particles.Spacing;
  return known > 0.0 ? known : this->EstimatedSpacing;
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
    sample.Spacing = FindSpacingOf(*frame, box);
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
    this->ReportSpacing(haveRadii);
  }
}

// Estimates the spacing from a frame, if a spacing is needed and unknown.
void TargetBuilder::EstimateSpacing(const InputShape& shape)
{
  const ParticleFrame* frame = shape.GetPoints();
  if (!frame || frame->CountAllParticles() == 0 || this->FindSpacing() > 0.0)
  {
    return;
  }
  const double radius = this->Settings.Particles.Radius;
  const ParticleModel model =
    shape.GetParticles() ? this->Settings.Particles.Model : ParticleModel::Sum;
  if (model == ParticleModel::Sum && (frame->HasRadii || radius > 0.0))
  {
    return;
  }
  this->EstimatedSpacing = FindSpacingOf(*frame, this->GetBox());
  if (this->EstimatedSpacing == 0.0)
  {
    this->EstimatedSpacing = std::max(radius, 0.0) / GetReachPerSpacing(model);
  }
  if (this->EstimatedSpacing == 0.0)
  {
    throw std::invalid_argument(
      "The points' spacing cannot be estimated, because there is only one usable point, or "
      "all usable points coincide; set ParticleSpacing or KernelRadius, or choose an array of "
      "radii.");
  }
  this->ReportSpacing(frame->HasRadii);
}

// Over a body whose particles overlap, the skin of ANISOTROPIC is up to 0.7 of a spacing inside or
// beyond the body (diameters of 1.2 to 3 spacings). Only the first frame with enough particles is
// checked.
void TargetBuilder::WarnOfLargeRadii(const InputShape& shape)
{
  const ParticleFrame* frame = shape.GetParticles();
  if (this->OverlapKnown || this->Settings.Particles.Model != ParticleModel::Anisotropic ||
    !frame || !frame->HasRadii || frame->Particles.size() < LeastParticles)
  {
    return;
  }
  this->OverlapKnown = true;
  const PeriodicBox box = this->GetBox();
  const double overlap = FindOverlap(box.Any() ? Wrapped(*frame, box) : *frame);
  if (overlap > MostOverlap)
  {
    std::ostringstream text;
    text << "The radii are too large: the particles' diameters are " << overlap
         << " times the distances between neighbours (median), so the skin's volume is wrong. Use "
         << "radii of half of the spacing, or none, or set ParticleModel to SUM, for balls that "
         << "overlap.";
    this->Messages.Say("large radii", text.str());
  }
}

// Reports the estimated spacing unless radii or KernelRadius are given.
void TargetBuilder::ReportSpacing(bool haveRadii) const
{
  if (haveRadii || this->Settings.Particles.Radius > 0.0)
  {
    return;
  }
  std::ostringstream text;
  text << "Neither ParticleSpacing nor KernelRadius is set, so a ParticleSpacing of "
       << this->EstimatedSpacing << ", the estimated distance between neighbours, is used. Set "
       << "ParticleSpacing to silence this message.";
  this->Messages.Say("spacing", text.str(), Warnings::Kind::Note);
}

}
