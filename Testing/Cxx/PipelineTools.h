/**
 * What the pipeline's tests are written with: an input that moves and counts, and an ear for
 * messages.
 */
#ifndef PipelineTools_h
#define PipelineTools_h

#include "vtkActiveImplicitSurface.h"

#include "vtkNew.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkInformation;
class vtkInformationVector;

namespace activesurface
{

struct Particle
{
  double X, Y, Z;
  int Id;
};

/** Particles that are a function of time, with the point array "id". */
class ParticleSource : public vtkPolyDataAlgorithm
{
public:
  static ParticleSource* New();
  vtkTypeMacro(ParticleSource, vtkPolyDataAlgorithm);

  using Cloud = std::function<std::vector<Particle>(double time)>;
  void SetCloud(const Cloud& cloud);
  /** Published; none: only TIME_RANGE 0..10 if continuous, else no time at all. */
  void SetSteps(const std::vector<double>& steps);
  void SetContinuous(bool continuous);
  /** RequestData fails from that execution on, counted from 0. */
  void SetFailingExecution(int execution) { this->FailingExecution = execution; }
  /** It modifies itself when it executes, as it should not. */
  void SetRestless(bool restless) { this->Restless = restless; }

  /** The times it was executed for, in order. */
  std::vector<double> Executions;
  std::string GetExecutions() const;

protected:
  ParticleSource();
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override;

private:
  Cloud Particles;
  std::vector<double> Steps;
  bool Continuous = false;
  int FailingExecution = -1;
  bool Restless = false;
};

/** All that the filter, and its executive, say from now on. */
class Messages
{
public:
  explicit Messages(vtkActiveImplicitSurface* filter);

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;

  /** Of the warnings, or errors, how many contain the words; prints all if not just one does. */
  static int Count(const std::vector<std::string>& messages, const std::string& words);
};

/** Adds one for each execution of an algorithm from now on. */
void CountExecutions(vtkAlgorithm* algorithm, int& executions);

/** The points, triangles and normals of the skin, byte by byte. */
std::string GetBytes(vtkActiveImplicitSurface* filter);

/** GetBytes after an update for that time. */
std::string GetBytesAt(vtkActiveImplicitSurface* filter, double time);

/** Box of the skin; empty skins have x min > x max. */
std::array<double, 6> GetSkinBounds(vtkActiveImplicitSurface* filter);

/** A ball of radius .6 that goes towards one of radius .4, in 11 steps of .1. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeShrinkingBall();

/** A skin over particles of radius .3, with voxels of .05 in the box +-1 and an Attraction of 10.
 */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(ParticleSource* source);

/** One ball that goes along x from 0, .2 for each unit of time. */
std::vector<Particle> MovingBall(double time);

/** The moving ball at the time steps 0 to 4. */
vtkSmartPointer<ParticleSource> MakeMovingBall();

}

#endif
