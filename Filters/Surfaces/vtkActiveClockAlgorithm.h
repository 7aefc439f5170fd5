/**
 * @class   vtkActiveClockAlgorithm
 * @brief   time steps, end of motion and limits of a vtkActiveImplicitSurface, as properties
 *
 * Changing a property restarts the motion, except those of checkpoints, memory limits and threads.
 */

#ifndef vtkActiveClockAlgorithm_h
#define vtkActiveClockAlgorithm_h

#include "vtkActiveSurfacesModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

class VTKACTIVESURFACES_EXPORT vtkActiveClockAlgorithm : public vtkImageAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkActiveClockAlgorithm, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * First time step [pipeline time], published where the input has no time steps, or one; equal
   * neighbours among its steps count as one. Range: finite. Default: 0.
   */
  vtkSetMacro(StartTime, double);
  vtkGetMacro(StartTime, double);
  ///@}

  ///@{
  /**
   * Interval of the time steps [pipeline time] that are published where the input has none.
   * Range: > 0. Default: 0.1.
   */
  vtkSetMacro(TimeStepSize, double);
  vtkGetMacro(TimeStepSize, double);
  ///@}

  ///@{
  /**
   * Number of time steps that are published where the input has none. Changing it restarts the
   * motion. Range: 1 to 1000000. Default: 11.
   */
  vtkSetClampMacro(NumberOfTimeSteps, int, 1, 1000000);
  vtkGetMacro(NumberOfTimeSteps, int);
  ///@}

  ///@{
  /**
   * Motion time per pipeline time [time/pipeline time]; Attraction and Tension are rates of motion
   * time. An input with the steps 0, 1, 2 ... at 25 per second has TimeScale 1/25. Range: > 0.
   * Default: 1.
   */
  vtkSetMacro(TimeScale, double);
  vtkGetMacro(TimeScale, double);
  ///@}

  ///@{
  /**
   * Time at which the skin coincides with a static target [pipeline time after the first time
   * step], to 0.1 voxel where the target is a distance nearby. Each part moves at constant speed;
   * thin limbs grow along their length. Parts of only one of the two shapes grow from a core (with
   * CreateParts) or shrink. Attraction keeps the skin on the target after that time. Ignored with
   * EvolutionMode EQUILIBRIUM; needs NormalizeTarget. Range: >= 0; 0: by Attraction, the skin comes
   * near for ever. Default: 0.
   */
  vtkSetClampMacro(ArrivalTime, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ArrivalTime, double);
  ///@}

  enum EvolutionModeType
  {
    TRANSIENT = 0,
    EQUILIBRIUM = 1
  };

  ///@{
  /**
   * Motion through the time steps, or to a steady state. TRANSIENT (0): the skin follows the time
   * steps. EQUILIBRIUM (1): there are no time steps; each update moves the skin to a steady state
   * on the target of the first time step. The motion ends by RestTolerance or
   * MaximumNumberOfSubsteps. The history records which of them ended it, and a warning reports the
   * latter.
   * Default: TRANSIENT.
   */
  vtkSetClampMacro(EvolutionMode, int, TRANSIENT, EQUILIBRIUM);
  vtkGetMacro(EvolutionMode, int);
  void SetEvolutionModeToTransient() { this->SetEvolutionMode(TRANSIENT); }
  void SetEvolutionModeToEquilibrium() { this->SetEvolutionMode(EQUILIBRIUM); }
  ///@}

  ///@{
  /**
   * Largest normal speed [voxels/time] of a steady skin, with EvolutionMode EQUILIBRIUM. Unless it
   * is 0, the motion also ends if only an oscillation remains; a warning reports oscillation of
   * more than 5 % of the skin. Values below 1e-7 are below rounding. Range: >= 0. Default: 0.001.
   */
  vtkSetClampMacro(RestTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RestTolerance, double);
  ///@}

  ///@{
  /**
   * Maximum number of substeps of an update, with EvolutionMode EQUILIBRIUM.
   * Range: >= 0. Default: 10000.
   */
  vtkSetClampMacro(MaximumNumberOfSubsteps, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfSubsteps, int);
  ///@}

  ///@{
  /**
   * Interval of stored states, in time steps. A request for an earlier time recomputes at most this
   * number of steps, unless CheckpointMemory removes states. 0 stores none: the motion starts over.
   * Does not restart the motion. Range: >= 0. Default: 1.
   */
  vtkSetClampMacro(CheckpointInterval, int, 0, VTK_INT_MAX);
  vtkGetMacro(CheckpointInterval, int);
  ///@}

  ///@{
  /**
   * Memory [MiB] for stored states: 5 to 8 bytes per active voxel each. When it is full, the states
   * whose removal leaves the smallest gaps are removed. Does not restart the motion. Range: >= 0.
   * Default: 256.
   */
  vtkSetClampMacro(CheckpointMemory, int, 0, VTK_INT_MAX);
  vtkGetMacro(CheckpointMemory, int);
  ///@}

  ///@{
  /**
   * Memory limit: a band of more active voxels is an error. A ball of diameter d has about 20 * (d
   * / VoxelSize)^2 active voxels. Distances to a mesh that need ten times as many voxels are an
   * error, too. Does not restart the motion.
   * Range: >= 1. Default: 50000000.
   */
  vtkSetClampMacro(MaximumNumberOfActiveVoxels, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfActiveVoxels, vtkIdType);
  ///@}

  ///@{
  /**
   * Number of threads that move the skin. It does not change the result.
   * Range: 0 to 1024; 0 is all that TBB may use. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

protected:
  vtkActiveClockAlgorithm() = default;
  ~vtkActiveClockAlgorithm() override = default;

private:
  vtkActiveClockAlgorithm(const vtkActiveClockAlgorithm&) = delete;
  void operator=(const vtkActiveClockAlgorithm&) = delete;

  double StartTime = 0.0;
  double TimeStepSize = 0.1;
  int NumberOfTimeSteps = 11;
  double TimeScale = 1.0;
  double ArrivalTime = 0.0;
  int EvolutionMode = TRANSIENT;
  double RestTolerance = 1e-3;
  int MaximumNumberOfSubsteps = 10000;
  int CheckpointInterval = 1;
  int CheckpointMemory = 256;
  vtkIdType MaximumNumberOfActiveVoxels = 50000000;
  int NumberOfThreads = 0;
};

#endif
