/**
 * Transport: the speeds half a substep upstream.
 *
 * What is carried along the surface with the velocity w is, at the middle of a substep, where the
 * speed was V at x - w dt / 2. The speed there makes the substep one of second order along the
 * surface. With the speed at its beginning, which follows from central gradients, each substep
 * would amplify waves of the surface (of four voxels by 7 %), and a ball would bulge abreast.
 */
#ifndef UpstreamSpeed_h
#define UpstreamSpeed_h

#include "Leaves/ActiveSet.h"
#include "Motion.h"

namespace activesurface
{

struct SubstepBuffers;

/** Replaces the speeds at the nodes with samples of the active leaves; in the affected leaves they
 * have to be known. advection: dt / h. To be called before ExtendSpeed. */
void TakeSpeedUpstream(const LeafTable& table, const ActiveSet& set, const Motion& motion,
  float advection, SubstepBuffers& buffers);

}

#endif
