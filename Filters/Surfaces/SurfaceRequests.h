// The pipeline's requests to a vtkActiveImplicitSurface, answered by a SurfaceSimulation.
//
// A request for data takes as many passes as time steps of the input are needed: in each pass the
// input is asked for one step (AskInput), and its particles are taken in (Make).

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

  // The outputs, or the wish to be called again; throws what has to be said to the user.
  void Make(vtkInformation* request, vtkInformation* input, vtkInformationVector* output);

  // Leaves empty outputs that do not count as made, and no state.
  void GiveUp(vtkInformation* request, vtkInformationVector* output);

private:
  SurfaceSettings GatherSettings() const;
  void FindTimeSteps(vtkInformation* input);
  const SurfaceDomain* FindDomain(vtkInformation* input, bool isWanted);
  void PublishExtent(vtkInformation* output, const SurfaceDomain* domain) const;
  void CheckTarget() const;
  void TakeInput(vtkInformation* input);
  bool Makes(int port, vtkInformation* request) const;
  void FillOutputs(vtkInformation* request, vtkInformationVector* output);

  vtkActiveImplicitSurface* Filter;
  TargetInput Input;
  SurfaceSimulation Simulation;
  std::vector<double> Steps; // as published
  bool InputMoves = false;

  // Between the passes of a request.
  bool Continuing = false;
  int AskedStep = 0;
  bool Answered = true; // by the input, since it was asked
  bool InputFailed = false;
};

}

#endif
