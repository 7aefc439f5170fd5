/**
 * Layer 0: the corners of the voxels that the surface crosses.
 */
#ifndef LayerZero_h
#define LayerZero_h

#include "LeafTable.h"

namespace activesurface
{

/** Upto[0] of these leaves from the signs, and in Wanted the missing neighbours that have a corner.
 */
void FindLayerZero(LeafTable& table, const LeafList& leaves);

}

#endif
