// Frames of particles that ranks share: each rank reads its piece of the input, then particles go
// to the ranks where they are at home (ParticleHomes.h).

#ifndef SharedFrame_h
#define SharedFrame_h

#include "Agreement.h"
#include "Targets/ParticleFrame.h"

namespace activesurface
{

// As ReadParticles, of the piece of the input that each rank has. All particles are numbered in
// their order (ParticleOrder.h). Rounds of ranks.
ParticleFrame ReadSharedParticles(vtkPointSet* points, const PointArrays& arrays, Agreement& ranks);

// The particles go where they are at home, and what is known of all of them together is found.
// Comes when they have their radii, and again when these change. Rounds of ranks.
void BringHome(double ballPerRadius, ParticleFrame& frame);

// A frame that is not shared, of all particles of one that is. Rounds of ranks.
ParticleFrame GatherFrame(const ParticleFrame& frame);

}

#endif
