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
 * Parts at the two times count as the same body if they touch neighbouring blocks, so a part must
 * move less than 4 voxels in between. If several bodies are that close to each other and one is
 * missing afterwards, it has merged if the others have grown by at least half of its volume;
 * otherwise it has vanished. A merge and a split among such neighbours cancel and are not reported.
 * A birth and a vanishing cancel anywhere, and so do openings and closings.
 */
ACTIVELEVELSET_EXPORT std::string FindEvents(
  const std::vector<SkinPart>& before, const std::vector<SkinPart>& after);

}

#endif
