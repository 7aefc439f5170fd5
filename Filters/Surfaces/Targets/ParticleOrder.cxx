#include "Targets/ParticleOrder.h"

#include <algorithm>
#include <tuple>

namespace activesurface
{

namespace
{

// What decides most comparisons, beside the particle's place in the frame: to sort the particles
// themselves, or their places alone, takes three times as long.
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

// keyOf: a number for each particle.
template <class Number, class KeyOf>
std::vector<std::size_t> FindOrder(const ParticleList& particles, KeyOf&& keyOf)
{
  const auto isBefore = CompareKeys<Number>(particles);
  const std::size_t count = particles.size();
  const auto make = [&keyOf](std::size_t i) { return OrderKey<Number>{ keyOf(i), i }; };
  std::size_t next = 1;
  while (next < count && isBefore(make(next - 1), make(next)))
  {
    ++next;
  }
  std::vector<std::size_t> order;
  if (next >= count)
  {
    return order;
  }
  std::vector<OrderKey<Number>> keys;
  keys.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    keys.push_back(make(i));
  }
  std::sort(keys.begin(), keys.end(), isBefore);
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
