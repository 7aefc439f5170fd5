// Packs particles of a frame into bytes, without rounding, for messages between ranks.

#ifndef ParticleBytes_h
#define ParticleBytes_h

#include "Frames/ParticleFrame.h"
#include "Ranks/Communicator.h"

#include "vtkActiveParticlesModule.h"

#include <cstdint>
#include <vector>

namespace activesurface
{

using ParticleChoice = std::vector<std::uint32_t>; // indices of particles in a frame

// Packs the positions, ids, strengths (unless all are 1) and velocities (if HasVelocities) of the
// chosen particles as bytes. Radii and passed arrays are omitted. Empty if no particle is chosen.
VTKACTIVEPARTICLES_EXPORT Bytes PackParticles(
  const ParticleFrame& frame, const ParticleChoice& chosen);

// Merges the particles of several ranks into one frame, in the order that ParticleOrder.h defines.
// like: frame that provides HasIds, HasVelocities and the common radius.
VTKACTIVEPARTICLES_EXPORT ParticleFrame MergeParticles(
  const std::vector<Bytes>& parts, const ParticleFrame& like);

}

#endif
