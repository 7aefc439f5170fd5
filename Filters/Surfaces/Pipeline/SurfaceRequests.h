// VTK's pipeline requests to a surface, answered by a SurfaceSimulation.
//
// A request for data may need several time steps of the input. The first of them is requested as
// usual (RequestInputs), the others by updates of the input from within (RequestData), not by VTK's
// CONTINUE_EXECUTING: in its loop the pipeline hangs for good if the input fails (VTK 9.1 to 9.6).

#ifndef SurfaceRequests_h
#define SurfaceRequests_h

#include "Agreement.h"
#include "Pipeline/InputClock.h"
#include "Pipeline/OutputPorts.h"
#include "Pipeline/PushedFrames.h"
#include "Pipeline/SurfaceInput.h"
#include "Pipeline/SurfaceProperties.h"
#include "Pipeline/TargetSteps.h"
#include "Pipeline/UpdateUnderWay.h"
#include "Pipeline/UserMessages.h"

#include <cstdint>
#include <string>

class vtkAlgorithm;
class vtkGridPotential;
class vtkInformation;
class vtkInformationVector;
class vtkMultiProcessController;

namespace activesurface
{

class SurfaceRequests
{
public:
  explicit SurfaceRequests(vtkAlgorithm* filter);

  // The ranks that make one skin together; null: this process alone. Starts anew.
  void SetController(vtkMultiProcessController* controller);
  OutputShare GetShare() const { return { this->Ranks.GetRank(), this->Ranks.GetSize() }; }

  SurfaceSimulation& GetSimulation() { return this->Simulation; }
  UserMessages& GetMessages() { return this->Messages; }

  // Times and extent.
  void PublishInformation(const SurfaceProperties& properties, vtkInformationVector** input,
    vtkInformationVector* output);

  void RequestInputs(const SurfaceProperties& properties, vtkInformation* request,
    vtkInformationVector** input, vtkInformationVector* output);

  // Fills the outputs; throws std::exception whose message is shown to the user. All ranks take
  // part.
  void RequestData(const SurfaceProperties& properties, vtkInformation* request,
    vtkInformationVector** input, vtkInformationVector* output);

  // A frame, which the next update goes to. Throws as PushedFrames does.
  void Push(const SurfaceProperties& properties, vtkDataObject* data, double dt);
  // Whether an update has got to the newest frame.
  bool IsAtNewestFrame() const { return this->Simulation.FindSkin() != nullptr; }
  // After an update that has not: whether the frame was refused, and the one before is the newest
  // again.
  bool WithdrawFrame();
  // The next update, or the next frame, is a new start. Throws std::logic_error within an update.
  void Restart();

  // Leaves empty outputs that do not count as made.
  void ClearOutputs(vtkInformationVector* output) { this->Outputs.Clear(output); }

  // Throw std::exception whose message is shown to the user: LoadState also within an update. All
  // ranks take part: the first one writes, each one reads.
  void SaveState(const std::string& file);
  void LoadState(const std::string& file);

  // Of the skin that was made last; the same object always.
  vtkGridPotential* GetSkinFunction();

private:
  class MTimesAfterwards;

  SurfaceSettings FindSettings(const SurfaceProperties& properties) const;
  bool ReadClock(const SurfaceProperties& properties, vtkInformation* target);
  RequestedArrays FindArrays(const OutputProperties& properties, int port) const;
  const SurfaceDomain* FindDomain(
    const SurfaceProperties& properties, vtkInformationVector** input, bool isWanted);
  PipelineTime FindRequestedTime(vtkInformation* output) const;
  void CheckInputs() const;
  void ReadFirst(vtkInformationVector** input);
  void SettleSpacing(vtkInformation* target);
  bool Advance(vtkInformationVector** input);
  void WarnOfPieces(vtkInformation* target) const;
  void AgreeOnRequest(
    const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output);
  void FillOutputs(const SurfaceProperties& properties, vtkInformation* request,
    vtkInformationVector** input, vtkInformationVector* output);
  void PublishTimeOfNothing(const SurfaceProperties& properties, vtkInformation* request,
    vtkInformationVector* output) const;

  vtkAlgorithm* Filter;
  UserMessages Messages;
  Agreement Ranks;
  SurfaceInput Target;
  SurfaceInput Initial;
  PushedFrames Pushed;
  InputClock Clock;
  SurfaceSimulation Simulation;
  TargetSteps Steps;
  OutputPorts Outputs;

  UpdateUnderWay Update;

  // Of the last inputs that were composite data sets.
  std::uint64_t CompositeTarget = 0;
  std::uint64_t CompositeInitial = 0;
};

}

#endif
