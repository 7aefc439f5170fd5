/**
 * What is attached to a data object besides its points: the grid that it was made from, for those
 * who can use it without a detour through the points. It is attached to the data object's
 * information, which other filters do not copy: nothing is attached to what they have changed.
 */
#ifndef AttachedData_h
#define AttachedData_h

#include "SavedState.h"
#include "vtkActivePotentialsModule.h"

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
  SavedState State; //< at the time of the output, which need not be a step's
  /** The skin of the output; in a periodic box a part of the state's. */
  std::shared_ptr<const NarrowBand> Skin;
  bool IsAtStep = false; //< whether the motion can go on from it
  int Step = 0;          //< number of the time step, or of the one before
  /** Of all of the skin, where the output is one rank's part of it, on rank 0; else null. */
  vtkSmartPointer<vtkPointData> WholeArrays;
  std::vector<std::pair<std::string, double>> Motion; //< properties that shape the motion
};

///@{
/** Null: nothing any more. AttachedGrid.h attaches grids. */
VTKACTIVEPOTENTIALS_EXPORT void Attach(
  vtkInformation* information, const std::shared_ptr<const AttachedState>& state);
/** Null if none is attached. */
VTKACTIVEPOTENTIALS_EXPORT std::shared_ptr<const AttachedState> GetAttachedState(
  vtkInformation* information);
///@}

VTKACTIVEPOTENTIALS_EXPORT bool HasAttachedGrid(vtkInformation* information);
/** None if the first one has none. */
VTKACTIVEPOTENTIALS_EXPORT void CopyAttachedGrid(vtkInformation* from, vtkInformation* to);
/** Replaces the grid, if there is one, by one at other positions; its values are shared. */
VTKACTIVEPOTENTIALS_EXPORT void MoveAttachedGrid(
  vtkInformation* information, const double offset[3]);

}

#endif
