#include "Targets/ParticleMatches.h"

#include "ParallelTasks.h"
#include "PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace activesurface
{

namespace
{

// Indices of the particles, by ascending id; equal ids stay in order.
std::vector<std::size_t> SortByIds(const std::vector<std::int64_t>& ids)
{
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (!std::is_sorted(ids.begin(), ids.end())) // as they usually are
  {
    std::stable_sort(
      order.begin(), order.end(), [&ids](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  }
  return order;
}

void MatchIds(const std::vector<std::int64_t>& earlier, const std::vector<std::int64_t>& later,
  std::vector<std::size_t>& partners)
{
  const std::vector<std::size_t> from = SortByIds(earlier);
  const std::vector<std::size_t> to = SortByIds(later);
  auto candidate = to.begin();
  for (const std::size_t particle : from)
  {
    while (candidate != to.end() && later[*candidate] < earlier[particle])
    {
      ++candidate;
    }
    if (candidate != to.end() && later[*candidate] == earlier[particle])
    {
      partners[particle] = *candidate++;
    }
  }
}

double DiagonalOf(const std::vector<SkeletonVertex>& particles)
{
  double square = 0.0;
  for (int axis = 0; axis < 3 && !particles.empty(); ++axis)
  {
    const auto ends = std::minmax_element(particles.begin(), particles.end(),
      [axis](const SkeletonVertex& a, const SkeletonVertex& b)
      { return a.Position[axis] < b.Position[axis]; });
    const double length = ends.second->Position[axis] - ends.first->Position[axis];
    square += length * length;
  }
  return std::sqrt(square);
}

using ParticleStep = std::array<double, 3>;

// Of partners, evenly picked.
std::vector<ParticleStep> PickWays(const ParticleFrame& earlier, const ParticleFrame& later,
  const std::vector<std::size_t>& partners)
{
  constexpr std::size_t enough = 1000;
  const std::size_t stride = 1 + partners.size() / enough;
  std::vector<ParticleStep> ways;
  for (std::size_t i = 0; i < partners.size(); i += stride)
  {
    if (partners[i] != NoPartner)
    {
      const auto& from = earlier.Particles[i].Position;
      const auto& to = later.Particles[partners[i]].Position;
      ways.push_back({ to[0] - from[0], to[1] - from[1], to[2] - from[2] });
    }
  }
  return ways;
}

// The later particles that are nobody's partner.
std::vector<std::size_t> FindBirths(const std::vector<std::size_t>& partners, std::size_t later)
{
  std::vector<bool> isPartner(later, false);
  for (const std::size_t partner : partners)
  {
    if (partner != NoPartner)
    {
      isPartner[partner] = true;
    }
  }
  std::vector<std::size_t> births;
  for (std::size_t i = 0; i < later; ++i)
  {
    if (!isPartner[i])
    {
      births.push_back(i);
    }
  }
  return births;
}

double Between(double a, double b, double fraction)
{
  return a + fraction * (b - a);
}

ParticleFit Between(const ParticleFit& a, const ParticleFit& b, double fraction)
{
  ParticleFit fit{};
  fit.Bulk = Between(a.Bulk, b.Bulk, fraction);
  fit.OwnRadius = Between(a.OwnRadius, b.OwnRadius, fraction);
  fit.Strength = Between(a.Strength, b.Strength, fraction);
  fit.Reach = std::max(a.Reach, b.Reach); // an ellipsoid between two is within the larger reach
  for (int axis = 0; axis < 3; ++axis)
  {
    fit.Offset[axis] = Between(a.Offset[axis], b.Offset[axis], fraction);
    fit.Outward[axis] = Between(a.Outward[axis], b.Outward[axis], fraction);
  }
  for (int i = 0; i < 6; ++i)
  {
    fit.Metric[i] = Between(a.Metric[i], b.Metric[i], fraction);
  }
  return fit;
}

ParticleFit Shrunk(ParticleFit fit, double share)
{
  fit.OwnRadius *= CubeRoot(share);
  return fit;
}

ParticleFit FitOf(const ParticleOrigin& origin, const ParticleFits& earlier,
  const ParticleFits& later, double fraction)
{
  return origin.Later == NoPartner ? Shrunk(earlier[origin.Earlier], 1.0 - fraction)
    : origin.Earlier == NoPartner  ? Shrunk(later[origin.Later], fraction)
                                  : Between(earlier[origin.Earlier], later[origin.Later], fraction);
}

void MoveTowards(SkeletonVertex& particle, const SkeletonVertex& partner, double fraction)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    particle.Position[axis] = Between(particle.Position[axis], partner.Position[axis], fraction);
  }
  const double radius = Between(particle.Radius, partner.Radius, fraction);
  particle.Radius = radius > 0.0 ? radius : partner.Radius; // which rounding may have swallowed
  particle.Strength = Between(particle.Strength, partner.Strength, fraction);
}

// Particles that are on their way, and their origins if these are wanted.
struct Crowd
{
  std::vector<SkeletonVertex>& Particles;
  std::vector<ParticleOrigin>* Origins;

  void Clear()
  {
    this->Particles.clear();
    if (this->Origins)
    {
      this->Origins->clear();
    }
  }

  void Add(const SkeletonVertex& particle, const ParticleOrigin& origin)
  {
    this->Particles.push_back(particle);
    if (this->Origins)
    {
      this->Origins->push_back(origin);
    }
  }

  void AddFaded(SkeletonVertex particle, double share, const ParticleOrigin& origin)
  {
    particle.Strength *= share;
    if (particle.Strength != 0.0)
    {
      this->Add(particle, origin);
    }
  }
};

// Returns true if half of the displacements, less their mean, are long for the cloud's diagonal.
bool GoAcross(const std::vector<ParticleStep>& ways, std::size_t particles, double diagonal)
{
  constexpr std::size_t fewParticles = 100; // whose indices are always believed
  constexpr double acrossTheCloud = 0.2;    // of its diagonal
  if (ways.empty() || particles < fewParticles)
  {
    return false;
  }
  ParticleStep mean = { 0.0, 0.0, 0.0 };
  for (const ParticleStep& way : ways)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      mean[axis] += way[axis] / static_cast<double>(ways.size());
    }
  }
  std::vector<double> lengths;
  for (const ParticleStep& way : ways)
  {
    const double x = way[0] - mean[0], y = way[1] - mean[1], z = way[2] - mean[2];
    lengths.push_back(std::sqrt(x * x + y * y + z * z));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle > acrossTheCloud * diagonal;
}

}

