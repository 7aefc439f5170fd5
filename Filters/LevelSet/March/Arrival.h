/**
 * A metamorphosis that arrives on time: the whole surface reaches a static target at a given time.
 *
 * The speed at a point of the surface is the remaining distance over the remaining time: V = -F /
 * (end - t), where F is the distance to the target. In a part that is longer than thick, F is the
 * distance along the part (March/RemainingDistance.h), so that thin limbs grow evenly too. The
 * Attraction is constant in each of 24 intervals, and chosen so that the distances have fallen in
 * proportion to the remaining time at the end of each interval but the last.
 */
#ifndef Arrival_h
#define Arrival_h

#include "ActiveLevelSetExport.h"
#include "Base/Motion.h"
#include "Base/Target.h"

#include <memory>
#include <vector>

namespace activesurface
{

class NarrowBand;
struct SkinForces;

/**
 * Creates a small core for each part and each hollow of the target that the surface does not reach,
 * or meets only in a region too thin to grow from. Call before the first Advance. Returns the
 * number of created parts and hollows; 0 if too many nodes differ (DifferingNodes.h). Parts that
 * the target does not report are searched for on a lattice of at most 64 cells along an axis.
 * bounds: box of all searches (xmin xmax ymin ymax zmin zmax).
 */
ACTIVELEVELSET_EXPORT std::size_t CreateCores(
  NarrowBand& band, const Motion& motion, Target& target, const double bounds[6]);

class ACTIVELEVELSET_EXPORT Arrival
{
public:
  /** The caller owns the target. Remaining distances are computed for the current surface, within
   * the bounds; elsewhere, and if too many nodes differ (DifferingNodes.h), the distance is |F|. */
  Arrival(const NarrowBand& band, Target& target, const double bounds[6]);
  ~Arrival();

  /** Moves the band like NarrowBand::Advance, so that the surface arrives at the target at the time
   * `end`. Before `end` the Attraction of the motion is ignored and no parts are created; from
   * `end` on the motion acts as given. */
  AdvanceReport Advance(NarrowBand& band, double time, double end, const Motion& motion,
    const ProgressFunction& progress = {}) const;

  /** Like activesurface::FindSpeeds, for a band at a time before `end`. */
  std::vector<float> FindSpeeds(const NarrowBand& band, double end, const SkinForces& forces) const;

private:
  Arrival(const Arrival&) = delete;
  void operator=(const Arrival&) = delete;

  struct Members;
  const std::unique_ptr<Members> State;
};

}

#endif
