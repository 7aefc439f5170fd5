/**
 * Restores area or volume after each substep by a uniform displacement along the normal. This is a
 * projection, without stiffness or offset. (With an averaged speed in the equation of motion
 * instead, area or volume drifts by 7 %.)
 */
#ifndef ExactControl_h
#define ExactControl_h

#include "Base/Motion.h"
#include "Leaves/ActiveSet.h"

#include <functional>

namespace activesurface
{

struct SubstepBuffers;

/** The controlled band; lengths in voxels. */
struct ControlledBand
{
  LeafTable& Leaves;
  ActiveSet& Set; //< capacity for all leaves, because each displacement moves all
  SubstepBuffers& Buffers;
  std::function<void(ActiveSet&)> Rebuild; //< rebuilds layers and ghosts from the potential
  const Walls& Box;
  Obstacle* Solid; //< may be null
  double VoxelSize;
  int Rounds = 1; //< of up to 1.5 voxels each, for long substeps
};

/** Moves the surface until the volume is restored to 1e-9, at most 1.5 voxels per iteration. */
void RestoreVolume(const ControlledBand& band, double volume);

/** Restores the area by the secant method: the gain of area per displacement may have either
 * sign. */
void RestoreArea(const ControlledBand& band, double area);

}

#endif
