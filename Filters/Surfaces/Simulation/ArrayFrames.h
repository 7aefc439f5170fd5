// Which frames of the target tell the arrays of the skin at the requested time.

#ifndef ArrayFrames_h
#define ArrayFrames_h

#include "Simulation/SurfaceSettings.h"
#include "Targets/TargetFrames.h"

#include <string>

namespace activesurface
{

// What the skin shall have besides its shape.
struct RequestedArrays
{
  bool Speeds = false;
  bool ParticleArrays = false;
  bool TangentialVelocity = false; // of the particles
  std::string Description;         // with which their frames are to be read for that

  bool NeedParticles() const { return this->ParticleArrays || this->TangentialVelocity; }
};

// A moment between two frames: at Fraction of the way from the step First to the next one.
struct ArrayFrames
{
  int First = 0;
  int Last = 0; // the last frame that has to be there: First, or the next one
  double Fraction = 0.0;
  double Duration = 0.0; // motion time from First to the next step; 0 if there is none
};

ArrayFrames FindArrayFrames(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetFrames& frames);

// Whether the frame of a step is there, and was read with all that the arrays need of particles.
bool HasArrays(const TargetFrames& frames, int step, const RequestedArrays& arrays);

}

#endif
