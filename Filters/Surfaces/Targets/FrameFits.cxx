#include "Targets/FrameFits.h"

#include "Agreement.h"

#include <numeric>
#include <utility>

namespace activesurface
{

namespace
{

SomeFits MakeUniform(const std::vector<std::size_t>& numbers)
{
  SomeFits some;
  some.Numbers = numbers;
  some.AreWhole.assign(numbers.size(), 1);
  some.Fits.assign(numbers.size(), ParticleFit());
  return some;
}

}

void FrameFits::Want(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
{
  *this = FrameFits();
  this->Options = options;
  this->Wanted = true;
  if (options.Ranks && !options.Ranks->IsAlone())
  {
    this->Crowded = AreCrowded(options, particles);
    return;
  }
  this->GetAll(particles);
}

void FrameFits::Add(const ParticleFit& fit)
{
  this->Wanted = this->AllKnown = true;
  this->All.push_back(fit);
}

const ParticleFits& FrameFits::GetAll(const std::vector<SkeletonVertex>& particles) const
{
  if (this->Wanted && !this->AllKnown)
  {
    this->All = FitParticles(this->Options, particles);
    this->AllKnown = true;
  }
  return this->All;
}

const SomeFits& FrameFits::GetSome(
  const std::vector<SkeletonVertex>& particles, const std::vector<std::size_t>& wanted) const
{
  if (this->Crowded)
  {
    this->Some = MakeUniform(wanted);
    return this->Some;
  }
  if (this->AllKnown)
  {
    std::vector<std::size_t> numbers(particles.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t(0));
    this->Some = MakeUniform(numbers);
    this->Some.Fits = std::move(this->All);
    this->All.clear();
    this->AllKnown = false;
  }
  FindSomeFits(this->Options, particles, wanted, this->Some);
  return this->Some;
}

double FrameFits::GetFarthestInfluence(double reach, double largestReach) const
{
  return this->Wanted ? activesurface::GetFarthestInfluence(this->Options, reach, largestReach)
                      : reach;
}

}
