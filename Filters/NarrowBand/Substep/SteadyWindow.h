/**
 * Whether a surface is at rest but for places that move to and fro, as noise that the lattice
 * cannot hold does without end. It is judged by how far what share of the surface has come in a
 * window of substeps; each window is as long as all before it.
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

  /** Whether what moves does not come to rest: no more than a twentieth moved in the last window,
   * and no less than half of that in the one before; or all moved by a quarter of a voxel at most
   * on the average, and by as much as in the two windows before, which are shorter. */
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
