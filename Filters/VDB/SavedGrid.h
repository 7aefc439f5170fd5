/**
 * The state of a surface at a time step as a grid for files.
 */
#ifndef SavedGrid_h
#define SavedGrid_h

#include "ActiveVDBExport.h"
#include "OpenVDB.h"
#include "SavedState.h"

namespace activesurface
{

/** Name of the grid. */
constexpr const char* SavedGridName = "potential";

/** The band's grid (NarrowBandGrid.h) with the rest as metadata: a line for each row, numbers in
 * hexadecimal so that none is rounded. */
ACTIVEVDB_EXPORT openvdb::FloatGrid::Ptr MakeSavedGrid(const SavedState& state);

/** Throws std::runtime_error for a grid that is none of those. */
ACTIVEVDB_EXPORT SavedState ReadSavedGrid(const openvdb::FloatGrid& grid);

}

#endif
