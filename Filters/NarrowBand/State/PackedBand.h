/**
 * The state of a surface in few bytes: what cannot be recomputed, without loss.
 *
 * Stored are the signs and the known nodes as bits, and the magnitudes of the potential there. The
 * layers follow from the signs, bitwise. Known are the active nodes, and ghosts follow from them;
 * without ghosts, all nodes of the layers.
 */
#ifndef PackedBand_h
#define PackedBand_h

#include "Leaves/LeafTable.h"

#include <string>

namespace activesurface
{

/** Bytes for this process: byte order and layout are those of the machine. */
std::string PackBand(const LeafTable& table, bool hasGhosts);

/** The tree with its known nodes, and + or - the background elsewhere. Throws std::runtime_error
 * for bytes that PackBand did not write. */
openvdb::FloatTree::Ptr UnpackBand(const std::string& bytes, float background);

}

#endif
