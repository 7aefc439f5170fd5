#include "Targets/PlacedChanges.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <atomic>

namespace activesurface
{

namespace
{

bool IsSameVertex(const SkeletonVertex& a, const SkeletonVertex& b)
{
  return std::equal(a.Position, a.Position + 3, b.Position) && a.Radius == b.Radius &&
    a.Strength == b.Strength;
}

bool IsSameFit(const ParticleFit& a, const ParticleFit& b)
{
  return a.Bulk == b.Bulk && a.OwnRadius == b.OwnRadius && a.Strength == b.Strength &&
    a.Reach == b.Reach && std::equal(a.Offset, a.Offset + 3, b.Offset) &&
    std::equal(a.Metric, a.Metric + 6, b.Metric);
}

// The order of a track: particles of the earlier step, then births.
bool IsBefore(const ParticleOrigin& a, const ParticleOrigin& b)
{
  return a.Earlier != b.Earlier ? a.Earlier < b.Earlier
                                : a.Earlier == NoPartner && a.Later < b.Later;
}

// Counts the n < count with function(n).
template <class Function>
std::size_t CountIf(std::size_t count, Function&& function)
{
  constexpr std::size_t inPiece = 4096;
  std::atomic<std::size_t> found{ 0 };
  RunPieces(count, inPiece,
    [&](std::size_t begin, std::size_t end)
    {
      std::size_t own = 0;
      for (std::size_t n = begin; n < end; ++n)
      {
        own += function(n) ? 1 : 0;
      }
      found.fetch_add(own, std::memory_order_relaxed);
    });
  return found;
}

}

ChangedRegion::Box SupportOf(const PlacedParticles& placed, std::size_t i)
{
  const SkeletonVertex& particle = placed.Particles[i];
  const bool hasFit = !placed.Fits.empty();
  const double reach = hasFit ? std::max(particle.Radius, placed.Fits[i].Reach) : particle.Radius;
  ChangedRegion::Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double offset = hasFit ? placed.Fits[i].Offset[axis] : 0.0;
    box[2 * axis] = particle.Position[axis] + std::min(offset, 0.0) - reach;
    box[2 * axis + 1] = particle.Position[axis] + std::max(offset, 0.0) + reach;
  }
  return box;
}

PlacedChanges::PlacedChanges(const PlacedParticles& then, const PlacedParticles& now)
  : Before(then)
  , After(now)
{
  const auto isAlike = [](const ParticleOrigin& a, const ParticleOrigin& b)
  { return !IsBefore(a, b) && !IsBefore(b, a); };
  if (!std::equal(
        then.Origins.begin(), then.Origins.end(), now.Origins.begin(), now.Origins.end(), isAlike))
  {
    this->FindPairs();
  }
}

void PlacedChanges::FindPairs()
{
  const std::vector<ParticleOrigin>&then = this->Before.Origins, &now = this->After.Origins;
  for (std::size_t i = 0, k = 0; i < then.size() || k < now.size();)
  {
    const bool hasThen = i < then.size() && !(k < now.size() && IsBefore(now[k], then[i]));
    const bool hasNow = k < now.size() && !(i < then.size() && IsBefore(then[i], now[k]));
    this->Pairs.push_back({ hasThen ? i++ : NoPartner, hasNow ? k++ : NoPartner });
  }
}

std::size_t PlacedChanges::CountPairs() const
{
  return this->Pairs.empty() ? this->After.Origins.size() : this->Pairs.size();
}

PlacedCounts PlacedChanges::Count() const
{
  const std::size_t changed =
    CountIf(this->CountPairs(), [this](std::size_t n) { return !this->IsSame(this->PairAt(n)); });
  return { this->Before.Origins.size(), this->After.Origins.size(), changed };
}

void PlacedChanges::ListSupports(std::vector<ChangedRegion::Box>& supports) const
{
  supports.clear();
  for (std::size_t n = 0; n < this->CountPairs(); ++n)
  {
    const Pair pair = this->PairAt(n);
    if (this->IsSame(pair))
    {
      continue;
    }
    if (pair.Then != NoPartner)
    {
      supports.push_back(SupportOf(this->Before, pair.Then));
    }
    if (pair.Now != NoPartner)
    {
      supports.push_back(SupportOf(this->After, pair.Now));
    }
  }
}

bool PlacedChanges::IsSame(const Pair& pair) const
{
  if (pair.Then == NoPartner || pair.Now == NoPartner)
  {
    return false;
  }
  const PlacedParticles &then = this->Before, &now = this->After;
  return IsSameVertex(then.Particles[pair.Then], now.Particles[pair.Now]) &&
    (now.Fits.empty() || IsSameFit(then.Fits[pair.Then], now.Fits[pair.Now]));
}

}
