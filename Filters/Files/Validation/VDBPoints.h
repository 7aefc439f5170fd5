/**
 * Validates the points in the leaves of a .vdb file without building the leaves; see VDBTree.h.
 */
#ifndef VDBPoints_h
#define VDBPoints_h

#include "Validation/VDBTree.h"

namespace activesurface
{

/** Reads from the end of the topology. Throws if the points are damaged. */
void ValidatePoints(ByteSource& source, const VDBTree& tree);

}

#endif
