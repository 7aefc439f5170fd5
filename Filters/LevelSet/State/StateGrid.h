/**
 * The state of a surface as a grid, for files.
 */
#ifndef StateGrid_h
#define StateGrid_h

#include "Base/OpenVDB.h"

namespace activesurface
{

/** Throws std::runtime_error if the surface crosses an edge from a leaf to a tile: the band would
 * grow along the whole tile. Also throws if a coordinate of a leaf's origin is beyond +-2^30. */
void CheckTree(const openvdb::FloatTree& tree);

/** Throws std::runtime_error: the saved state is damaged. */
[[noreturn]] void RefuseState();

/** The state without its potential. */
struct StateNumbers
{
  double VoxelSize = 1.0;
  double Time = 0.0;
  double StartArea = 0.0;
  double StartVolume = 0.0;
  double BoxSize = 1.0;
  bool Paper = false;
  bool HasGhosts = true;  //< false: layers 3 and 4 have values up to NodeLimit
  float Background = 0.f; //< not stored: it follows from Paper
};

/** Returns a copy of the potential with the numbers as metadata. The active nodes of the copy are
 * those of the potential, or all nodes of the layers if there are no ghosts. Inactive nodes have +
 * or - the background. */
openvdb::FloatGrid::Ptr MakeStateGrid(
  const openvdb::FloatTree& potential, const StateNumbers& numbers);

/** Throws std::runtime_error if a number is missing or not finite, an active value is not finite,
 * or the tree is damaged (see CheckTree). */
StateNumbers ReadStateGrid(const openvdb::FloatGrid& grid);

}

#endif
