/**
 * Detects a steady state up to residual oscillation: noise below the voxel size never settles. Each
 * window of substeps is as long as all windows before it; its measure is the displacement of the
 * surface since its begin.
 */
#ifndef SteadyWindow_h
#define SteadyWindow_h

#include "Motion.h"
#include "Substep/Displacement.h"

#include <cstddef>
#include <limits>

namespace activesurface
{

class SteadyWindow
{
public:
  /** After each substep. attraction: in the time of a window, exp(-8) of a distance to a target
   * has to remain at most; without attraction nothing says how long a window has to be. */
  void Observe(const LeafTable& table, double time, double attraction);

  /** Returns true if the rest of the motion is an oscillation: in the last window either a share
   * of FewMoving at most moved, and at least half of the share in the window before; or the mean
   * displacement was at most 0.25 voxel, and 0.5 to 1.25 of that in the two windows before. */
  bool IsSteady() const { return this->Steady; }

  /** The share that moved in the last window; not a number before the first one has ended. */
  double GetShare() const { return this->Share; }

  /** By how far the surface moved in it, on the average [voxels]. */
  double GetMean() const { return this->Mean; }

private:
  void Begin(const LeafTable& table, double time);

  Displacement Since;
  double BeganAt = 0.0;
  std::size_t Substeps = 0; //< observed
  std::size_t End = 0;      //< of the window [substeps]
  double Share = std::numeric_limits<double>::quiet_NaN();
  double Mean = std::numeric_limits<double>::quiet_NaN(); //< of the last window
  double MeanBefore = std::numeric_limits<double>::quiet_NaN();
  bool Steady = false;
};

}

#endif
