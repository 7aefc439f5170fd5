/**
 * How far tension and the other terms of an implicit substep would displace each leaf's surface,
 * and how far both together: at the nodes of crossed edges.
 */
#ifndef LeafBalances_h
#define LeafBalances_h

#include "Implicit/SurfaceMove.h"
#include "Leaves/ActiveSet.h"

namespace activesurface
{

struct SubstepBuffers;

/** Balances of these leaves, from speeds that no displacement has replaced yet. */
void FindBalances(const LeafTable& table, const LeafList& leaves,
  const MoveCoefficients& coefficients, bool isWeighted, SubstepBuffers& buffers);

}

#endif
