/**
 * Detects a steady state up to residual oscillation: noise below the voxel size never settles. Each
 * window of substeps is as long as all windows before it. It measures the displacement of the
 * surface since its beginning.
 */
#ifndef SteadyWindow_h
#define SteadyWindow_h

#include "Base/Motion.h"
#include "Front/Displacement.h"

#include <cstddef>
#include <limits>

namespace activesurface
{

class SteadyWindow
{
public:
  /** Called after each substep. attraction: during a window, the distance to a target has to
   * decay to exp(-8) or less. Without attraction the length of a window is undefined. */
  void Observe(const LeafTable& table, double time, double attraction);

  /** Returns true if the remaining motion is an oscillation, by one of two measures of the last
   * window. Either a fraction of at most FewMoving moved, at least half of the fraction in the
   * window before. Or the mean displacement was at most 0.25 voxel, and 0.5 to 1.25 of that in
   * the two windows before. */
  bool IsSteady() const { return this->Steady; }

  /** The fraction that moved in the last window; NaN before the end of the first window. */
  double GetShare() const { return this->Share; }

  /** The mean displacement of the surface in the last window [voxels]. */
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
