#include "Targets/OwnedParticles.h"

#include "Frames/ParticleBytes.h"

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

std::size_t OwnerOfId(std::int64_t id, std::size_t ranks)
{
  auto key = static_cast<std::uint64_t>(id);
  key = (key ^ (key >> 31)) * 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 29)) * 0xbf58476d1ce4e5b9ull;
  return static_cast<std::size_t>((key ^ (key >> 32)) % ranks);
}

// Sums the particle counts and joins the boxes of all ranks. Collective.
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

ParticleFrame SendToOwners(
  const Agreement& ranks, ParticleFrame piece, std::uint64_t before, std::uint64_t all)
{
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  std::vector<ParticleChoice> chosen(size);
  for (std::size_t i = 0; i < piece.Ids.size(); ++i)
  {
    std::int64_t& id = piece.Ids[i];
    id += piece.HasIds ? 0 : static_cast<std::int64_t>(before);
    const std::size_t to =
      piece.HasIds ? OwnerOfId(id, size) : static_cast<std::uint64_t>(id) * size / all;
    chosen[to].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Bytes> toEach;
  toEach.reserve(size);
  for (const ParticleChoice& ofRank : chosen)
  {
    toEach.push_back(PackParticles(piece, ofRank));
  }
  ParticleFrame owned = MergeParticles(ranks.Distribute(std::move(toEach)), piece);
  owned.Whole = DescribeWhole(ranks, owned, all);
  return owned;
}

std::shared_ptr<InputShape> GatherShape(const InputShape& owned)
{
  std::shared_ptr<InputShape> whole;
  if (owned.Owned->ReadWhole)
  {
    whole = owned.Owned->ReadWhole();
    whole->Content = owned.Content;
    return whole;
  }
  const ParticleFrame& part = *owned.GetParticles();
  ParticleChoice all(part.Particles.size());
  std::iota(all.begin(), all.end(), 0u);
  ParticleFrame frame = MergeParticles(owned.Owned->Ranks.Exchange(PackParticles(part, all)), part);
  frame.Ignored = part.CountAllPoints() - part.CountAllParticles();
  return dynamic_cast<const ParticleShape&>(owned).MakeOther(std::move(frame));
}

}
