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
#include <vector>

namespace activesurface
{

/** Appends the leaves of this rank. Bytes for this process: byte order and layout are those of the
 * machine. */
void PackBand(const LeafTable& table, bool hasGhosts, std::string& bytes);

/** The tree with its known nodes, and + or - the background elsewhere. parts: of each rank. Throws
 * std::runtime_error for bytes that PackBand did not write. */
openvdb::FloatTree::Ptr UnpackBand(const std::vector<std::string>& parts, float background);

///@{
/** The same with the leaves of other ranks that this one has, and with the sides of leaves that are
 * missing. */
void PackPart(
  const LeafTable& table, bool hasGhosts, const openvdb::FloatTree& tree, std::string& bytes);
openvdb::FloatTree::Ptr UnpackPart(const std::string& bytes, float background);
///@}

}

#endif
