// What the skin has at the requested time besides its shape. Asking for it changes nothing.

#ifndef SkinAttributes_h
#define SkinAttributes_h

#include "Simulation/ArrayFrames.h"
#include "Simulation/PassedArrays.h"
#include "Simulation/TargetBuilder.h"
#include "Simulation/Warnings.h"

#include <vector>

namespace activesurface
{

class NarrowBand;
struct Motion;

class SkinAttributes
{
public:
  // All are the caller's; the frames that FindArrayFrames names have to be there.
  SkinAttributes(const SurfaceSettings& settings, const TargetBuilder& shapes,
    const Warnings& messages, const RequestedTime& time, const RequestedArrays& arrays);

  // Normal speeds at the vertices of the skin, by the law of motion; none for an empty skin.
  std::vector<float> FindSpeeds(const NarrowBand& band, const Motion& motion) const;

  // What the skin takes of particles, as requested; refers to the frames.
  PassedArrays FindPassedArrays() const;

  // The speed of the fastest particle on the way to the requested time (at the first step, from
  // there), of those that are at both of its ends, and of the passed velocities. 0 where none
  // moves, and for other targets.
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
