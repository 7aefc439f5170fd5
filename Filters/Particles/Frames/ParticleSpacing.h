// Typical distance between neighbouring particles.

#ifndef ParticleSpacing_h
#define ParticleSpacing_h

#include "Frames/ParticleFrame.h"

#include "vtkActiveParticlesModule.h"

namespace activesurface
{

// Returns the median distance of a particle to its third nearest neighbour (the farthest, if there
// are fewer), over a sample of 1,000 to 2,000 particles (all if fewer). For lattices and random
// points the result is within 14 % of the cube root of the volume per particle. In sheets the
// result is within 14 % of the square root of the area per particle. For random points, the
// distance to the nearest particle would be only 0.55 of the cube root. Distances of 0 are ignored;
// returns 0 if all distances are 0, or for fewer than two particles.
VTKACTIVEPARTICLES_EXPORT double FindSpacing(const ParticleFrame& frame);

// Returns the median support radius over the sample of FindSpacing. Needs at least one particle.
VTKACTIVEPARTICLES_EXPORT double FindMedianRadius(const ParticleFrame& frame);

}

#endif
