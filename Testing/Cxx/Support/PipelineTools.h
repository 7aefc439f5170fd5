/**
 * Tools for the pipeline tests: a time-dependent input that counts its executions, and filters with
 * such an input.
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

/** Source of particles that depend on time, with the point array "id". */
class ParticleSource : public vtkPolyDataAlgorithm
{
public:
  static ParticleSource* New();
  vtkTypeMacro(ParticleSource, vtkPolyDataAlgorithm);

  using Cloud = std::function<std::vector<Particle>(double time)>;
  void SetCloud(const Cloud& cloud);
  /** Time steps to publish. A source without steps publishes the TIME_RANGE 0..10 if it is
   * continuous, and otherwise no time. */
  void SetSteps(const std::vector<double>& steps);
  void SetContinuous(bool continuous);
  /** RequestData fails from this execution on, counted from 0. */
  void SetFailingExecution(int execution) { this->FailingExecution = execution; }
  /** If set, the source modifies itself while it executes, which sources should not do. */
  void SetRestless(bool restless) { this->Restless = restless; }

  /** Times of all executions, in order. */
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

/** Adds one to `executions` for each future execution of an algorithm. */
void CountExecutions(vtkAlgorithm* algorithm, int& executions);

/** Points, triangles and normals of the skin as bytes; empty for an empty skin. */
std::string GetBytes(vtkActiveImplicitSurface* filter);

std::string GetBytesAt(vtkActiveImplicitSurface* filter, double time);

/** Bounding box of the skin; an empty skin has x min > x max. */
std::array<double, 6> GetSkinBounds(vtkActiveImplicitSurface* filter);

/** A ball of radius 0.6 that shrinks towards one of radius 0.4, at the time steps 0, 0.1 ... 1. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeShrinkingBall();

/** Filter without an input: SUM of kernels of radius 0.3, explicit substeps, voxels of 0.05 in the
 * box +-1, and an Attraction of 10. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkin();

/** MakeSkin with an input, and without an array of ids. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkAlgorithm* source);
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkDataObject* data);

/** MakeSkin with an input whose array "id" has the ids of the particles. */
vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(ParticleSource* source);

/** Squared distance to a centre on the x axis, minus the squared radius. */
vtkSmartPointer<vtkImplicitFunction> MakeBallFunction(double radius, double x = 0.0);

/** Least and largest distance of the skin's points from a centre on the x axis. */
struct Radii
{
  double Least;
  double Largest;
};
Radii GetRadii(vtkActiveImplicitSurface* filter, double x = 0.0);

/** Checks that the skin is a ball around the origin, within the tolerance. */
void CheckBall(
  vtkActiveImplicitSurface* filter, double radius, double tolerance, const std::string& name);

/** One particle that moves along x from 0, by 0.2 per unit of time. */
std::vector<Particle> MovingBall(double time);

/** Source of MovingBall at the time steps 0 to 4. */
vtkSmartPointer<ParticleSource> MakeMovingBall();

}

#endif
