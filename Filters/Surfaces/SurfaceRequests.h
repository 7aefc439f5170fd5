// The pipeline's requests to a vtkActiveImplicitSurface, answered by a SurfaceSimulation.
//
// A request for data may need several time steps of the input. The first of them is asked for as
// usual (AskInput), the others by updates of the input from within (Make), not by VTK's
// CONTINUE_EXECUTING: in its loop the pipeline hangs for good if the input fails (VTK 9.1 to 9.6).

#ifndef SurfaceRequests_h
#define SurfaceRequests_h

#include "SurfaceSimulation.h"
#include "TargetInput.h"

#include <vector>

class vtkActiveImplicitSurface;
class vtkInformation;
class vtkInformationVector;

namespace activesurface
{

class SurfaceRequests
{
public:
  enum OutputPorts
  {
    SkinPort = 0,
    PotentialPort = 1
  };

  explicit SurfaceRequests(vtkActiveImplicitSurface* filter);

  SurfaceSimulation& GetSimulation() { return this->Simulation; }

  // Times and extent.
  void PublishInformation(vtkInformation* input, vtkInformationVector* output);

  // Of the output ports those that this request does not fill.
  void MarkNotMade(vtkInformation* request, vtkInformationVector* output) const;

  void AskInput(vtkInformation* request, vtkInformation* input, vtkInformationVector* output);

  // The outputs; throws what has to be said to the user.
  void Make(vtkInformation* request, vtkInformation* input, vtkInformationVector* output);

  // Leaves empty outputs that do not count as made, and no state.
  void GiveUp(vtkInformationVector* output);

private:
  SurfaceSettings GatherSettings() const;
  void FindTimeSteps(vtkInformation* input);
  const SurfaceDomain* FindDomain(vtkInformation* input, bool isWanted);
  void PublishExtent(vtkInformation* output, const SurfaceDomain* domain) const;
  void CheckTarget() const;
  SurfaceSimulation::Outcome Advance(vtkInformation* input);
  bool Makes(int port, vtkInformation* request) const;
  void FillOutputs(vtkInformation* request, vtkInformationVector* output);

  vtkActiveImplicitSurface* Filter;
  TargetInput Input;
  SurfaceSimulation Simulation;
  std::vector<double> Steps; // as published
  bool InputMoves = false;

  std::uint64_t CompositeStamp = 0; // of the last input that was a composite data set
  int AskedStep = 0;                // of the input, as usual
};

}

#endif
