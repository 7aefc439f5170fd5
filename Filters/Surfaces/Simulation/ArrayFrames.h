// Which frames of the target tell the arrays of the skin at the requested time.

#ifndef ArrayFrames_h
#define ArrayFrames_h

#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"
#include "Targets/InputData.h"

namespace activesurface
{

// What the skin shall have besides its shape.
struct RequestedArrays
{
  bool Speeds = false;
  bool Passed = false;             // those of the particles
  bool TangentialVelocity = false; // of the particles
  bool FastestParticle = false;    // its speed, where there are particles
  bool Potential = false;          // besides the skin
  ParticleArrays Kept;             // of the particles, when their frames are read

  bool NeedParticles() const { return this->Passed || this->TangentialVelocity; }
  // Returns true if ranks that share out space need all of the skin, and of the particles.
  bool NeedWhole() const { return this->Potential || this->Speeds || this->NeedParticles(); }
};

// A moment between two frames: at Fraction of the way from the step First to the next one.
struct ArrayFrames
{
  int First = 0;
  int Last = 0; // the last frame that has to be there: First, or the next one
  double Fraction = 0.0;
  double Duration = 0.0; // motion time from First to the next step; 0 if there is none
};

// wantsWay: whether the way of particles to the requested time is wanted, or at the first step from
// there; else the particles there.
ArrayFrames FindArrayFrames(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetBuilder& target, bool wantsWay);

// Whether the arrays want the way of particles.
bool WantWay(const RequestedArrays& arrays, const TargetBuilder& target);

// Whether the frame of a step is there, and was read with all that the arrays need of particles.
bool HasArrays(const TargetBuilder& target, int step, const RequestedArrays& arrays);

}

#endif
