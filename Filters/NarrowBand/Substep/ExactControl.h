/**
 * Area or volume restored by one uniform displacement along the normal after each substep, as a
 * projection: no stiffness, no offset. (An averaged speed in the equation of motion drifts by 7 %.)
 */
#ifndef ExactControl_h
#define ExactControl_h

#include "Leaves/ActiveSet.h"
#include "Motion.h"

#include <functional>

namespace activesurface
{

struct SubstepBuffers;

/** What the control works on; lengths in voxels. */
struct ControlledBand
{
  LeafTable& Leaves;
  ActiveSet& Set; //< room for the leaves of each displacement: all of them
  SubstepBuffers& Buffers;
  std::function<void(ActiveSet&)> Rebuild; //< layers and ghosts, from the potential
  const Walls& Box;
  double VoxelSize;
};

/** Moves the surface outward until the volume is restored, or by a voxel and a half. */
void RestoreVolume(const ControlledBand& band, double volume);

/** The same for the area; what area gains per displacement is found from one step to the next, as
 * it may have either sign. */
void RestoreArea(const ControlledBand& band, double area);

}

#endif
