/**
 * Area or volume restored after each substep by a uniform displacement along the normal. This is a
 * projection, without stiffness or offset. (An averaged speed in the equation of motion drifts by
 * 7 %.)
 */
#ifndef ExactControl_h
#define ExactControl_h

#include "Leaves/ActiveSet.h"
#include "Motion.h"

#include <functional>

namespace activesurface
{

struct SubstepBuffers;

/** The band that is controlled; lengths in voxels. */
struct ControlledBand
{
  LeafTable& Leaves;
  ActiveSet& Set; //< room for the leaves of each displacement: all of them
  SubstepBuffers& Buffers;
  std::function<void(ActiveSet&)> Rebuild; //< layers and ghosts, from the potential
  const Walls& Box;
  Obstacle* Solid; //< or null
  double VoxelSize;
  int Rounds = 1; //< of a voxel and a half, where a substep is as long as many
};

/** Moves the surface until the volume is restored to 1e-9, or by a voxel and a half each round. */
void RestoreVolume(const ControlledBand& band, double volume);

/** The same for the area, by the secant method: the gain of area per displacement may have either
 * sign. */
void RestoreArea(const ControlledBand& band, double area);

}

#endif
