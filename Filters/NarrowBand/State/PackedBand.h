/**
 * The state of a surface in few bytes: what cannot be recomputed, without loss.
 *
 * Stored are the signs and the active nodes as bits, and the magnitudes of the potential at the
 * active nodes. The layers follow from the signs and the ghosts from the active nodes, bitwise. The
 * bytes are zipped, except the two lower bytes of the magnitudes, which are noise. The result is
 * less than 4 bytes per active voxel.
 */
#ifndef PackedBand_h
#define PackedBand_h

#include "Leaves/LeafTable.h"

#include <string>

namespace activesurface
{

/** Bytes for this process: byte order and layout are those of the machine. */
std::string PackBand(const LeafTable& table);

/** The tree with its active nodes, and + or - the background elsewhere. Throws std::runtime_error
 * for bytes that PackBand did not write. */
openvdb::FloatTree::Ptr UnpackBand(const std::string& bytes, float background);

}

#endif
