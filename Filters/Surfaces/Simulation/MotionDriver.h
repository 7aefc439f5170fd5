// Moves a band by the law of motion, with the target where it is at that time.

#ifndef MotionDriver_h
#define MotionDriver_h

#include "Arrival.h"
#include "NarrowBand.h"
#include "Obstacle.h"
#include "Simulation/SurfaceDomain.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"
#include "Simulation/Warnings.h"

#include <cstddef>
#include <memory>

namespace activesurface
{

class MotionDriver
{
public:
  // All three are the caller's.
  MotionDriver(const SurfaceSettings& settings, TargetBuilder& shapes, Warnings& messages);
  MotionDriver(const MotionDriver&) = delete;
  void operator=(const MotionDriver&) = delete;

  // Comes when the settings have changed.
  void Clear()
  {
    this->Solid.reset();
    this->Arriving.reset();
  }

  // None of them changes the motion.
  void SetNumberOfThreads(int threads) { this->Threads = threads; }
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum) { this->MaximumVoxels = maximum; }

  // Puts the band on the shape that it starts with. All return false if `progress` has stopped
  // them, and throw what NarrowBand throws.
  bool Start(NarrowBand& band, const SurfaceDomain& domain, const ProgressFunction& progress);

  // From a step, or from where it was interrupted after it, to a time that is not after the next
  // step.
  bool AdvanceTo(NarrowBand& band, int step, MotionTime time, const ProgressFunction& progress);

  // Also true when the substeps are used up, with a warning; the report tells.
  bool AdvanceToSteadyState(
    NarrowBand& band, const ProgressFunction& progress, AdvanceReport& report);

  // On the way from a step to the next one, over particles or not; before the first step: -1.
  Motion GetMotion(int step, bool hasParticles) const;
  Motion GetMotion(int step) const
  {
    return this->GetMotion(step, this->Shapes.HasParticles(step, step + 1));
  }

  // The walls, those of a periodic box at a distance from its sides.
  Walls MakeWalls(double beyond) const;

  // Since ResetCounters, also of motions that ended in an exception.
  std::size_t GetSubsteps() const { return this->Substeps; }
  std::size_t GetTargetEvaluations() const { return this->TargetEvaluations; }
  void ResetCounters() { this->Substeps = this->TargetEvaluations = 0; }

private:
  void Prepare(NarrowBand& band) const;
  Obstacle* FindObstacle() const;
  void UseNodes(double attraction, Motion& motion) const;
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
  mutable std::unique_ptr<Obstacle> Solid; // null until it is asked for
  std::unique_ptr<Arrival> Arriving;       // from a step on; kept as a motion may be interrupted
  int ArrivingFrom = -1;                   // that step
  std::size_t ArrivingAt = 0;              // the target's number
};

}

#endif
