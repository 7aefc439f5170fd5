/**
 * The state of a surface as few bytes: what cannot be recomputed, without loss.
 *
 * Stored are the signs and the active nodes as bits, and the magnitudes of the potential at the
 * active nodes. Layers follow from the signs, ghosts from the active nodes, to the bit. Compressed
 * (zip; of the magnitudes only the two upper bytes, as the lower ones are noise) that is less than
 * 4 bytes per active voxel.
 */
#ifndef PackedBand_h
#define PackedBand_h

#include "Leaves/LeafTable.h"

#include <string>

namespace activesurface
{

/** Bytes for this process: their order and layout are the machine's own. */
std::string PackBand(const LeafTable& table);

/** The tree with its active nodes, and + or - the background elsewhere. Throws std::runtime_error
 * for bytes that PackBand has not made. */
openvdb::FloatTree::Ptr UnpackBand(const std::string& bytes, float background);

}

#endif
