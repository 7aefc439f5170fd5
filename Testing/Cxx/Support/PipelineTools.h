/**
 * What the pipeline's tests are written with: an input that moves and counts, and skins over it.
 */
#ifndef PipelineTools_h
#define PipelineTools_h

#include "Support/SameSkins.h"

#include "vtkActiveImplicitSurface.h"

#include "vtkImplicitFunction.h"
#include "vtkNew.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkDataObject;
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

/** Adds one for each execution of an algorithm from now on. */
void CountExecutions(vtkAlgorithm* algorithm, int& executions);

/** The points, triangles and normals of the skin, byte by byte; of an empty skin: none. */
std::string GetBytes(vtkActiveImplicitSurface* filter);

/** GetBytes after an update for that time. */
std::string GetBytesAt(vtkActiveImplicitSurface* filter, double time);

/** Box of the skin; empty skins have x min > x max. */
std::array<double, 6> GetSkinBounds(vtkActiveImplicitSurface* filter);

/** A ball of radius .6 that goes towards one of radius .4, in 11 steps of .1. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeShrinkingBall();

/** Particles of radius .3, voxels of .05 in the box +-1 and an Attraction of 10; without an input.
 */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkin();

/** The same over an input; its particles, if it has any, have no ids. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkAlgorithm* source);
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkDataObject* data);

/** With the ids of the particles. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(ParticleSource* source);

/** The squared distance to a centre on the x axis, minus that of a ball's surface. */
vtkSmartPointer<vtkImplicitFunction> MakeBallFunction(double radius, double x = 0.0);

/** Least and largest distance of the skin's points from a centre on the x axis. */
struct Radii
{
  double Least;
  double Largest;
};
Radii GetRadii(vtkActiveImplicitSurface* filter, double x = 0.0);

/** Checks that the skin is a ball around the origin, as far as the tolerance. */
void CheckBall(
  vtkActiveImplicitSurface* filter, double radius, double tolerance, const std::string& name);

/** One ball that goes along x from 0, .2 for each unit of time. */
std::vector<Particle> MovingBall(double time);

/** The moving ball at the time steps 0 to 4. */
vtkSmartPointer<ParticleSource> MakeMovingBall();

}

#endif
