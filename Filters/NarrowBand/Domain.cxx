#include "Domain.h"

#include <algorithm>
#include <utility>

namespace activesurface
{

/** Nodes of a tree hold 4096, 128 and 8 lattice nodes along an axis, and their children by x, y, z.
 */
bool IsBeforeInTree(const NodeIndex& a, const NodeIndex& b)
{
  for (const int shift : { 12, 7, 3 })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int left = a[axis] >> shift, right = b[axis] >> shift;
      if (left != right)
      {
        return left < right;
      }
    }
  }
  return false;
}

namespace
{

void Sort(std::vector<LeafCost>& costs)
{
  std::sort(costs.begin(), costs.end(),
    [](const LeafCost& a, const LeafCost& b) { return IsBeforeInTree(a.Origin, b.Origin); });
}

double Sum(const std::vector<LeafCost>& costs)
{
  double sum = 0.0;
  for (const LeafCost& leaf : costs)
  {
    sum += leaf.Cost;
  }
  return sum;
}

/** Returns at most `most` leaves with equal costs for sorted ones. */
std::vector<LeafCost> Thin(const std::vector<LeafCost>& costs, std::size_t most)
{
  const double each = Sum(costs) / static_cast<double>(most);
  std::vector<LeafCost> thinned;
  double before = 0.0;
  for (const LeafCost& leaf : costs)
  {
    before += leaf.Cost;
    for (double next = (static_cast<double>(thinned.size()) + 0.5) * each;
         next < before && thinned.size() < most;
         next = (static_cast<double>(thinned.size()) + 0.5) * each)
    {
      thinned.push_back({ leaf.Origin, each });
    }
  }
  return thinned;
}

}

Domain::Domain(const Agreement& ranks, std::vector<NodeIndex> firsts)
  : Ranks(ranks)
  , Firsts(std::move(firsts))
{
}

std::shared_ptr<const Domain> Domain::Share(const Agreement& ranks, std::vector<LeafCost> own)
{
  constexpr std::size_t samplesPerRank = 64, mostSamples = 4096;
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  Sort(own);
  std::vector<LeafCost> all =
    ranks.ExchangeValues(Thin(own, std::min(samplesPerRank * size, mostSamples)));
  Sort(all);
  const double each = Sum(all) / static_cast<double>(size);
  std::vector<NodeIndex> firsts;
  double before = 0.0;
  for (const LeafCost& leaf : all)
  {
    while (firsts.size() + 1 < size && before >= static_cast<double>(firsts.size() + 1) * each)
    {
      firsts.push_back(leaf.Origin);
    }
    before += leaf.Cost;
  }
  constexpr int last = 1 << 30;
  firsts.resize(size - 1, { last, last, last });
  return std::make_shared<const Domain>(ranks, firsts);
}

int Domain::OwnerOf(const NodeIndex& node) const
{
  return static_cast<int>(
    std::upper_bound(this->Firsts.begin(), this->Firsts.end(), node,
      [](const NodeIndex& a, const NodeIndex& b) { return IsBeforeInTree(a, b); }) -
    this->Firsts.begin());
}

void Domain::ListOwners(const NodeIndex& low, const NodeIndex& high, std::vector<int>& owners) const
{
  NodeIndex leaf;
  for (leaf[0] = low[0] & ~7; leaf[0] <= high[0]; leaf[0] += 8)
  {
    for (leaf[1] = low[1] & ~7; leaf[1] <= high[1]; leaf[1] += 8)
    {
      for (leaf[2] = low[2] & ~7; leaf[2] <= high[2]; leaf[2] += 8)
      {
        const int owner = this->OwnerOf(leaf);
        if (std::find(owners.begin(), owners.end(), owner) == owners.end())
        {
          owners.push_back(owner);
        }
      }
    }
  }
}

void Domain::ListOthersAround(const NodeIndex& leaf, std::vector<int>& others) const
{
  constexpr int side = 8;
  others.push_back(this->Ranks.GetRank());
  this->ListOwners({ leaf[0] - side, leaf[1] - side, leaf[2] - side },
    { leaf[0] + side, leaf[1] + side, leaf[2] + side }, others);
  others.erase(std::find(others.begin(), others.end(), this->Ranks.GetRank()));
}

}
