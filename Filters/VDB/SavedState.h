/**
 * The state of a surface at a time step as a grid for files, to go on from.
 */
#ifndef SavedState_h
#define SavedState_h

#include "HistoryRow.h"
#include "NarrowBand.h"
#include "vtkActiveVDBModule.h"

#include <memory>
#include <vector>

namespace activesurface
{

struct SavedState
{
  std::shared_ptr<const NarrowBand> Band;
  double Time = 0.0;               //< pipeline time, of a step
  std::vector<HistoryRow> History; //< up to it
  double Spacing = 0.0;            //< of particles, as it was estimated [length]; 0: it was not
};

/** Name of the grid. */
constexpr const char* SavedGridName = "potential";

/** NarrowBand::ToGrid, with the rest as metadata: a line for each row, numbers in hexadecimal so
 * that none is rounded. */
VTKACTIVEVDB_EXPORT openvdb::FloatGrid::Ptr MakeSavedGrid(const SavedState& state);

/** Throws std::runtime_error for a grid that is none of those. */
VTKACTIVEVDB_EXPORT SavedState ReadSavedGrid(const openvdb::FloatGrid& grid);

}

#endif
