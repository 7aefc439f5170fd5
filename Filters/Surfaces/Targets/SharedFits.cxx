#include "Targets/SharedFits.h"

#include <cmath>

namespace activesurface
{

namespace
{

double FindLargest(const double* x, double radius)
{
  return std::max({ std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2]) }) / radius;
}

}

void FitBounds::Add(const SkeletonVertex& particle, const ParticleFit& fit)
{
  const double radius = particle.Radius;
  this->Add(FitBounds{
    FindLargest(fit.Offset, radius), fit.Reach / radius, FindLargest(fit.Outward, radius) });
}

void FitBounds::Add(const FitBounds& other)
{
  this->Offset = std::max(this->Offset, other.Offset);
  this->Reach = std::max(this->Reach, other.Reach);
  this->Outward = std::max(this->Outward, other.Outward);
}

SharedFits::SharedFits(
  Agreement& ranks, const FitOptions& options, const std::vector<SkeletonVertex>& particles)
  : Homes(ranks, particles, GetNeighbourhoodPerRadius(options.Model))
  , AtHome(FitParticles(options, particles, &this->Homes))
{
  FitBounds own;
  for (std::size_t n = 0; n < this->AtHome.size(); ++n)
  {
    own.Add(particles[this->Homes.GetNumbers()[n]], this->AtHome[n]);
  }
  for (const FitBounds& ofRank : GatherValues(ranks, own))
  {
    this->Bounds.Add(ofRank);
  }
}

std::size_t SharedFits::CountRounds(std::size_t ofOwn) const
{
  const std::vector<std::size_t> all = GatherValues(this->Homes.GetRanks(), ofOwn);
  const std::size_t most = *std::max_element(all.begin(), all.end());
  return (most + InRound - 1) / InRound;
}

}
