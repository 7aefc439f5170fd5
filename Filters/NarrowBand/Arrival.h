/**
 * A metamorphosis that arrives on time: the surface reaches a target that stands still, everywhere
 * and from any start, at a given time.
 *
 * The speed of a part of the surface is the distance that it still has to go, over the time that is
 * left: V = -F / (end - t) where F is the distance to the target. In a part that is longer than
 * thick it is the distance along that part (Arrival/RemainingDistance.h), so that thin limbs grow
 * evenly too. It is made by attraction: its rate is constant along short pieces of the time, by the
 * end of each of which distances have fallen as they should.
 */
#ifndef Arrival_h
#define Arrival_h

#include "ActiveNarrowBandExport.h"
#include "Motion.h"
#include "Target.h"

#include <memory>
#include <vector>

namespace activesurface
{

class NarrowBand;
struct SkinForces;

/** Parts of the target that the surface does not reach get a small core each, its hollows likewise:
 * before the first advance. Those that the target does not tell of are looked for within the bounds
 * (xmin xmax ymin ymax zmin zmax), to a 64th of them. Returns how many there are. */
ACTIVENARROWBAND_EXPORT std::size_t CreateCores(
  NarrowBand& band, const Motion& motion, Target& target, const double bounds[6]);

class ACTIVENARROWBAND_EXPORT Arrival
{
public:
  /** The target is the caller's. What is left to go is found for the surface as it is now, within
   * the bounds; beyond them it is |F|. */
  Arrival(const NarrowBand& band, Target& target, const double bounds[6]);
  ~Arrival();

  /** As NarrowBand::Advance; `end` is when the surface arrives. Until then the Attraction of the
   * motion is not used, and no parts are created. */
  AdvanceReport Advance(NarrowBand& band, double time, double end, const Motion& motion,
    const ProgressFunction& progress = {}) const;

  /** As activesurface::FindSpeeds, before the end. */
  std::vector<float> FindSpeeds(const NarrowBand& band, double end, const SkinForces& forces) const;

private:
  Arrival(const Arrival&) = delete;
  void operator=(const Arrival&) = delete;

  struct Members;
  const std::unique_ptr<Members> State;
};

}

#endif
