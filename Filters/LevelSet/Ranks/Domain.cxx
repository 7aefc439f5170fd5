#include "Ranks/Domain.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace activesurface
{

/** The nodes of an OpenVDB tree span 4096, 128 and 8 lattice nodes along an axis. The children of a
 * tree node are ordered by x, y, z. */
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

template <class Iterator>
double Sum(Iterator begin, Iterator end)
{
  return std::accumulate(
    begin, end, 0.0, [](double sum, const LeafCost& leaf) { return sum + leaf.Cost; });
}

/** Returns at most `most` samples of the leaves, at equal steps of the cumulated cost. All samples
 * have the same cost; an expensive leaf is sampled several times. */
std::vector<LeafCost> Thin(const std::vector<LeafCost>& costs, std::size_t most)
{
  const double each = Sum(costs.begin(), costs.end()) / static_cast<double>(most);
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

std::shared_ptr<const Domain> Domain::Share(const Agreement& ranks, std::vector<LeafCost> own)
{
  constexpr std::size_t mostSamples = 4096, leastSamplesOfRank = 256;
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  Sort(own);
  std::vector<LeafCost> all =
    ranks.ExchangeValues(Thin(own, std::max(mostSamples / size, leastSamplesOfRank)));
  Sort(all);
  const std::shared_ptr<Domain> domain(new Domain(ranks));
  for (std::size_t rank = 1; rank < size && !all.empty(); ++rank)
  {
    domain->Firsts.push_back(all[rank * all.size() / size].Origin);
  }
  domain->Divide(all.begin(), all.end(), 0, ranks.GetSize());
  return domain;
}

// Divides the leaves by a plane between the ranks below `middle` and the ranks from `middle` on.
// The plane is normal to the longest side of the leaves' box. The plane divides the costs as nearly
// as possible in the ratio of the numbers of ranks.
void Domain::Divide(CostIterator begin, CostIterator end, int first, int last)
{
  const int middle = first + (last - first) / 2;
  if (middle == first || begin == end)
  {
    return;
  }
  Cut& cut = this->Cuts[static_cast<std::size_t>(middle)];
  int longest = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto sides = std::minmax_element(begin, end,
      [axis](const LeafCost& a, const LeafCost& b) { return a.Origin[axis] < b.Origin[axis]; });
    const int length = sides.second->Origin[axis] - sides.first->Origin[axis];
    cut.Axis = length > longest ? axis : cut.Axis;
    longest = std::max(longest, length);
  }
  const int axis = cut.Axis;
  std::stable_sort(begin, end,
    [axis](const LeafCost& a, const LeafCost& b) { return a.Origin[axis] < b.Origin[axis]; });
  const double wanted = Sum(begin, end) * (middle - first) / (last - first);
  double before = 0.0, nearest = HUGE_VAL;
  CostIterator upper = begin;
  for (CostIterator leaf = begin; leaf != end; ++leaf)
  {
    const bool isNext = leaf == begin || leaf->Origin[axis] != (leaf - 1)->Origin[axis];
    if (isNext && std::fabs(before - wanted) < nearest)
    {
      nearest = std::fabs(before - wanted);
      upper = leaf;
    }
    before += leaf->Cost;
  }
  constexpr int side = 8;
  const bool isAllBelow = std::fabs(before - wanted) < nearest;
  upper = isAllBelow ? end : upper;
  cut.Place = isAllBelow ? (end - 1)->Origin[axis] + side : upper->Origin[axis];
  this->Divide(begin, upper, first, middle);
  this->Divide(upper, end, middle, last);
}

int Domain::OwnerOf(const NodeIndex& node) const
{
  int first = 0, last = this->Ranks.GetSize();
  while (last - first > 1)
  {
    const int middle = first + (last - first) / 2;
    const Cut& cut = this->Cuts[static_cast<std::size_t>(middle)];
    (node[static_cast<std::size_t>(cut.Axis)] < cut.Place ? last : first) = middle;
  }
  return first;
}

void Domain::ListOwners(const NodeIndex& low, const NodeIndex& high, std::vector<int>& owners) const
{
  constexpr std::size_t mostHalvings = 32; // of a 32-bit number of ranks
  std::array<std::array<int, 2>, mostHalvings> upper;
  std::size_t waiting = 0;
  int first = 0, last = this->Ranks.GetSize();
  owners.clear();
  while (true)
  {
    while (last - first > 1)
    {
      const int middle = first + (last - first) / 2;
      const Cut& cut = this->Cuts[static_cast<std::size_t>(middle)];
      const auto axis = static_cast<std::size_t>(cut.Axis);
      const bool isBelow = low[axis] < cut.Place, isAbove = high[axis] >= cut.Place;
      if (isBelow && isAbove)
      {
        upper[waiting++] = { middle, last };
      }
      (isBelow ? last : first) = middle;
    }
    owners.push_back(first);
    if (waiting == 0)
    {
      return;
    }
    first = upper[--waiting][0];
    last = upper[waiting][1];
  }
}

void Domain::ListOthersAround(const NodeIndex& leaf, std::vector<int>& others) const
{
  constexpr int side = 8;
  this->ListOwners({ leaf[0] - side, leaf[1] - side, leaf[2] - side },
    { leaf[0] + 2 * side - 1, leaf[1] + 2 * side - 1, leaf[2] + 2 * side - 1 }, others);
  others.erase(std::remove(others.begin(), others.end(), this->Ranks.GetRank()), others.end());
}

int Domain::CounterOf(const NodeIndex& leaf) const
{
  return static_cast<int>(
    std::upper_bound(this->Firsts.begin(), this->Firsts.end(), leaf,
      [](const NodeIndex& a, const NodeIndex& b) { return IsBeforeInTree(a, b); }) -
    this->Firsts.begin());
}

std::vector<std::size_t> ShareLeaves(const std::vector<std::size_t>& costsBefore, int ranks)
{
  const std::size_t all = costsBefore.back();
  const auto count = static_cast<std::size_t>(ranks);
  std::vector<std::size_t> first;
  first.reserve(count + 1);
  for (std::size_t rank = 0; rank < count; ++rank)
  {
    // Computes all * rank / count without overflow of all * rank.
    const std::size_t share = all / count * rank + all % count * rank / count;
    const auto found = std::lower_bound(costsBefore.begin(), costsBefore.end(), share);
    first.push_back(static_cast<std::size_t>(found - costsBefore.begin()));
  }
  first.push_back(costsBefore.size() - 1);
  return first;
}

}
