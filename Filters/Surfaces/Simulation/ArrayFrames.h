// Which frames of the target tell the arrays of the skin at the requested time.

#ifndef ArrayFrames_h
#define ArrayFrames_h

#include "Simulation/SurfaceSettings.h"
#include "Targets/InputData.h"
#include "Targets/TargetFrames.h"

namespace activesurface
{

// What the skin shall have besides its shape.
struct RequestedArrays
{
  bool Speeds = false;
  bool Passed = false;             // those of the particles
  bool TangentialVelocity = false; // of the particles
  ParticleArrays Kept;             // of the particles, when their frames are read

  bool NeedParticles() const { return this->Passed || this->TangentialVelocity; }
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
