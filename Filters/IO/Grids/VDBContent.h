// Converts a data object to the grids that a vtkActiveVDBWriter writes.

#ifndef VDBContent_h
#define VDBContent_h

#include "Base/Automatic.h"
#include "Base/OpenVDB.h"
#include "Input/AttachedData.h"

#include <memory>

class vtkDataObject;

namespace activesurface
{

struct VDBChoice
{
  bool State = false;
  bool Density = false;
  bool Velocity = false;
  bool PointArrays = false;
  bool HalfFloat = false;
  openvdb::GridClass Kind = openvdb::GRID_UNKNOWN; // of an image's scalars
  double VoxelSize = Automatic;                    // of a mesh; automatic: longest side / 64
};

// Throws std::invalid_argument, with a message, for data that cannot become the chosen grids.
// attached: state that is attached to the data, or was gathered from all ranks; may be null.
openvdb::GridPtrVec MakeGrids(vtkDataObject* data,
  const std::shared_ptr<const AttachedState>& attached, const VDBChoice& choice);

}

#endif
