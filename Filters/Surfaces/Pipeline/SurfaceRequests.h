// Answers VTK's pipeline requests by a SurfaceSimulation.
//
// A request for data may need several time steps of the input. One missing step is requested as
// usual (RequestInputs), further steps by updates of the input within RequestData. VTK's
// CONTINUE_EXECUTING is not used: its loop never ends if the input fails (VTK 9.1 to 9.6).

#ifndef SurfaceRequests_h
#define SurfaceRequests_h

#include "Pipeline/InputClock.h"
#include "Pipeline/OutputPorts.h"
#include "Pipeline/PushedFrames.h"
#include "Pipeline/SurfaceInput.h"
#include "Pipeline/SurfaceProperties.h"
#include "Pipeline/TargetSteps.h"
#include "Pipeline/UserMessages.h"
#include "Ranks/Agreement.h"

#include <cstdint>
#include <stdexcept>
#include <string>

class vtkAlgorithm;
class vtkGridPotential;
class vtkInformation;
class vtkInformationVector;
class vtkMultiProcessController;

namespace activesurface
{

// Records that an update is running. An update calls the observers of its progress and messages. An
// observer's calls must not remove data that the update uses.
class UpdateInProgress
{
public:
  class Scope
  {
  public:
    explicit Scope(UpdateInProgress& update)
      : Update(update)
      , Before(update.Is) // an observer may request information
    {
      this->Update.Is = true;
    }
    Scope(const Scope&) = delete;
    void operator=(const Scope&) = delete;
    ~Scope() { this->Update.Is = this->Before; }

  private:
    UpdateInProgress& Update;
    const bool Before;
  };

  // Throws std::logic_error during an update. call: name of the refused function.
  void Refuse(const std::string& call) const
  {
    if (this->Is)
    {
      throw std::logic_error(call +
        " was called by an observer or a source during an update; call it after the update "
        "(AbortExecute stops an update).");
    }
  }

private:
  bool Is = false;
};

class SurfaceRequests
{
public:
  explicit SurfaceRequests(vtkAlgorithm* filter);

  // Sets the ranks that make one skin together; null: only this process. Restarts the motion if
  // several ranks made the skin before, or make it from now on.
  void SetController(vtkMultiProcessController* controller);
  OutputShare GetShare() const { return { this->Ranks.GetRank(), this->Ranks.GetSize() }; }

  SurfaceSimulation& GetSimulation() { return this->Simulation; }
  UserMessages& GetMessages() { return this->Messages; }

  // Publishes times and extent.
  void PublishInformation(const SurfaceProperties& properties, vtkInformationVector** input,
    vtkInformationVector* output);

  void RequestInputs(const SurfaceProperties& properties, vtkInformation* request,
    vtkInformationVector** input, vtkInformationVector* output);

  // Fills the outputs. Throws std::exception with a message for the user. Collective.
  void RequestData(const SurfaceProperties& properties, vtkInformation* request,
    vtkInformationVector** input, vtkInformationVector* output);

  // Adds a frame, to which the next update advances. Throws like PushedFrames::Push and
  // SurfaceInput::Check, and std::logic_error within an update.
  void Push(const SurfaceProperties& properties, vtkDataObject* data, double dt);
  // Returns true if the last update reached the newest frame.
  bool IsAtNewestFrame() const { return this->Simulation.FindSkin() != nullptr; }
  // If the last update rejected the newest frame, removes this frame and returns true; the previous
  // frame is then the newest again. Returns false for a rejected first frame, which the next Push
  // replaces. Call this if IsAtNewestFrame returns false.
  bool WithdrawFrame();
  // Makes the next update, or the next frame, start a new motion. Throws std::logic_error within an
  // update.
  void Restart();

  // Empties the outputs and marks them as not generated.
  void ClearOutputs(vtkInformationVector* output) { this->Outputs.Clear(output); }

  // Write and read a file with the state. Throw std::exception with a message for the user.
  // LoadState also throws if an update is running. Collective: rank 0 writes, each rank reads.
  void SaveState(const std::string& file);
  void LoadState(const std::string& file);

  // Implicit function of the last skin; always returns the same object.
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

  UpdateInProgress Update;

  // Pipeline MTimes of the last inputs with levels (AMR), see CheckInputs.
  std::uint64_t CompositeTarget = 0;
  std::uint64_t CompositeInitial = 0;
};

}

#endif
