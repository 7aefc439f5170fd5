// The pipeline's requests to a vtkActiveImplicitSurface, answered by a SurfaceSimulation.
//
// A request for data may need several time steps of the input. The first of them is asked for as
// usual (AskInputs), the others by updates of the input from within (Make), not by VTK's
// CONTINUE_EXECUTING: in its loop the pipeline hangs for good if the input fails (VTK 9.1 to 9.6).

#ifndef SurfaceRequests_h
#define SurfaceRequests_h

#include "Pipeline/InputClock.h"
#include "Pipeline/SkinFunction.h"
#include "Pipeline/SurfaceInput.h"
#include "Simulation/SurfaceSimulation.h"

#include <string>
#include <vector>

class vtkActiveImplicitSurface;
class vtkDataObject;
class vtkGridPotential;
class vtkInformation;
class vtkInformationVector;
class vtkPolyData;

namespace activesurface
{

class SurfaceRequests
{
public:
  enum OutputPorts
  {
    SkinPort = 0,
    PotentialPort = 1,
    HistoryPort = 2
  };

  explicit SurfaceRequests(vtkActiveImplicitSurface* filter);

  SurfaceSimulation& GetSimulation() { return this->Simulation; }

  // Times and extent.
  void PublishInformation(vtkInformationVector** input, vtkInformationVector* output);

  // Of the output ports those that this request does not fill.
  void MarkNotMade(vtkInformation* request, vtkInformationVector* output) const;

  void AskInputs(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);

  // The outputs; throws what has to be said to the user.
  void Make(vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);

  // Leaves empty outputs that do not count as made.
  void GiveUp(vtkInformationVector* output);

  // Throw what has to be said to the user.
  void SaveState(const std::string& file) const;
  void LoadState(const std::string& file) { this->Simulation.SetState(ReadState(file)); }

  // Of the skin that was made last; the same object always.
  vtkGridPotential* GetSkinFunction() { return this->Function.Get(this->Simulation.FindSkin()); }

private:
  SurfaceSettings GatherSettings() const;
  const SurfaceDomain* FindDomain(vtkInformationVector** input, bool isWanted);
  double GetAskedTime(vtkInformation* output) const;
  void AskTarget(vtkInformation* target);
  void CheckInputs() const;
  void ReadFirst(vtkInformationVector** input);
  void AddFrame(int step, vtkInformation* target);
  void UpdateTarget(vtkInformation* target, double time);
  SurfaceSimulation::Outcome Advance(vtkInformationVector** input);

  class StampsAfterwards;
  bool Makes(int port, vtkInformation* request, vtkInformationVector* output) const;
  void Fill(int port, vtkInformation* image, vtkDataObject* data);
  void FillOutputs(vtkInformation* request, vtkInformationVector* output);

  vtkActiveImplicitSurface* Filter;
  SurfaceInput Target;
  SurfaceInput Initial;
  SurfaceSimulation Simulation;
  SkinFunction Function;
  InputClock Clock;

  // Of the last inputs that were composite data sets.
  std::uint64_t CompositeTarget = 0;
  std::uint64_t CompositeInitial = 0;
  int AskedStep = 0;        // of the target, as usual
  bool AskedInVain = false; // the last request to the target did not come back
};

}

#endif
