// Which leaves belong to which rank: ranges of the leaves' own order, balanced by what they cost.

#ifndef LeafRanges_h
#define LeafRanges_h

#include <cstddef>
#include <vector>

namespace activesurface
{

// costsBefore: of each leaf the costs of all leaves before it, and at the end those of all. Returns
// the first leaf of each rank, and at the end the number of leaves. A range differs from its even
// share by less than the costs of one leaf at each of its ends.
std::vector<std::size_t> ShareLeaves(const std::vector<std::size_t>& costsBefore, int ranks);

}

#endif
