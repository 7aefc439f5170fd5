// The usual distance of particles.

#ifndef ParticleSpacing_h
#define ParticleSpacing_h

#include "Targets/ParticleFrame.h"

namespace activesurface
{

// Median distance of a particle to its third nearest, among about a thousand of them: the cube root
// of the volume per particle within 14 %, for lattices as for random points, where the nearest is
// at .55 of it, and for sheets. 0 if no two particles have different positions.
double FindSpacing(const ParticleFrame& frame);

// Median among about a thousand of them; there has to be one.
double FindMedianRadius(const ParticleFrame& frame);

}

#endif
