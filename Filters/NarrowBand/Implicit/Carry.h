/**
 * Transport in the implicit integration: a semi-Lagrangian step, u(x) <- u(x - D(x)), D the
 * target's displacement at the end of the step, of any length.
 *
 * D is taken on a lattice of four voxels and interpolated linearly; u by cubic polynomials in the
 * band. What no velocity brings stays where it is, unless a velocity has taken it away. Leaves
 * without displacement keep their bytes.
 */
#ifndef Carry_h
#define Carry_h

#include "Motion.h"
#include "Substep/FollowTarget.h"

namespace activesurface
{

/** From one time to another; layers and ghosts follow. Moves the target to both times. False if
 * nothing moves. */
bool CarrySurface(
  const FollowingBand& band, const Motion& motion, double begin, double end, Target& target);

}

#endif
