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
 * (PartBlock), so a part that moves less than 4 voxels stays the same body. Such blocks join the
 * bodies into groups. If a group has fewer bodies afterwards, its smallest bodies count as missing.
 * The missing bodies have merged if the other bodies have gained at least half of the missing
 * volume; otherwise the missing bodies have vanished. A merge and a split in one group cancel and
 * are not reported. Of births and vanishings in the whole skin, only the more frequent event is
 * reported, and none if their numbers are equal; likewise of openings and closings.
 */
ACTIVELEVELSET_EXPORT std::string FindEvents(
  const std::vector<SkinPart>& before, const std::vector<SkinPart>& after);

}

#endif
