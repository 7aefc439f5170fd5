#include "Frames/ParticleOrder.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace activesurface
{

namespace
{

// Sort key: the number that decides most comparisons, and the particle's index in the frame.
// Sorting the particles themselves, or only their indices, needs three times as long.
template <class Number>
struct OrderKey
{
  Number First;
  std::size_t Place;
};

auto PlaceOf(const SkeletonVertex& particle)
{
  return std::make_tuple(particle.Position[0], particle.Position[1], particle.Position[2],
    particle.Radius, particle.Strength);
}

template <class Number>
auto CompareKeys(const ParticleList& particles)
{
  return [&particles](const OrderKey<Number>& a, const OrderKey<Number>& b)
  {
    if (a.First != b.First)
    {
      return a.First < b.First;
    }
    const auto placeOfA = PlaceOf(particles[a.Place]);
    const auto placeOfB = PlaceOf(particles[b.Place]);
    return placeOfA != placeOfB ? placeOfA < placeOfB : a.Place < b.Place;
  };
}

// Merges a few sorted runs of keys; each rank sends one run. ends: end index of each run.
template <class Key, class IsBefore>
void MergeRuns(std::vector<std::size_t> ends, std::vector<Key>& keys, IsBefore&& isBefore)
{
  const auto at = [&keys](std::size_t i) { return keys.begin() + static_cast<std::ptrdiff_t>(i); };
  while (ends.size() > 1)
  {
    std::vector<std::size_t> merged;
    std::size_t begin = 0;
    for (std::size_t run = 1; run < ends.size(); run += 2)
    {
      std::inplace_merge(at(begin), at(ends[run - 1]), at(ends[run]), isBefore);
      begin = ends[run];
      merged.push_back(begin);
    }
    if (begin != ends.back())
    {
      merged.push_back(ends.back());
    }
    ends.swap(merged);
  }
}

// keyOf(i): the key of particle i that decides most comparisons.
template <class Number, class KeyOf>
std::vector<std::size_t> FindOrder(const ParticleList& particles, KeyOf&& keyOf)
{
  const auto isBefore = CompareKeys<Number>(particles);
  const std::size_t count = particles.size();
  const auto make = [&keyOf](std::size_t i) { return OrderKey<Number>{ keyOf(i), i }; };
  constexpr std::size_t mostRuns = 64;
  std::vector<std::size_t> ends;
  for (std::size_t next = 1; next < count && ends.size() < mostRuns; ++next)
  {
    if (!isBefore(make(next - 1), make(next)))
    {
      ends.push_back(next);
    }
  }
  std::vector<std::size_t> order;
  if (ends.empty())
  {
    return order;
  }
  std::vector<OrderKey<Number>> keys;
  keys.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    keys.push_back(make(i));
  }
  if (ends.size() < mostRuns)
  {
    ends.push_back(count);
    MergeRuns(std::move(ends), keys, isBefore);
  }
  else
  {
    std::sort(keys.begin(), keys.end(), isBefore);
  }
  order.reserve(count);
  for (const OrderKey<Number>& key : keys)
  {
    order.push_back(key.Place);
  }
  return order;
}

}

std::vector<std::size_t> FindParticleOrder(
  const ParticleList& particles, const std::vector<std::int64_t>* ids)
{
  return ids ? FindOrder<std::int64_t>(particles, [ids](std::size_t i) { return (*ids)[i]; })
             : FindOrder<double>(
                 particles, [&particles](std::size_t i) { return particles[i].Position[0]; });
}

}
