/**
 * Restores area or volume after each substep by a uniform displacement along the normal. This is a
 * projection, without stiffness or offset. An averaged speed in the equation of motion would let
 * area or volume drift by 7 %.
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
  ActiveSet& Set; //< with capacity for all leaves: each displacement moves all leaves
  SubstepBuffers& Buffers;
  std::function<void(ActiveSet&)> Rebuild; //< rebuilds layers and ghosts from the potential
  const Walls& Box;
  Obstacle* Solid; //< may be null
  double VoxelSize;
  int Rounds = 1; //< limits the displacement to 1.5 Rounds; above 1 for long substeps
};

/** Moves the surface until the relative error of the volume is at most 1e-9, by at most 1.5 Rounds
 * voxels in 8 Rounds displacements.
 */
void RestoreVolume(const ControlledBand& band, double volume);

/** Like RestoreVolume, for the area. The gain of area per displacement may have either sign. */
void RestoreArea(const ControlledBand& band, double area);

}

#endif
