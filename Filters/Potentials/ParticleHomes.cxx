#include "ParticleHomes.h"

#include "MortonOrder.h"
#include "SharedResults.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

using Block = BlockTable::Block;
using Coordinate = BlockTable::Coordinate;

constexpr std::size_t RadiiLookedAt = 1000;
constexpr double FarthestBlock = 1e15; // those beyond are one
constexpr Coordinate MostBlocks = 512; // of a box that is looked at closely

// The median of some of all ranks, evenly picked: a few that are very large count little.
double FindUsualRadius(Agreement& ranks, const std::vector<SkeletonVertex>& particles)
{
  std::vector<double> own;
  const std::size_t step = 1 + particles.size() * ranks.GetSize() / RadiiLookedAt;
  for (std::size_t i = 0; i < particles.size(); i += step)
  {
    own.push_back(particles[i].Radius);
  }
  std::vector<double> radii = GatherLists(ranks, own);
  if (radii.empty())
  {
    return 1.0;
  }
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

// Itself, too.
template <class Function>
void ForEachAround(const Block& block, Function function)
{
  for (int n = 0; n < 27; ++n)
  {
    function(Block{
      { block.At[0] + n / 9 - 1, block.At[1] + n / 3 % 3 - 1, block.At[2] + n % 3 - 1 }, 0 });
  }
}

// Of one rank, or of all.
struct CountedBlock
{
  Block At;
  std::size_t Particles;
};

}

ParticleHomes::ParticleHomes(
  Agreement& ranks, const std::vector<SkeletonVertex>& particles, double ballPerRadius)
  : Own(ranks.GetRank())
  , Count(ranks.GetSize())
  , InverseWidth(1.0 / (2.0 * ballPerRadius * FindUsualRadius(ranks, particles)))
{
  this->ShareBlocks(this->GatherBlocks(ranks, particles));
  this->FindInner();
}

std::vector<std::size_t> ParticleHomes::GatherBlocks(
  Agreement& ranks, const std::vector<SkeletonVertex>& particles)
{
  BlockTable table;
  table.Clear();
  std::vector<CountedBlock> own;
  for (const SkeletonVertex& particle : particles)
  {
    const Block block = this->FindBlock(particle.Position);
    const BlockTable::Index number = table.Add(block);
    if (number == own.size())
    {
      own.push_back({ block, 0 });
    }
    ++own[number].Particles;
  }
  this->Blocks.Clear();
  std::vector<std::size_t> counts;
  for (const CountedBlock& block : GatherLists(ranks, own))
  {
    const BlockTable::Index number = this->Blocks.Add(block.At);
    counts.resize(this->Blocks.Size());
    counts[number] += block.Particles;
  }
  return counts;
}

void ParticleHomes::ShareBlocks(const std::vector<std::size_t>& counts)
{
  std::vector<std::size_t> order(counts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [this](std::size_t a, std::size_t b)
    { return IsBeforeInMortonOrder(this->Blocks[a].At, this->Blocks[b].At); });
  const double all =
    static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t(0)));
  this->Homes.resize(counts.size());
  std::size_t before = 0;
  for (const std::size_t block : order)
  {
    const double middle = static_cast<double>(before) + 0.5 * static_cast<double>(counts[block]);
    this->Homes[block] = std::min(static_cast<int>(middle / all * this->Count), this->Count - 1);
    before += counts[block];
  }
}

ParticleHomes::Block ParticleHomes::FindBlock(const double x[3]) const
{
  Block block{ {}, 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at =
      std::min(std::max(x[axis] * this->InverseWidth, -FarthestBlock), FarthestBlock);
    const auto cut = static_cast<Coordinate>(at); // towards 0
    block.At[axis] = cut - (static_cast<double>(cut) > at ? 1 : 0);
  }
  return block;
}

int ParticleHomes::FindHome(const double x[3]) const
{
  return this->Homes[this->Blocks.Find(this->FindBlock(x))];
}

template <class Visitor>
void ParticleHomes::VisitBlocks(const double bounds[6], Visitor visit) const
{
  const double low[] = { bounds[0], bounds[2], bounds[4] };
  const double high[] = { bounds[1], bounds[3], bounds[5] };
  const Block first = this->FindBlock(low), last = this->FindBlock(high);
  const auto count = [&](int axis) { return last.At[axis] - first.At[axis] + 1; };
  if (count(0) > MostBlocks / count(1) / count(2))
  {
    for (int rank = 0; rank < this->Count; ++rank)
    {
      visit(rank);
    }
    return;
  }
  Block block{ {}, 0 };
  for (block.At[0] = first.At[0]; block.At[0] <= last.At[0]; ++block.At[0])
  {
    for (block.At[1] = first.At[1]; block.At[1] <= last.At[1]; ++block.At[1])
    {
      for (block.At[2] = first.At[2]; block.At[2] <= last.At[2]; ++block.At[2])
      {
        const BlockTable::Index found = this->Blocks.Find(block);
        if (found != BlockTable::None)
        {
          visit(this->Homes[found]);
        }
      }
    }
  }
}

void ParticleHomes::FindInner()
{
  for (std::size_t i = 0; i < this->Blocks.Size(); ++i)
  {
    bool isInner = true;
    ForEachAround(this->Blocks[i],
      [&](const Block& block)
      {
        const BlockTable::Index found = this->Blocks.Find(block);
        isInner = isInner && (found == BlockTable::None || this->Homes[found] == this->Own);
      });
    this->AreInner.push_back(isInner ? 1 : 0);
  }
}

bool ParticleHomes::IsAround(const Block& block, const double bounds[6]) const
{
  bool isAround = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = static_cast<double>(block.At[axis]);
    isAround = isAround && bounds[2 * axis] * this->InverseWidth > at - 1.0 &&
      bounds[2 * axis + 1] * this->InverseWidth < at + 2.0;
  }
  return isAround;
}

std::vector<std::size_t> ParticleHomes::ListOtherHomes(
  const double x[3], const double bounds[6]) const
{
  std::vector<std::size_t> others;
  const Block own = this->FindBlock(x);
  if (this->AreInner[this->Blocks.Find(own)] && this->IsAround(own, bounds))
  {
    return others;
  }
  this->VisitBlocks(bounds,
    [&](int rank)
    {
      const auto other = static_cast<std::size_t>(rank);
      const auto place = std::lower_bound(others.begin(), others.end(), other);
      if (rank != this->Own && (place == others.end() || *place != other))
      {
        others.insert(place, other);
      }
    });
  return others;
}

}
