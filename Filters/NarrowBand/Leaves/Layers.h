/**
 * The layers of the band, found from the signs of the potential, in the affected leaves of a
 * substep: elsewhere they stay as they are.
 */
#ifndef Layers_h
#define Layers_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

/**
 * From Inside of every leaf: the layers and the crossed edges of the affected leaves. Creates the
 * leaves that a layer has reached, in the table, in the tree and as affected ones in the set.
 */
void FindLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree);

/** FindLayers, then finds the active nodes (band and pockets) and sets the nodes outside all layers
 * to + or - the background. */
void RebuildLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree);

/** Replaces leaves without nodes of a layer and without active nodes by tiles of their sign. */
void DropEmptyLeaves(LeafTable& table, PotentialTree& tree);

/** Numbers the crossed edges leaf by leaf, axis by axis, node by node; returns how many. */
std::size_t NumberCrossings(LeafTable& table);

/** Reads the active masks from the leaves of the tree, or writes them there. */
void ReadActiveMasks(LeafTable& table);
void WriteActiveMasks(const LeafTable& table);

}

#endif
