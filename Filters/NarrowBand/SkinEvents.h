/**
 * Topological events: what has happened to the parts of a skin between two moments.
 */
#ifndef SkinEvents_h
#define SkinEvents_h

#include "SkinParts.h"

#include <string>

namespace activesurface
{

/**
 * Those of "merge", "split", "vanish", "birth", "void opens", "void closes", "hole opens", "hole
 * closes" that have happened, in this order, separated by ", "; empty if none.
 *
 * Parts of two moments count as the same body if they touch neighbouring blocks: a part must move
 * less than 4 voxels in between. If several bodies are that near each other and one is missing
 * afterwards, it has merged if the others have grown by at least half of its volume; otherwise it
 * has vanished. Opposite events among such neighbours cancel and are not reported.
 */
ACTIVENARROWBAND_EXPORT std::string FindEvents(
  const std::vector<SkinPart>& before, const std::vector<SkinPart>& after);

}

#endif
