#include "Targets/ParticleMatches.h"

#include <algorithm>
#include <array>
#include <cmath>
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

double DiagonalOf(const ParticleList& particles, const PeriodicBox& box)
{
  double low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  for (const SkeletonVertex& particle : particles)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], particle.Position[axis]);
      high[axis] = std::max(high[axis], particle.Position[axis]);
    }
  }
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3 && !particles.empty(); ++axis)
  {
    const double side = box.Length[axis];
    const double length = side > 0.0 ? side : high[axis] - low[axis];
    square += length * length;
  }
  return std::sqrt(square);
}

using ParticleStep = std::array<double, 3>;

// Of partners, evenly picked.
std::vector<ParticleStep> PickWays(const ParticleFrame& earlier, const ParticleFrame& later,
  const std::vector<std::size_t>& partners, const PeriodicBox& box)
{
  constexpr std::size_t enough = 1000;
  const std::size_t stride = 1 + partners.size() / enough;
  std::vector<ParticleStep> ways;
  for (std::size_t i = 0; i < partners.size(); i += stride)
  {
    if (partners[i] != NoPartner)
    {
      const SkeletonVertex from = earlier.Particles[i], to = later.Particles[partners[i]];
      ParticleStep way;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        way[axis] = box.Nearest(axis, to.Position[axis] - from.Position[axis]);
      }
      ways.push_back(way);
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

ParticleMatches MatchParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, const PeriodicBox& box)
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
    GoAcross(PickWays(earlier, later, matches.Partners, box), earlier.Particles.size(),
      DiagonalOf(earlier.Particles, box)))
  {
    matches.AreShuffled = true;
    matches.Partners.assign(earlier.Particles.size(), NoPartner);
  }
  for (std::size_t i = 0; i < matches.Partners.size(); ++i)
  {
    if (matches.Partners[i] == NoPartner)
    {
      matches.Deaths.push_back(i);
    }
  }
  matches.Births = FindBirths(matches.Partners, later.Particles.size());
  return matches;
}

double FindLongestWay(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, const PeriodicBox& box)
{
  double longest = 0.0;
  for (std::size_t i = 0; i < earlier.Particles.size(); ++i)
  {
    if (matches.Partners[i] != NoPartner)
    {
      const SkeletonVertex from = earlier.Particles[i], to = later.Particles[matches.Partners[i]];
      const double way = std::hypot(box.Nearest(0, to.Position[0] - from.Position[0]),
        box.Nearest(1, to.Position[1] - from.Position[1]),
        box.Nearest(2, to.Position[2] - from.Position[2]));
      longest = std::max(longest, way + std::fabs(to.Radius - from.Radius));
    }
  }
  return longest;
}

bool FindVelocity(const ParticleFrame* earlier, const ParticleFrame* later,
  const ParticleOrigin& origin, const PeriodicBox& box, double duration, double (&velocity)[3])
{
  if (origin.Earlier == NoPartner || origin.Later == NoPartner || !(duration > 0.0))
  {
    return false;
  }
  const SkeletonVertex from = earlier->Particles[origin.Earlier];
  const SkeletonVertex to = later->Particles[origin.Later];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    velocity[axis] = box.Nearest(axis, to.Position[axis] - from.Position[axis]) / duration;
  }
  return true;
}

}
