// Attributes of the skin at the requested time, such as speeds. Reading them changes no state.

#ifndef SkinAttributes_h
#define SkinAttributes_h

#include "Simulation/ArrayFrames.h"
#include "Simulation/PassedArrays.h"
#include "Simulation/TargetBuilder.h"
#include "Targets/Warnings.h"

#include <vector>

namespace activesurface
{

class NarrowBand;
struct Motion;

class SkinAttributes
{
public:
  // Keeps references to all. The frames that FindArrayFrames returns have to be stored.
  SkinAttributes(const SurfaceSettings& settings, const TargetBuilder& shapes,
    const Warnings& messages, const RequestedTime& time, const RequestedArrays& arrays);

  // Returns the normal speeds at the vertices of the skin, by the law of motion; none for an empty
  // skin.
  std::vector<float> FindSpeeds(const NarrowBand& band, const Motion& motion) const;

  // Returns the requested arrays of the particles. The result refers to the frames.
  PassedArrays FindPassedArrays() const;

  // Returns the largest speed of the particles in the interval up to the requested time (at the
  // first step, in the interval after it). The speed is (displacement + change of radius) /
  // duration, or the passed velocity if that is larger. Returns 0 if no particle is matched between
  // two stored frames, if no particle moves, and for targets without particles.
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
