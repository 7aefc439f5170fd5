/**
 * The layers of the band, from the signs of the potential, in the affected leaves of a substep. In
 * other leaves the layers do not change.
 */
#ifndef Layers_h
#define Layers_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

/**
 * Finds the layers and the crossed edges of the affected leaves, from Inside of every leaf. If a
 * layer extends to a missing leaf, creates this leaf in the table and in the tree, and marks this
 * leaf as affected in the set.
 */
void FindLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree);

/** Like FindLayers. In the affected leaves, also finds the active nodes (band and pockets) and sets
 * the nodes outside all layers to + or - the background. */
void RebuildLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree);

/** Replaces leaves without layers and without active nodes by tiles of their sign. */
void DropEmptyLeaves(LeafTable& table, PotentialTree& tree);

/** Numbers the crossed edges leaf by leaf, axis by axis, node by node; returns the count of edges.
 */
std::size_t NumberCrossings(LeafTable& table);

/** ReadActiveMasks copies the active masks from the leaves of the tree, WriteActiveMasks to the
 * leaves. */
void ReadActiveMasks(LeafTable& table);
void WriteActiveMasks(const LeafTable& table);

}

#endif
