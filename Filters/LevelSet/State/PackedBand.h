/**
 * Lossless compact state of a surface: only data that cannot be recomputed.
 *
 * The state consists of the signs and the known nodes as bits, and the magnitudes of the potential
 * at known nodes. The layers are computed from the signs, bitwise identical. If there are ghosts,
 * the known nodes are the active nodes, and the ghosts are computed from the active nodes. Without
 * ghosts all nodes of the layers are known.
 */
#ifndef PackedBand_h
#define PackedBand_h

#include "Leaves/LeafTable.h"

#include <string>
#include <vector>

namespace activesurface
{

/**
 * Appends the leaves of this rank. Byte order and layout are those of the machine, so the bytes are
 * for this program's ranks, not for files.
 */
void PackBand(const LeafTable& table, bool hasGhosts, std::string& bytes);

/** Returns the tree with its known nodes, and + or - the background elsewhere. parts: bytes of each
 * rank. Throws std::runtime_error if sizes or counts in the bytes disagree, or if the tree is
 * damaged (see CheckTree). */
openvdb::FloatTree::Ptr UnpackBand(const std::vector<std::string>& parts, float background);

///@{
/** Pack and unpack a part of a band, including this rank's copies of other ranks' leaves, and the
 * sides of missing leaves. */
void PackPart(
  const LeafTable& table, bool hasGhosts, const openvdb::FloatTree& tree, std::string& bytes);
openvdb::FloatTree::Ptr UnpackPart(const std::string& bytes, float background);
///@}

}

#endif
