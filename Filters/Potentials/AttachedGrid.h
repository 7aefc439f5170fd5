/**
 * The grid that a data object was made from, attached to it (see AttachedData.h).
 */
#ifndef AttachedGrid_h
#define AttachedGrid_h

#include "OpenVDB.h"
#include "vtkActivePotentialsModule.h"

class vtkInformation;

namespace activesurface
{

/** A distance [world units], negative inside; null: nothing any more. */
VTKACTIVEPOTENTIALS_EXPORT void Attach(
  vtkInformation* information, const openvdb::FloatGrid::ConstPtr& grid);
/** Null if none is attached. */
VTKACTIVEPOTENTIALS_EXPORT openvdb::FloatGrid::ConstPtr GetAttachedGrid(
  vtkInformation* information);

}

#endif
