/**
 * What ranks that advance a band together know of all of it; see LeafOwners.h.
 */
#ifndef WholeBand_h
#define WholeBand_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

/** Every rank gets the values and the layers of all leaves, unless it has them. */
void MakeValuesWhole(LeafTable& table);

/** Every rank gets all that the table knows, and has all leaves to itself from then on. Throws
 * RankError where that fails, as if the ranks' tables are not the same; all leaves are gone then.
 */
void LeaveRanks(LeafTable& table, PotentialTree& tree);

}

#endif
