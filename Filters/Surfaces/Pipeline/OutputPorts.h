// The filter's output ports: which of them a request fills, and with what.

#ifndef OutputPorts_h
#define OutputPorts_h

#include "Pipeline/SkinFunction.h"
#include "Pipeline/SurfaceProperties.h"

class vtkInformation;
class vtkInformationVector;

namespace activesurface
{

constexpr const char* NoMemoryForOutputs =
  "There is not enough memory for the skin, or for the potential's image, whose size is that of "
  "ModelBounds; enlarge VoxelSize or shrink ModelBounds.";

class OutputPorts
{
public:
  enum Ports
  {
    Skin = 0,
    Potential = 1,
    History = 2,
    NumberOfPorts = 3
  };

  // Whether the request is for nothing: another piece of the skin or of the history than the
  // first, which is all of it. Ranks that work together have something each.
  static bool IsForNothing(
    const OutputShare& share, vtkInformation* request, vtkInformationVector* output);

  // Marks the ports that this request leaves unfilled with DATA_NOT_GENERATED.
  static void MarkUnfilled(
    const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output);

  // From a simulation at the requested time.
  void Fill(const SurfaceProperties& properties, SurfaceSimulation& simulation,
    vtkInformation* request, vtkInformationVector* output);

  // Empties all of them, and the skin function; they do not count as made.
  void Clear(vtkInformationVector* output);

  // Of the skin that was made last; the same object always.
  vtkGridPotential* GetSkinFunction(const SurfaceSimulation& simulation)
  {
    return this->Function.Get(
      this->AreFilled ? simulation.FindSkinAt(this->Filled) : nullptr, simulation.GetOrigin());
  }

private:
  SkinFunction Function;
  // What the outputs hold, also after a request for something else has failed upstream.
  bool AreFilled = false;
  RequestedTime Filled;
};

}

#endif
