/**
 * What has happened to the parts of a skin from one moment to another.
 */
#ifndef SkinEvents_h
#define SkinEvents_h

#include "SkinParts.h"

#include <string>

namespace activesurface
{

/**
 * "merge", "split", "vanish", "birth", "void opens", "void closes", "hole opens", "hole closes":
 * those that have happened, in this order, separated by ", "; empty if none.
 *
 * Parts of two moments are taken for the same body where they touch blocks that are neighbours:
 * they have to move less than 4 voxels in between. Where several bodies are so near each other, one
 * that is missing afterwards has merged if the others have grown by half of its volume at least,
 * else it has vanished. Events that undo each other among such neighbours are not seen.
 */
VTKACTIVENARROWBAND_EXPORT std::string FindEvents(
  const std::vector<SkinPart>& before, const std::vector<SkinPart>& after);

}

#endif
