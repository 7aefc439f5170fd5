/**
 * Converts the state of a surface at a time step to a grid for files, and back.
 */
#ifndef SavedGrid_h
#define SavedGrid_h

#include "ActiveFilesExport.h"
#include "Base/OpenVDB.h"
#include "SavedState.h"

namespace activesurface
{

/** Name of the grid. */
constexpr const char* SavedGridName = "potential";

/** Returns the band's grid (NarrowBandGrid.h) with the other values of the state as metadata. Each
 * row of the history is a line of text. Floating-point numbers in these lines are hexadecimal, so
 * that none is rounded. */
ACTIVEFILES_EXPORT openvdb::FloatGrid::Ptr MakeSavedGrid(const SavedState& state);

/** Throws for a grid that is no saved state, or a damaged one. */
ACTIVEFILES_EXPORT SavedState ReadSavedGrid(const openvdb::FloatGrid& grid);

}

#endif
