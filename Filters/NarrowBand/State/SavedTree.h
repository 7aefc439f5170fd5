/**
 * Whether the tree of a saved state can be one, and what is said where it cannot.
 */
#ifndef SavedTree_h
#define SavedTree_h

#include "OpenVDB.h"

namespace activesurface
{

/** A surface lies within leaves: no edge from a leaf to a tile crosses it, or the band would grow
 * along the whole tile. Throws std::runtime_error where one does. */
void CheckTree(const openvdb::FloatTree& tree);

/** Throws std::runtime_error: the saved state is damaged. */
[[noreturn]] void RefuseState();

}

#endif
