// Typical distance between neighbouring particles.

#ifndef ParticleSpacing_h
#define ParticleSpacing_h

#include "Frames/ParticleFrame.h"

#include "vtkActiveParticlesModule.h"

namespace activesurface
{

// Returns the median distance of a particle to its third nearest neighbour, or to the farthest of
// fewer than three. The sample has 1,000 to 2,000 particles, or all if there are fewer. For
// lattices and random points the result is within 14 % of the cube root of the volume per particle.
// In sheets the result is within 14 % of the square root of the area per particle. The nearest
// neighbour of a random point is at only 0.55 of the cube root. Distances of 0 are ignored; returns
// 0 if all distances are 0, or for fewer than two particles.
VTKACTIVEPARTICLES_EXPORT double FindSpacing(const ParticleFrame& frame);

// Returns the median ratio of a particle's diameter to the distance that FindSpacing uses. Needs
// radii.
VTKACTIVEPARTICLES_EXPORT double FindOverlap(const ParticleFrame& frame);

// Returns the median support radius over the sample of FindSpacing. Needs at least one particle.
VTKACTIVEPARTICLES_EXPORT double FindMedianRadius(const ParticleFrame& frame);

}

#endif
