#include "Targets/ParticleNumbers.h"

#include "SharedResults.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace activesurface
{

namespace
{

constexpr std::size_t SamplesPerRank = 64;

// By id if there are ids, else by place; equal ones stay in the order of the input.
struct Key
{
  std::int64_t Id;
  SkeletonVertex Particle;
  vtkIdType Point;
};

auto ValuesOf(const Key& key)
{
  const SkeletonVertex& particle = key.Particle;
  return std::tie(key.Id, particle.Position[0], particle.Position[1], particle.Position[2],
    particle.Radius, particle.Strength, key.Point);
}

bool operator<(const Key& a, const Key& b)
{
  return ValuesOf(a) < ValuesOf(b);
}

// A key that a rank is to order.
struct ToOrder
{
  const Key* What;
  std::size_t Rank; // which has it
  std::size_t Place;
};

std::vector<Key> ListKeys(const ParticleFrame& frame)
{
  std::vector<Key> keys;
  keys.reserve(frame.Particles.size());
  for (std::size_t i = 0; i < frame.Particles.size(); ++i)
  {
    keys.push_back({ frame.HasIds ? frame.Ids[i] : 0, frame.Particles[i], frame.Points[i] });
  }
  return keys;
}

// The first key of each rank's range but the first rank's, so that the ranges have about as many.
std::vector<Key> FindBorders(Agreement& ranks, const std::vector<Key>& keys)
{
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  std::size_t all = 0;
  for (const std::size_t count : GatherValues(ranks, keys.size()))
  {
    all += count;
  }
  const std::size_t step = 1 + all / (SamplesPerRank * size);
  std::vector<Key> own;
  for (std::size_t i = step / 2; i < keys.size(); i += step)
  {
    own.push_back(keys[i]);
  }
  std::vector<Key> samples = GatherLists(ranks, own);
  std::sort(samples.begin(), samples.end());
  std::vector<Key> borders;
  for (std::size_t rank = 1; rank < size && !samples.empty(); ++rank)
  {
    borders.push_back(samples[rank * samples.size() / size]);
  }
  return borders;
}

std::vector<std::vector<Key>> Share(
  const std::vector<Key>& keys, const std::vector<Key>& borders, std::size_t size)
{
  std::vector<std::vector<Key>> toEach(size);
  auto first = keys.begin();
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    const auto end =
      rank < borders.size() ? std::lower_bound(first, keys.end(), borders[rank]) : keys.end();
    toEach[rank].assign(first, end);
    first = end;
  }
  return toEach;
}

// The places of each rank's keys among all of them, counted from one on.
std::vector<std::vector<std::size_t>> Order(
  const std::vector<std::vector<Key>>& keys, std::size_t first)
{
  std::vector<ToOrder> all;
  std::vector<std::vector<std::size_t>> numbers(keys.size());
  for (std::size_t rank = 0; rank < keys.size(); ++rank)
  {
    for (std::size_t i = 0; i < keys[rank].size(); ++i)
    {
      all.push_back({ &keys[rank][i], rank, i });
    }
    numbers[rank].resize(keys[rank].size());
  }
  std::sort(
    all.begin(), all.end(), [](const ToOrder& a, const ToOrder& b) { return *a.What < *b.What; });
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    numbers[all[n].Rank][all[n].Place] = first + n;
  }
  return numbers;
}

// How many the ranks before this one have.
std::size_t CountBefore(Agreement& ranks, std::size_t own)
{
  const std::vector<std::size_t> counts = GatherValues(ranks, own);
  std::size_t before = 0;
  for (int rank = 0; rank < ranks.GetRank(); ++rank)
  {
    before += counts[static_cast<std::size_t>(rank)];
  }
  return before;
}

}

std::vector<std::size_t> FindParticleNumbers(Agreement& ranks, const ParticleFrame& frame)
{
  const std::vector<Key> keys = ListKeys(frame);
  const std::vector<std::vector<Key>> fromEach = SwapLists(
    ranks, Share(keys, FindBorders(ranks, keys), static_cast<std::size_t>(ranks.GetSize())));
  std::size_t count = 0;
  for (const std::vector<Key>& some : fromEach)
  {
    count += some.size();
  }
  return SwapAll(ranks, Order(fromEach, CountBefore(ranks, count)));
}

}
