/**
 * The state of a surface as a grid, for files.
 */
#ifndef StateGrid_h
#define StateGrid_h

#include "Base/OpenVDB.h"

namespace activesurface
{

/** The state without its potential. */
struct StateNumbers
{
  double VoxelSize = 1.0;
  double Time = 0.0;
  double StartArea = 0.0;
  double StartVolume = 0.0;
  double BoxSize = 1.0;
  bool Paper = false;
  bool HasGhosts = true;  //< false: the node scheme has set all nodes of the layers
  float Background = 0.f; //< not stored: it follows from Paper
};

/** Returns a copy of the potential with the numbers as metadata. The active nodes are active;
 * without ghosts, all nodes of the layers are. Inactive nodes have + or - the background. */
openvdb::FloatGrid::Ptr MakeStateGrid(
  const openvdb::FloatTree& potential, const StateNumbers& numbers);

/** Throws std::runtime_error if a number is missing, a value is not finite, or the tree is damaged
 * (SavedTree.h). */
StateNumbers ReadStateGrid(const openvdb::FloatGrid& grid);

}

#endif
