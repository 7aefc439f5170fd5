#include "LocalParticles.h"

#include <numeric>

namespace activesurface
{

namespace
{

std::vector<SkeletonVertex> Pick(
  const std::vector<SkeletonVertex>& all, const std::vector<std::size_t>& numbers)
{
  std::vector<SkeletonVertex> picked;
  picked.reserve(numbers.size());
  for (const std::size_t number : numbers)
  {
    picked.push_back(all[number]);
  }
  return picked;
}

}

LocalParticles::LocalParticles(const std::vector<SkeletonVertex>& all, const ParticleHomes* homes,
  double ballPerRadius, double margin)
  : All(all)
  , Homes(homes)
  , Numbers(homes ? homes->ListNear(all, ballPerRadius, margin) : std::vector<std::size_t>())
  , Near(Pick(all, this->Numbers))
{
  for (const SkeletonVertex& particle : this->Near)
  {
    this->AreAtHome.push_back(homes->IsAtHome(particle.Position) ? 1 : 0);
  }
}

std::vector<std::size_t> LocalParticles::ListAtHome() const
{
  std::vector<std::size_t> order(this->Get().size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  return this->ListAtHome(order);
}

std::vector<double> LocalParticles::ListPositions(
  const std::size_t* places, std::size_t count) const
{
  std::vector<double> positions;
  positions.reserve(3 * count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const double* x = this->Get()[places[k]].Position;
    positions.insert(positions.end(), x, x + 3);
  }
  return positions;
}

std::size_t LocalParticles::AddUp(std::size_t own) const
{
  if (!this->Homes)
  {
    return own;
  }
  const std::vector<std::size_t> all = GatherValues(this->Homes->GetRanks(), own);
  return std::accumulate(all.begin(), all.end(), std::size_t(0));
}

}
