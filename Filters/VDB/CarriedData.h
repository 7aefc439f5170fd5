/**
 * What a data object carries besides its points: the grid that it was made from, for those who can
 * use it without a detour through the points. It is in the data object's information, which other
 * filters do not copy: what they have changed carries nothing.
 */
#ifndef CarriedData_h
#define CarriedData_h

#include "SavedGrid.h"
#include "vtkActiveVDBModule.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkInformation;

namespace activesurface
{

/** Of the outputs of a vtkActiveImplicitSurface. */
struct CarriedState
{
  SavedBand State;       //< at the time of the output, which need not be a step's
  bool IsAtStep = false; //< whether the motion can go on from it
  int Step = 0;          //< number of the time step, or of the one before
  std::vector<std::pair<std::string, double>> Motion; //< properties that shape the motion
};

///@{
/** Null: no longer. */
VTKACTIVEVDB_EXPORT void Carry(
  vtkInformation* information, const std::shared_ptr<const CarriedState>& state);
VTKACTIVEVDB_EXPORT void Carry(
  vtkInformation* information, const openvdb::FloatGrid::ConstPtr& grid);
///@}

///@{
/** Null if it carries none. The grid is a distance [world units], negative inside. */
VTKACTIVEVDB_EXPORT std::shared_ptr<const CarriedState> GetCarriedState(
  vtkInformation* information);
VTKACTIVEVDB_EXPORT openvdb::FloatGrid::ConstPtr GetCarriedGrid(vtkInformation* information);
///@}

}

#endif
