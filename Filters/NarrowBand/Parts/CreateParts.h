/**
 * Parts of the target that no skin reaches get a skin; see NewParts.h.
 */
#ifndef CreateParts_h
#define CreateParts_h

#include "Leaves/ActiveSet.h"
#include "Leaves/BandBackup.h"
#include "Motion.h"
#include "Target.h"

#include <cstddef>

namespace activesurface
{

/** A band, its layers and ghosts up to date. */
struct GrowingBand
{
  LeafTable& Leaves;
  ActiveSet& Set;
  PotentialTree& Tree;
  double VoxelSize;
  std::size_t MaximumNumberOfActiveVoxels;
  BandBackup& Backup; //< is to keep the band as a tree before it changes
};

/**
 * Creates the new parts and hollows that the target tells of: beside them u becomes the union's, or
 * the difference's, the smaller magnitude of the two. If there are any, the set is that of the
 * leaves that have changed, whose layers and ghosts are left to the caller. Adds to the report what
 * it has created and evaluated; true if it has created any. Throws
 * std::runtime_error and changes nothing if the band would exceed its maximum.
 */
bool CreateParts(
  const GrowingBand& band, const Motion& motion, const Target& target, AdvanceReport& report);

}

#endif
