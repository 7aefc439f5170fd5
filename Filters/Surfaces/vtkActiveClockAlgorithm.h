/**
 * @class   vtkActiveClockAlgorithm
 * @brief   the clock of a vtkActiveImplicitSurface, when its motion ends, and its limits, as
 * properties
 *
 * Changing any of these properties starts the skin anew, but those of the clock's checkpoints and
 * of what may be used of the machine.
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
   * First time step [pipeline time] that is published where the input has no time steps, or
   * one; equal neighbours among them count as one. Range: finite. Default: 0.
   */
  vtkSetMacro(StartTime, double);
  vtkGetMacro(StartTime, double);
  ///@}

  ///@{
  /**
   * Distance of the time steps [pipeline time] that are published where the input has none.
   * Range: > 0. Default: 0.1.
   */
  vtkSetMacro(TimeStepSize, double);
  vtkGetMacro(TimeStepSize, double);
  ///@}

  ///@{
  /**
   * Number of time steps that are published where the input has none. Changing it starts the skin
   * anew. Range: 1 to 1000000. Default: 11.
   */
  vtkSetClampMacro(NumberOfTimeSteps, int, 1, 1000000);
  vtkGetMacro(NumberOfTimeSteps, int);
  ///@}

  ///@{
  /**
   * Motion time per pipeline time [time/pipeline time]; the motion's units of time are those of
   * Attraction and Tension. An input whose steps are numbered 0, 1, 2 ... at 25 per second has
   * TimeScale 1/25. Range: > 0. Default: 1.
   */
  vtkSetMacro(TimeScale, double);
  vtkGetMacro(TimeScale, double);
  ///@}

  ///@{
  /**
   * When the skin is the target, which has to stand still [pipeline time after the first time
   * step], whatever the way and the shape: within a tenth of a voxel where the target is a distance
   * nearby. Each part goes with an even speed, thin limbs grow along their length, parts that only
   * one of the two shapes has grow from a core (with CreateParts) or shrink. Attraction holds from
   * then on. Of no use with EvolutionMode EQUILIBRIUM; needs NormalizeTarget. Range: >= 0; 0: by
   * Attraction, the skin comes near for ever. Default: 0.
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
   * TRANSIENT (0): the skin follows the time steps. EQUILIBRIUM (1): there are none, each update
   * takes the skin to rest on the target as it is at its first time step, until RestTolerance or
   * MaximumNumberOfSubsteps ends it: a warning tells the latter, the history both.
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
   * is 0, the motion also ends if the rest of it is an oscillation; a warning says if that is more
   * than 5 % of the skin. Values below 1e-7 are below rounding. Range: >= 0. Default: 0.001.
   */
  vtkSetClampMacro(RestTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RestTolerance, double);
  ///@}

  ///@{
  /**
   * Substeps after which the way to rest ends in any case, with EvolutionMode EQUILIBRIUM.
   * Range: >= 0. Default: 10000.
   */
  vtkSetClampMacro(MaximumNumberOfSubsteps, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfSubsteps, int);
  ///@}

  ///@{
  /**
   * Distance, in time steps, of the states that are kept so that a request for an earlier time
   * costs no more steps than that; CheckpointMemory thins them. 0 keeps none: it starts over. Does
   * not restart the motion. Range: >= 0. Default: 1.
   */
  vtkSetClampMacro(CheckpointInterval, int, 0, VTK_INT_MAX);
  vtkGetMacro(CheckpointInterval, int);
  ///@}

  ///@{
  /**
   * Memory [MiB] for the states that are kept: 5 to 8 bytes per active voxel each. When it ends,
   * those go that leave the smallest gaps. Does not restart the motion. Range: >= 0. Default: 256.
   */
  vtkSetClampMacro(CheckpointMemory, int, 0, VTK_INT_MAX);
  vtkGetMacro(CheckpointMemory, int);
  ///@}

  ///@{
  /**
   * Guard of the memory: a band of more active voxels is an error instead. A ball of diameter d has
   * about 20 * (d / VoxelSize)^2 of them. So are distances to a mesh that take ten times as many.
   * Does not restart the motion.
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
