// Attributes of the skin at the requested time, such as speeds. Reading attributes changes no
// state.

#ifndef SkinAttributes_h
#define SkinAttributes_h

#include "Simulation/PassedArrays.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"
#include "Targets/InputData.h"
#include "Targets/Warnings.h"

#include <vector>

namespace activesurface
{

class NarrowBand;
struct Motion;

// Requested arrays and attributes of the skin.
struct RequestedArrays
{
  bool Speeds = false;
  bool Passed = false;             // point arrays of the particles
  bool TangentialVelocity = false; // of the particles
  bool FastestParticle = false;    // speed of the fastest particle
  bool Potential = false;          // the output Potential, not an array
  ParticleArrays Kept;             // arrays of particles that are kept when frames are read

  bool NeedParticles() const { return this->Passed || this->TangentialVelocity; }
  // Returns true if an output needs the whole skin on each rank, so that a distributed skin has to
  // be gathered.
  bool NeedWhole() const { return this->Potential || this->Speeds || this->NeedParticles(); }
};

// A time between two frames, at a fraction of the interval from the step First to the next one.
struct ArrayFrames
{
  int First = 0;
  int Last = 0; // last frame needed: First, or the next one
  double Fraction = 0.0;
  double Duration = 0.0; // from First to the next step [motion time]; 0 without a next step
};

// Returns the frames at the requested time. If wantsInterval (for velocities), returns the frames
// of the interval before the requested step instead; at the first step, and at a time between
// steps, of the interval after the step. For a forward-only input, if the earlier frame is not
// stored with the arrays, returns only the frame at the requested step. A static target has only
// frame 0.
ArrayFrames FindArrayFrames(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetBuilder& target, bool wantsInterval);

// Returns true if the arrays depend on the displacement of particles or labels between two steps.
bool WantDisplacements(const RequestedArrays& arrays, const TargetBuilder& target);

// Returns true if the frame of a step is stored and was read with the needed particle arrays.
bool HasArrays(const TargetBuilder& target, int step, const RequestedArrays& arrays);

class SkinAttributes
{
public:
  // Keeps references to the arguments. The frames that FindArrayFrames returns have to be stored.
  SkinAttributes(const SurfaceSettings& settings, const TargetBuilder& shapes,
    const Warnings& messages, const RequestedTime& time, const RequestedArrays& arrays);

  // Returns the normal speeds [length / motion time] at the vertices of the skin, by the law of
  // motion; none for an empty skin.
  std::vector<float> FindSpeeds(const NarrowBand& band, const Motion& motion) const;

  // Returns the requested arrays of the particles. The result refers to the frames.
  PassedArrays FindPassedArrays() const;

  // Returns the largest speed [length / motion time] of the particles in the interval that
  // FindArrayFrames returns. The speed is (displacement + change of support radius) / duration, or
  // the passed velocity if that is larger. Returns 0 if no particle is matched between two stored
  // frames, if no particle moves, and for static targets and targets without particles.
  double FindFastestParticle(const PassedArrays& passed) const;

private:
  const SurfaceSettings& Settings;
  const TargetBuilder& Shapes;
  const Warnings& Messages;
  const RequestedTime& Time;
  const RequestedArrays& Arrays;
};

}

#endif