ParticleMatches MatchParticles(const ParticleFrame& earlier, const ParticleFrame& later)
{
  const bool sameCount =
    earlier.Particles.size() + earlier.Ignored == later.Particles.size() + later.Ignored;
  ParticleMatches matches;
  matches.Partners.assign(earlier.Particles.size(), NoPartner);
  if (earlier.HasIds == later.HasIds && (earlier.HasIds || sameCount))
  {
    MatchIds(earlier.Ids, later.Ids, matches.Partners);
  }
  if (!earlier.HasIds &&
    GoAcross(PickWays(earlier, later, matches.Partners), earlier.Particles.size(),
      DiagonalOf(earlier.Particles)))
  {
    matches.AreShuffled = true;
    matches.Partners.assign(earlier.Particles.size(), NoPartner);
  }
  matches.Births = FindBirths(matches.Partners, later.Particles.size());
  return matches;
}

double FindLongestWay(
  const ParticleFrame& earlier, const ParticleFrame& later, const ParticleMatches& matches)
{
  double longest = 0.0;
  for (std::size_t i = 0; i < earlier.Particles.size(); ++i)
  {
    if (matches.Partners[i] != NoPartner)
    {
      const SkeletonVertex &from = earlier.Particles[i], &to = later.Particles[matches.Partners[i]];
      const double way = std::hypot(to.Position[0] - from.Position[0],
        to.Position[1] - from.Position[1], to.Position[2] - from.Position[2]);
      longest = std::max(longest, way + std::fabs(to.Radius - from.Radius));
    }
  }
  return longest;
}

void InterpolateParticles(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, double fraction, std::vector<SkeletonVertex>& particles,
  std::vector<ParticleOrigin>* origins)
{
  Crowd crowd{ particles, origins };
  crowd.Clear();
  for (std::size_t i = 0; i < earlier.Particles.size(); ++i)
  {
    const std::size_t partner = matches.Partners[i];
    SkeletonVertex particle = earlier.Particles[i];
    if (partner == NoPartner)
    {
      crowd.AddFaded(particle, 1.0 - fraction, { i, NoPartner });
      continue;
    }
    MoveTowards(particle, later.Particles[partner], fraction);
    crowd.Add(particle, { i, partner });
  }
  for (const std::size_t birth : matches.Births)
  {
    crowd.AddFaded(later.Particles[birth], fraction, { NoPartner, birth });
  }
}

void InterpolateFits(const ParticleFrame& earlier, const ParticleFrame& later, double fraction,
  const std::vector<ParticleOrigin>& origins, ParticleFits& fits)
{
  fits.resize(origins.size());
  RunEach(origins.size(),
    [&](std::size_t i) { fits[i] = FitOf(origins[i], earlier.Fits, later.Fits, fraction); });
}

void FindOriginsOfEarlier(
  std::size_t count, const ParticleMatches* matches, std::vector<ParticleOrigin>& origins)
{
  origins.resize(count);
  RunEach(count,
    [&](std::size_t i) {
      origins[i] = { i, matches ? matches->Partners[i] : NoPartner };
    });
}

void FindMotion(const ParticleFrame* earlier, const ParticleFrame* later, double duration,
  const std::vector<ParticleOrigin>& origins, std::vector<double>& velocities)
{
  velocities.resize(3 * origins.size());
  RunEach(origins.size(),
    [&](std::size_t i)
    {
      const ParticleOrigin& origin = origins[i];
      double* velocity = &velocities[3 * i];
      std::fill_n(velocity, 3, std::numeric_limits<double>::quiet_NaN());
      if (origin.Earlier != NoPartner && origin.Later != NoPartner && duration > 0.0)
      {
        const double* from = earlier->Particles[origin.Earlier].Position;
        const double* to = later->Particles[origin.Later].Position;
        for (int axis = 0; axis < 3; ++axis)
        {
          velocity[axis] = (to[axis] - from[axis]) / duration;
        }
      }
    });
}

}
