/**
 * The state of a surface at a time step as a grid for files, to go on from.
 */
#ifndef SavedGrid_h
#define SavedGrid_h

#include "NarrowBand.h"
#include "vtkActiveVDBModule.h"

#include <memory>
#include <string>

namespace activesurface
{

struct SavedBand
{
  std::shared_ptr<const NarrowBand> Band;
  double Time = 0.0;   //< pipeline time, of a step
  std::string History; //< up to it, in the words of whoever keeps it
};

/** Name of the grid. */
constexpr const char* SavedGridName = "potential";

/** NarrowBand::ToGrid, with the rest as metadata. */
VTKACTIVEVDB_EXPORT openvdb::FloatGrid::Ptr MakeSavedGrid(const SavedBand& state);

/** Throws std::runtime_error for a grid that is none of those. */
VTKACTIVEVDB_EXPORT SavedBand ReadSavedGrid(const openvdb::FloatGrid& grid);

}

#endif
