/**
 * A state as a grid, for files.
 */
#ifndef StateGrid_h
#define StateGrid_h

#include <openvdb/openvdb.h>

namespace activesurface
{

/** What a state is besides its potential. */
struct StateNumbers
{
  double VoxelSize = 1.0;
  double Time = 0.0;
  double StartArea = 0.0;
  double StartVolume = 0.0;
  double BoxSize = 1.0;
  bool Paper = false;
  float Background = 0.f; //< not stored: it follows from Paper
};

/** A copy of the potential, + or - the background where it is not active, with the numbers. */
openvdb::FloatGrid::Ptr MakeStateGrid(
  const openvdb::FloatTree& potential, const StateNumbers& numbers);

/** Throws std::runtime_error for a grid that has not all of them, or values that are not finite. */
StateNumbers ReadStateGrid(const openvdb::FloatGrid& grid);

}

#endif
