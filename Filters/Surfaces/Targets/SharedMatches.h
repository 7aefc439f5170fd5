// Which particles of two steps are the same, where ranks share both: see ParticleMatches.h.

#ifndef SharedMatches_h
#define SharedMatches_h

#include "Targets/ParticleMatches.h"

namespace activesurface
{

// As MatchParticles, of the particles that are at home here. For each id one of the ranks is told
// who has it, and tells both. Rounds of ranks.
ParticleMatches MatchSharedParticles(const ParticleFrame& earlier, const ParticleFrame& later);

}

#endif
