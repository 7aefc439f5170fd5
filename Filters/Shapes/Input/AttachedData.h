/**
 * Attaches to a data object the grid, or the state of a surface, from which the data were made, for
 * filters that can use the attachment directly. The attachment is an entry of the data object's
 * information, which other filters do not copy. Data that another filter has changed therefore have
 * no attachment.
 */
#ifndef AttachedData_h
#define AttachedData_h

#include "SavedState.h"
#include "vtkActiveShapesModule.h"

#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkInformation;

namespace activesurface
{

/** State attached to the outputs of a vtkActiveImplicitSurface. */
struct AttachedState
{
  SavedState State; //< at the time of the output, which may lie between time steps
  /** The skin of the output; in a periodic box, a part of the state's skin. */
  std::shared_ptr<const NarrowBand> Skin;
  bool IsAtStep = false; //< true if the motion can resume from the state
  int Step = 0;          //< index of the time step, or of the previous one
  /** Point arrays of Skin on rank 0 if the output is only a part of Skin; otherwise null. */
  vtkSmartPointer<vtkPointData> WholeArrays;
  std::vector<std::pair<std::string, double>> Motion; //< properties that determine the motion
  /** Set if Skin is only one rank's part of the skin. Gather() returns the state of the whole skin
   * on rank 0, null on other ranks. Collective. */
  std::function<std::shared_ptr<const AttachedState>()> Gather;
};

///@{
/** A null state removes the attachment. AttachedGrid.h attaches grids. */
VTKACTIVESHAPES_EXPORT void Attach(
  vtkInformation* information, const std::shared_ptr<const AttachedState>& state);
/** Returns null if none is attached. */
VTKACTIVESHAPES_EXPORT std::shared_ptr<const AttachedState> GetAttachedState(
  vtkInformation* information);
///@}

VTKACTIVESHAPES_EXPORT bool HasAttachedGrid(vtkInformation* information);
/** Removes the grid of `to` if `from` has no grid. */
VTKACTIVESHAPES_EXPORT void CopyAttachedGrid(vtkInformation* from, vtkInformation* to);
/** Replaces an attached grid, if any, by a translated copy that shares the grid's values. */
VTKACTIVESHAPES_EXPORT void MoveAttachedGrid(vtkInformation* information, const double offset[3]);

}

#endif
