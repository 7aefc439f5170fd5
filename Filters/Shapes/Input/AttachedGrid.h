/**
 * Attaches to a data object the grid from which the data were made (see AttachedData.h).
 */
#ifndef AttachedGrid_h
#define AttachedGrid_h

#include "Base/OpenVDB.h"
#include "vtkActiveShapesModule.h"

class vtkInformation;

namespace activesurface
{

/** Attaches a distance [world units], negative inside. A null grid removes the attachment. */
VTKACTIVESHAPES_EXPORT void Attach(
  vtkInformation* information, const openvdb::FloatGrid::ConstPtr& grid);
/** Returns null if none is attached. */
VTKACTIVESHAPES_EXPORT openvdb::FloatGrid::ConstPtr GetAttachedGrid(vtkInformation* information);

}

#endif
