/**
 * What is attached to a data object besides its points: the grid that it was made from, for those
 * who can use it without a detour through the points. It is attached to the data object's
 * information, which other filters do not copy: nothing is attached to what they have changed.
 */
#ifndef AttachedData_h
#define AttachedData_h

#include "SavedState.h"
#include "vtkActiveVDBModule.h"

#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkInformation;

namespace activesurface
{

/** Of the outputs of a vtkActiveImplicitSurface. */
struct AttachedState
{
  SavedState State;      //< at the time of the output, which need not be a step's
  bool IsAtStep = false; //< whether the motion can go on from it
  int Step = 0;          //< number of the time step, or of the one before
  /** Of all of the skin, where the output is one rank's part of it, on rank 0; else null. */
  vtkSmartPointer<vtkPointData> WholeArrays;
  std::vector<std::pair<std::string, double>> Motion; //< properties that shape the motion
};

///@{
/** Null: nothing any more. */
VTKACTIVEVDB_EXPORT void Attach(
  vtkInformation* information, const std::shared_ptr<const AttachedState>& state);
VTKACTIVEVDB_EXPORT void Attach(
  vtkInformation* information, const openvdb::FloatGrid::ConstPtr& grid);
///@}

///@{
/** Null if none is attached. The grid is a distance [world units], negative inside. */
VTKACTIVEVDB_EXPORT std::shared_ptr<const AttachedState> GetAttachedState(
  vtkInformation* information);
VTKACTIVEVDB_EXPORT openvdb::FloatGrid::ConstPtr GetAttachedGrid(vtkInformation* information);
///@}

}

#endif
