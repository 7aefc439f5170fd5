/**
 * Validation of the tree of a saved state.
 */
#ifndef SavedTree_h
#define SavedTree_h

#include "Base/OpenVDB.h"

namespace activesurface
{

/** Throws std::runtime_error if the surface crosses an edge from a leaf to a tile, because the band
 * would grow along the whole tile, or if a leaf is beyond 2^30 nodes. */
void CheckTree(const openvdb::FloatTree& tree);

/** Throws std::runtime_error: the saved state is damaged. */
[[noreturn]] void RefuseState();

}

#endif
