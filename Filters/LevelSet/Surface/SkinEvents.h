/**
 * Topological events: changes of the parts of a skin between two times.
 */
#ifndef SkinEvents_h
#define SkinEvents_h

#include "Surface/SkinParts.h"

#include <string>

namespace activesurface
{

/**
 * Returns the events that have happened, in this order, separated by ", "; empty if none: "merge",
 * "split", "vanish", "birth", "void opens", "void closes", "hole opens", "hole closes".
 *
 * Parts at the two times count as the same body if they touch equal or neighbouring blocks
 * (PartBlock), so a part that moves less than 4 voxels stays the same body. A body that is missing
 * afterwards and had other bodies in neighbouring blocks has merged if these bodies have grown by
 * at least half of the missing body's volume; otherwise the body has vanished. A merge and a split
 * among neighbouring bodies cancel and are not reported. Of births and vanishings in the whole
 * skin, only the more frequent event is reported, and none if their numbers are equal; likewise of
 * openings and closings.
 */
ACTIVELEVELSET_EXPORT std::string FindEvents(
  const std::vector<SkinPart>& before, const std::vector<SkinPart>& after);

}

#endif
