#include "LocalParticles.h"

#include "NumberedValues.h"

#include <numeric>

namespace activesurface
{

LocalParticles::LocalParticles(const std::vector<SkeletonVertex>& own,
  const SharedParticles* shared, double ballPerRadius, double margin)
  : Own(own)
  , Shared(shared)
{
  if (shared)
  {
    this->Near = own;
    this->Numbers = shared->Numbers;
    this->AreAtHome.assign(own.size(), 1);
    this->AddNeighbours(ballPerRadius, margin);
  }
}

void LocalParticles::AddNeighbours(double ballPerRadius, double margin)
{
  const auto boxOf = [&](std::size_t n)
  { return MakeBox(this->Own[n].Position, ballPerRadius * this->Own[n].Radius + margin); };
  const auto all = this->Gather<SkeletonVertex>(
    this->ListAtHome(), boxOf, [&](std::size_t n) { return this->Own[n]; });
  const std::vector<std::size_t>& atHome = this->Shared->Numbers;
  this->Near.clear();
  this->Numbers.clear();
  this->AreAtHome.clear();
  for (const Told<SkeletonVertex>& one : all)
  {
    this->Near.push_back(one.What);
    this->Numbers.push_back(one.Number);
    this->AreAtHome.push_back(std::binary_search(atHome.begin(), atHome.end(), one.Number) ? 1 : 0);
  }
}

std::vector<SkeletonVertex> LocalParticles::PickSample(std::size_t count) const
{
  std::vector<std::size_t> numbers;
  numbers.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    numbers.push_back(n * this->CountAll() / count);
  }
  if (this->Shared)
  {
    return GatherNumbered(this->Shared->Ranks, this->Shared->Numbers, this->Own, numbers);
  }
  std::vector<SkeletonVertex> sample;
  sample.reserve(count);
  for (const std::size_t number : numbers)
  {
    sample.push_back(this->Own[number]);
  }
  return sample;
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
  if (!this->Shared)
  {
    return own;
  }
  const std::vector<std::size_t> all = GatherValues(this->Shared->Ranks, own);
  return std::accumulate(all.begin(), all.end(), std::size_t(0));
}

}
