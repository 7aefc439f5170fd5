/**
 * Values of the ghosts, and of the nodes that entered the band, by extrapolation from inside.
 *
 * The layers are filled one after the other. A node of layer m uses nodes of smaller layers only,
 * so the order within a layer does not matter. With a_i = |u_i|, all of one sign, along each of the
 * six directions:
 *
 *   a = a1 + g,  g = 2 (a1 - a2) - (a2 - a3) limited to [0, 2 (a1 - a2)],  weight g^2
 *
 * where the third node exists, else g = a1 - a2. Three points make tension converge; four would be
 * more exact but are unstable at a steady state. A node that enters the band was not updated by
 * this substep; keeping its old value would be a 0.1 % error, so it is filled too.
 */
#ifndef GhostFill_h
#define GhostFill_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

/** Fills them where they may have changed: in the affected leaves and next to them. */
void FillGhosts(LeafTable& table, const ActiveSet& set);

}

#endif
