#include "Frames/ParticleMatches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

// Indices of the particles by ascending id; equal ids keep their order.
std::vector<std::size_t> SortByIds(const std::vector<std::int64_t>& ids)
{
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (!std::is_sorted(ids.begin(), ids.end())) // usually sorted
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

double DiagonalOf(const WholeFrame& whole, const PeriodicBox& box)
{
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3 && whole.Particles > 0; ++axis)
  {
    const double side = box.Length[axis];
    const double length = side > 0.0 ? side : whole.High[axis] - whole.Low[axis];
    square += length * length;
  }
  return std::sqrt(square);
}

// Returns the later particles without a partner.
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

bool CanMatch(const ParticleFrame& earlier, const ParticleFrame& later)
{
  return earlier.HasIds == later.HasIds &&
    (earlier.HasIds || earlier.CountAllPoints() == later.CountAllPoints());
}

}

std::vector<NumberedDisplacement> SampleDisplacements(const ParticleFrame& earlier,
  const ParticleFrame& later, const std::vector<std::size_t>& partners, const PeriodicBox& box)
{
  constexpr std::size_t enough = 1000;
  const auto stride = static_cast<std::int64_t>(1 + earlier.CountAllParticles() / enough);
  std::vector<NumberedDisplacement> displacements;
  for (std::size_t i = 0; i < partners.size(); ++i)
  {
    if (partners[i] != NoPartner && earlier.Ids[i] % stride == 0)
    {
      const SkeletonVertex from = earlier.Particles[i], to = later.Particles[partners[i]];
      NumberedDisplacement displacement{ earlier.Ids[i], {} };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        displacement.Displacement[axis] =
          box.Nearest(axis, to.Position[axis] - from.Position[axis]);
      }
      displacements.push_back(displacement);
    }
  }
  return displacements;
}

// Particles without ids count as shuffled if there are at least 100, and if the median
// displacement, after subtraction of the mean displacement, exceeds 20 % of the diagonal of the
// particles' box. Along a periodic axis, the box has the length of the period.
bool AreShuffled(std::vector<NumberedDisplacement> displacements, const ParticleFrame& earlier,
  const PeriodicBox& box)
{
  constexpr std::size_t fewParticles = 100; // fewer particles do not count as shuffled
  constexpr double acrossTheCloud = 0.2;    // fraction of the cloud's diagonal
  if (displacements.empty() || earlier.HasIds || earlier.CountAllParticles() < fewParticles)
  {
    return false;
  }
  std::sort(displacements.begin(), displacements.end(),
    [](const NumberedDisplacement& a, const NumberedDisplacement& b)
    { return a.Number < b.Number; });
  std::array<double, 3> mean = { 0.0, 0.0, 0.0 };
  for (const NumberedDisplacement& displacement : displacements)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mean[axis] += displacement.Displacement[axis] / static_cast<double>(displacements.size());
    }
  }
  std::vector<double> lengths;
  for (const NumberedDisplacement& displacement : displacements)
  {
    const double x = displacement.Displacement[0] - mean[0],
                 y = displacement.Displacement[1] - mean[1],
                 z = displacement.Displacement[2] - mean[2];
    lengths.push_back(std::sqrt(x * x + y * y + z * z));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const WholeFrame whole = earlier.Whole ? *earlier.Whole : earlier.Describe();
  return *middle > acrossTheCloud * DiagonalOf(whole, box);
}

ParticleMatches PairParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, bool areShuffled)
{
  ParticleMatches matches;
  matches.AreShuffled = areShuffled;
  matches.Partners.assign(earlier.Particles.size(), NoPartner);
  if (CanMatch(earlier, later) && !areShuffled)
  {
    MatchIds(earlier.Ids, later.Ids, matches.Partners);
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

ParticleMatches InvertMatches(const ParticleMatches& matches, std::size_t earlier)
{
  ParticleMatches inverse;
  inverse.Partners.assign(earlier, NoPartner);
  for (std::size_t i = 0; i < matches.Partners.size(); ++i)
  {
    if (matches.Partners[i] != NoPartner)
    {
      inverse.Partners[matches.Partners[i]] = i;
    }
  }
  inverse.Deaths = matches.Births;
  inverse.Births = matches.Deaths;
  inverse.AreShuffled = matches.AreShuffled;
  return inverse;
}

ParticleMatches MatchParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, const PeriodicBox& box)
{
  ParticleMatches matches = PairParticles(earlier, later, false);
  return AreShuffled(SampleDisplacements(earlier, later, matches.Partners, box), earlier, box)
    ? PairParticles(earlier, later, true)
    : matches;
}

double FindLargestDisplacement(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, const PeriodicBox& box)
{
  double longest = 0.0;
  for (std::size_t i = 0; i < earlier.Particles.size(); ++i)
  {
    if (matches.Partners[i] != NoPartner)
    {
      const SkeletonVertex from = earlier.Particles[i], to = later.Particles[matches.Partners[i]];
      const double displacement = std::hypot(box.Nearest(0, to.Position[0] - from.Position[0]),
        box.Nearest(1, to.Position[1] - from.Position[1]),
        box.Nearest(2, to.Position[2] - from.Position[2]));
      longest = std::max(longest, displacement + std::fabs(to.Radius - from.Radius));
    }
  }
  return longest;
}

bool FindVelocity(const ParticleFrame* earlier, const ParticleFrame* later,
  const ParticleOrigin& origin, const PeriodicBox& box, double duration, double (&velocity)[3])
{
  if (origin.Earlier == NoPartner || origin.Later == NoPartner || duration == 0.0)
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
