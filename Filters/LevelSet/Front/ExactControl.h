/**
 * Restores area or volume after each substep, or frame of the node scheme, by a uniform
 * displacement along the normal. The displacement is a projection: unlike a penalty, it has no
 * stiffness, and leaves no deficit within the limits of RestoreVolume.
 */
#ifndef ExactControl_h
#define ExactControl_h

#include "Base/Motion.h"
#include "Leaves/ActiveSet.h"

#include <functional>

namespace activesurface
{

struct SubstepBuffers;

/** The controlled band; Box and VoxelSize are in world units. */
struct ControlledBand
{
  LeafTable& Leaves;
  ActiveSet& Set; //< overwritten: each displacement moves all leaves
  SubstepBuffers& Buffers;
  std::function<void(ActiveSet&)> Rebuild; //< rebuilds layers and ghosts from the potential
  const Walls& Box;
  Obstacle* Solid; //< may be null
  double VoxelSize;
  int Rounds = 1; //< factor of limits: 1 for explicit substeps, 8 for the node scheme
};

/** Moves the surface until the relative error of the volume [voxels^3] is at most 1e-9. Ends
 * earlier after 1.5 * Rounds voxels, after 8 * Rounds displacements, if displacements hardly change
 * the volume, or if the surface vanishes. */
void RestoreVolume(const ControlledBand& band, double volume);

/** Like RestoreVolume, for the area [voxels^2]. The gain of area per displacement may have either
 * sign. */
void RestoreArea(const ControlledBand& band, double area);

}

#endif
