#include "Ranks/LeafRanges.h"

#include <algorithm>

namespace activesurface
{

std::vector<std::size_t> ShareLeaves(const std::vector<std::size_t>& costsBefore, int ranks)
{
  const std::size_t all = costsBefore.back();
  const auto count = static_cast<std::size_t>(ranks);
  std::vector<std::size_t> first;
  first.reserve(count + 1);
  for (std::size_t rank = 0; rank < count; ++rank)
  {
    // all * rank / count, without the product of all and rank.
    const std::size_t share = all / count * rank + all % count * rank / count;
    const auto found = std::lower_bound(costsBefore.begin(), costsBefore.end(), share);
    first.push_back(static_cast<std::size_t>(found - costsBefore.begin()));
  }
  first.push_back(costsBefore.size() - 1);
  return first;
}

}
