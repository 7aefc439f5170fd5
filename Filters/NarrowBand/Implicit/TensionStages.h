/**
 * The tension of an implicit substep: Runge-Kutta-Legendre stages on fixed layers, damped towards
 * the displaced potential (see StepPlan.h).
 */
#ifndef TensionStages_h
#define TensionStages_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

class StepPlan;
struct SubstepBuffers;

/** Leaves Next of the active leaves, the last stage. Ghosts are filled on the way. isWeighted:
 * whether the buffers' weights multiply Tension. Returns whether Next is bounded, see
 * GradientCounts. */
bool MakeTensionStages(LeafTable& table, const ActiveSet& set, const StepPlan& plan,
  bool isWeighted, SubstepBuffers& buffers);

}

#endif
