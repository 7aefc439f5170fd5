// Output ports of the filter: selects the ports that a request fills, and fills them.

#ifndef OutputPorts_h
#define OutputPorts_h

#include "Pipeline/SkinFunction.h"
#include "Pipeline/SurfaceProperties.h"

class vtkInformation;
class vtkInformationVector;

namespace activesurface
{

constexpr const char* NoMemoryForOutputs =
  "There is not enough memory for the input, the skin, or the image of the potential over "
  "ModelBounds; enlarge VoxelSize, shrink ModelBounds, lower CheckpointMemory, or turn "
  "OutputPotential off.";

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

  // Returns true if the request yields no data. On one process, this is a request for a piece of
  // the skin or of the history other than piece 0, because piece 0 is complete. With several ranks,
  // each request yields data.
  static bool IsForNothing(
    const OutputShare& share, vtkInformation* request, vtkInformationVector* output);

  // Marks the ports that the request leaves unfilled with DATA_NOT_GENERATED.
  static void MarkUnfilled(
    const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output);

  // Fills the ports. The simulation must be at the requested time.
  void Fill(const SurfaceProperties& properties, SurfaceSimulation& simulation,
    vtkInformation* request, vtkInformationVector* output);

  // Empties all outputs and the skin function, and marks the outputs with DATA_NOT_GENERATED.
  void Clear(vtkInformationVector* output);

  // Implicit function of the last skin; always returns the same object.
  vtkGridPotential* GetSkinFunction(const SurfaceSimulation& simulation)
  {
    return this->Function.Get(
      this->AreFilled ? simulation.FindSkinAt(this->Filled) : nullptr, simulation.GetOrigin());
  }

private:
  SkinFunction Function;
  // Time of the outputs; kept if a later request fails upstream.
  bool AreFilled = false;
  RequestedTime Filled;
};

}

#endif
