/**
 * Values of the ghosts, and of the nodes that entered the band, by extrapolation from smaller
 * layers.
 *
 * The layers are filled in ascending order. A node of layer m uses only nodes of smaller layers, so
 * the order within a layer does not matter. a1, a2, a3 are |u| at the next three nodes in each of
 * the six directions, if all three are in smaller layers:
 *
 *   a = a1 + g,  g = 2 (a1 - a2) - (a2 - a3) limited to [0, 2 (a1 - a2)],  weight g^2
 *
 * If the weights sum to 0, or to less than 1 % of the largest (a1 - a2)^2, LayerFill adds rays of
 * two nodes and corners of squares. Extrapolation from three points makes tension converge under
 * refinement. Four points would be more exact but are unstable at a steady state. A node that
 * entered the band was not updated by this substep; its old value would be wrong by 0.1 %.
 */
#ifndef GhostFill_h
#define GhostFill_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

/** Fills ghosts, and nodes that entered the band, in the affected leaves; fills ghosts of layer 4
 * in leaves next to the affected leaves. */
void FillGhosts(LeafTable& table, const ActiveSet& set);

}

#endif
