#include "Targets/HomeParticles.h"

#include "Targets/ParticleBytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

// Facts of a rank's piece of an input.
struct PieceFacts
{
  std::uint64_t Points;
  std::uint64_t Content;
  std::uint64_t HasCells;
  std::uint64_t HasIds;
};

// What the pieces are together.
struct AllFacts
{
  std::uint64_t PointsBefore = 0; // of lower ranks
  std::uint64_t Points = 0;
  std::uint64_t Content = 0;
  bool HasCells = false;
  bool HasIds = false;
};

AllFacts CombineFacts(const Agreement& ranks, const ParticleShape& piece)
{
  const ParticleFrame& particles = *piece.GetParticles();
  const std::size_t points = particles.CountAllPoints();
  const PieceFacts own = { points, points > 0 ? piece.Content : 0,
    points > 0 && piece.HasCells() ? 1u : 0u, particles.HasIds ? 1u : 0u };
  AllFacts all;
  int rank = 0;
  for (const PieceFacts& facts : ranks.ExchangeValue(own))
  {
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ull;
    all.PointsBefore += rank++ < ranks.GetRank() ? facts.Points : 0;
    all.Points += facts.Points;
    all.Content = (all.Content ^ facts.Content) * factor + facts.Points;
    all.HasCells = all.HasCells || facts.HasCells;
    all.HasIds = all.HasIds || facts.HasIds;
  }
  return all;
}

std::size_t HomeOfId(std::int64_t id, std::size_t ranks)
{
  auto key = static_cast<std::uint64_t>(id);
  key = (key ^ (key >> 31)) * 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 29)) * 0xbf58476d1ce4e5b9ull;
  return static_cast<std::size_t>((key ^ (key >> 32)) % ranks);
}

// The particles in the box of all ranks. Collective.
WholeFrame DescribeWhole(const Agreement& ranks, const ParticleFrame& part, std::size_t points)
{
  WholeFrame whole;
  for (const WholeFrame& ofRank : ranks.ExchangeValue(part.Describe()))
  {
    whole.Add(ofRank);
  }
  whole.Points = points;
  return whole;
}

}

std::shared_ptr<ParticleShape> SendHome(
  const Agreement& ranks, const ParticleShape& piece, const ParticleArrays& kept)
{
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  const AllFacts all = CombineFacts(ranks, piece);
  ParticleFrame own = *piece.GetParticles();
  own.HasIds = all.HasIds;
  if (!own.HasIds)
  {
    for (std::int64_t& number : own.Ids)
    {
      number += static_cast<std::int64_t>(all.PointsBefore);
    }
  }
  std::vector<ParticleChoice> chosen(size);
  for (std::size_t i = 0; i < own.Ids.size(); ++i)
  {
    const std::int64_t id = own.Ids[i];
    const std::size_t to =
      own.HasIds ? HomeOfId(id, size) : static_cast<std::uint64_t>(id) * size / all.Points;
    chosen[to].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Bytes> toEach;
  toEach.reserve(size);
  for (const ParticleChoice& ofRank : chosen)
  {
    toEach.push_back(PackParticles(own, ofRank));
  }
  ParticleFrame home = MergeParticles(ranks.Distribute(toEach), own);
  home.Whole = DescribeWhole(ranks, home, all.Points);
  auto shape = std::make_shared<ParticleShape>(std::move(home), kept, all.HasCells);
  shape->Content = all.Content;
  return shape;
}

std::shared_ptr<InputShape> GatherShape(const InputShape& home)
{
  std::shared_ptr<InputShape> whole;
  if (home.Home->ReadWhole)
  {
    whole = home.Home->ReadWhole();
    whole->Content = home.Content;
    return whole;
  }
  const ParticleFrame& part = *home.GetParticles();
  ParticleChoice all(part.Particles.size());
  std::iota(all.begin(), all.end(), 0u);
  ParticleFrame frame =
    MergeParticles(home.Home->Ranks.Exchange(PackParticles(part, all)), part);
  frame.Ignored = part.CountAllPoints() - part.CountAllParticles();
  return dynamic_cast<const ParticleShape&>(home).MakeOther(std::move(frame));
}

}
