/**
 * Adds parts and hollows of the target that the skin does not reach; see NewParts.h.
 */
#ifndef CreateParts_h
#define CreateParts_h

#include "Base/Motion.h"
#include "Base/Target.h"
#include "Leaves/ActiveSet.h"
#include "Leaves/BandBackup.h"

#include <cstddef>

namespace activesurface
{

/** A band with valid layers and ghosts. */
struct GrowingBand
{
  LeafTable& Leaves;
  ActiveSet& Set;
  PotentialTree& Tree;
  double VoxelSize;
  std::size_t MaximumNumberOfActiveVoxels;
  BandBackup& Backup; //< stores the band as a tree before a change
};

/**
 * Creates the target's new parts and hollows. Near a part, u at outside nodes becomes the potential
 * of the union with the part. Near a hollow, u at inside nodes becomes the potential of the
 * difference. Returns true if any part or hollow was created. The active set then consists of the
 * changed leaves, whose layers and ghosts the caller has to rebuild. Adds the numbers of created
 * parts and of evaluations to the report. Throws std::runtime_error, and changes nothing, if the
 * parts are too large for the maximum of active voxels.
 */
bool CreateParts(
  const GrowingBand& band, const Motion& motion, const Target& target, AdvanceReport& report);

}

#endif
