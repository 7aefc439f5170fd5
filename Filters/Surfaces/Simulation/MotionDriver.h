// Moves a band by the law of motion, with the target at the band's time.

#ifndef MotionDriver_h
#define MotionDriver_h

#include "Base/Obstacle.h"
#include "March/Arrival.h"
#include "NarrowBand.h"
#include "Simulation/SurfaceDomain.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"
#include "Targets/Warnings.h"

#include <cstddef>
#include <memory>

namespace activesurface
{

class MotionDriver
{
public:
  // Keeps references to the arguments.
  MotionDriver(const SurfaceSettings& settings, TargetBuilder& shapes, Warnings& messages);
  MotionDriver(const MotionDriver&) = delete;
  void operator=(const MotionDriver&) = delete;

  // Deletes what depends on the settings.
  void Clear()
  {
    this->Solid.reset();
    this->Arriving.reset();
  }

  // Limits that do not change the path of the skin. More active voxels than `maximum` are an
  // exception.
  void SetNumberOfThreads(int threads) { this->Threads = threads; }
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum) { this->MaximumVoxels = maximum; }

  // Initializes the band from the initial shape, or from the target. Start and the two functions
  // below return false if `progress` cancelled the call, and throw like NarrowBand.
  bool Start(NarrowBand& band, const SurfaceDomain& domain, const ProgressFunction& progress);

  // Advances from a step, or from an interruption after this step, to a time up to the next step.
  bool AdvanceTo(NarrowBand& band, int step, MotionTime time, const ProgressFunction& progress);

  // Also returns true if MaximumSubsteps ended the motion: report.IsSteady is then false, and a
  // warning is issued.
  bool AdvanceToSteadyState(
    NarrowBand& band, const ProgressFunction& progress, AdvanceReport& report);

  // Returns the parameters of the motion from a step to the next one (at the last step, for the
  // duration of the interval before); step -1: the motion at the start. isOnNodes: the node scheme
  // can follow the target in this interval.
  Motion GetMotion(int step, bool isOnNodes) const;
  Motion GetMotion(int step) const
  {
    return this->GetMotion(step, this->Shapes.IsOnNodes(step, step + 1));
  }

  // Returns the walls: the bounds with BoundedDomain; on periodic axes the sides of the periodic
  // box, moved outward by `beyond` [length]. Present is true with BoundedDomain (once there is a
  // domain) or a periodic axis.
  Walls MakeWalls(double beyond) const;

  // Numbers of all motions since ResetCounters, also of motions that ended in an exception; without
  // Start.
  std::size_t GetSubsteps() const { return this->Substeps; }
  std::size_t GetTargetEvaluations() const { return this->TargetEvaluations; }
  void ResetCounters() { this->Substeps = this->TargetEvaluations = 0; }

private:
  void Prepare(NarrowBand& band) const;
  Obstacle* FindObstacle() const;
  double FindTensionAtStart(const Motion& motion) const;
  void UseNodes(int step, double attraction, Motion& motion) const;
  void HoldLabelVolume(int step, double fraction, Motion& motion) const;
  void WarnOfSubsteps(int step, const Motion& motion);
  bool StartsOnNodes() const;
  bool StaysOnNodes() const;
  void StartOnNodes(NarrowBand& band, const SurfaceDomain& domain);
  void PlaceTargetFrom(int step);
  bool MayCreateParts(const Motion& motion) const;
  AdvanceReport AdvanceOrArrive(NarrowBand& band, int step, MotionTime time, const Motion& motion,
    const ProgressFunction& progress);
  void PrepareArrival(NarrowBand& band, int step, const Motion& motion);
  template <class Advance>
  AdvanceReport Count(const NarrowBand& band, Advance&& advance);

  const SurfaceSettings& Settings;
  TargetBuilder& Shapes;
  Warnings& Messages;
  int Threads = 0;
  std::size_t MaximumVoxels = 0;
  std::size_t Substeps = 0;
  std::size_t TargetEvaluations = 0;
  mutable std::unique_ptr<Obstacle> Solid; // null until FindObstacle creates it
  std::unique_ptr<Arrival> Arriving;       // kept while the motion is interrupted
  int ArrivingFrom = -1;                   // step at which Arriving was created
  std::size_t ArrivingAt = 0;              // number of the target of Arriving, see GetTargetNumber
};

}

#endif
