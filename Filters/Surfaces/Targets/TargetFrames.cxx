#include "Targets/TargetFrames.h"

#include <utility>

namespace activesurface
{

namespace
{

const ParticleFrame& ParticlesOf(const InputShape* shape)
{
  static const ParticleFrame none;
  const ParticleFrame* particles = shape ? shape->GetParticles() : nullptr;
  return particles ? *particles : none;
}

}

void TargetFrames::Clear()
{
  *this = TargetFrames();
}

void TargetFrames::Add(int step, std::shared_ptr<InputShape> shape, const PeriodicBox& box)
{
  Held earlier = this->Earlier, later = this->Later;
  if (this->Has(step))
  {
    (later.Step == step ? later : earlier).Shape = std::move(shape);
  }
  else
  {
    earlier = std::exchange(later, { step, std::move(shape) });
  }
  if (earlier.Step == later.Step + 1)
  {
    std::swap(earlier, later);
  }
  std::shared_ptr<const ParticleMatches> matches;
  const bool areMatched =
    earlier.Shape && earlier.Step + 1 == later.Step && !earlier.Shape->Owned && !later.Shape->Owned;
  if (areMatched)
  {
    matches = std::make_shared<ParticleMatches>(
      MatchParticles(ParticlesOf(earlier.Shape.get()), ParticlesOf(later.Shape.get()), box));
  }
  this->Earlier = std::move(earlier);
  this->Later = std::move(later);
  this->Matches = std::move(matches);
}

std::string TargetFrames::DescribeMatches() const
{
  return this->Matches && this->Matches->AreShuffled
    ? "The particles have no ids, and their order seems to differ between time steps, so the "
      "filter does not match particles: they fade out and in, and the skin does not move with "
      "them. Choose an array of ids by SetInputArrayToProcess(1, ...), in active-surface skin by "
      "--ids."
    : "";
}

InputShape* TargetFrames::Find(int step) const
{
  return this->Later.Step == step ? this->Later.Shape.get()
    : this->Earlier.Step == step  ? this->Earlier.Shape.get()
                                  : nullptr;
}

const ParticleFrame& TargetFrames::GetParticles(int step) const
{
  return ParticlesOf(this->Find(step));
}

vtkImplicitFunction* TargetFrames::GetFunction(int step) const
{
  const InputShape* shape = this->Find(step);
  return shape ? shape->GetFunction() : nullptr;
}

const LabelFacts* TargetFrames::GetLabel(int step) const
{
  const InputShape* shape = this->Find(step);
  return shape ? shape->GetLabel() : nullptr;
}

std::shared_ptr<const ParticleMatches> TargetFrames::FindMatches(int step) const
{
  return this->Has(step) && this->Has(step + 1) ? this->Matches : nullptr;
}

ParticleTrack TargetFrames::GetTrack(int step, const PeriodicBox& box, double fraction) const
{
  const auto matches = this->FindMatches(step);
  return { this->GetParticles(step), matches ? &this->GetParticles(step + 1) : nullptr, matches,
    box, fraction };
}

ParticleTrack TargetFrames::GetTrackBack(int step, const PeriodicBox& box) const
{
  const ParticleFrame& first = this->GetParticles(step + 1);
  const auto matches = this->FindMatches(step);
  return { first, matches ? &this->GetParticles(step) : nullptr,
    matches ? std::make_shared<ParticleMatches>(InvertMatches(*matches, first.Particles.size()))
            : nullptr,
    box, 0.0 };
}

}
