/**
 * Walls and obstacle: the surface stays inside the box and outside the obstacle.
 *
 * The target is cut off at walls and obstacle, so the surface stops by itself. Other motions
 * (Tension, controls) are stopped by clamping the potential to the distance to the walls and the
 * obstacle's depth. The cut uses the same depths at the nodes as the clamp, so a steady surface
 * stays steady. Without the cut, the clamp would stop the surface at the same position. But the
 * speed of a surface pressed on a wall would stay large and limit the time step: 3 to 15 times as
 * many substeps would be needed.
 */
#ifndef WalledTarget_h
#define WalledTarget_h

#include "Base/Obstacle.h"
#include "Base/Target.h"
#include "Base/Walls.h"
#include "Leaves/ActiveSet.h"

namespace activesurface
{

struct SubstepBuffers;

/** A target within walls and outside an obstacle. */
class WalledTarget : public Target
{
public:
  /** The caller owns all arguments; obstacle may be null. */
  WalledTarget(Target& target, const Walls& walls, const Obstacle* obstacle = nullptr)
    : Wrapped(target)
    , Box(walls)
    , Solid(obstacle)
  {
  }

  /** Returns true if there are walls or an obstacle. */
  bool IsCut() const { return this->Box.Present || this->Solid; }

  void MoveTo(double time) override { this->Wrapped.MoveTo(time); }
  bool MayHaveChanged(const double bounds[6]) const override
  {
    return this->Wrapped.MayHaveChanged(bounds);
  }
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;
  bool HasRegions() const override { return this->Wrapped.HasRegions(); }
  std::size_t CountRegionSources() const override { return this->Wrapped.CountRegionSources(); }
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override
  {
    this->Wrapped.VisitRegions(first, end, visit);
  }
  void ForEachPart(const PartVisitor& visit) const override { this->Wrapped.ForEachPart(visit); }
  bool IsThreadSafe() const override
  {
    return this->Wrapped.IsThreadSafe() && (!this->Solid || this->Solid->IsThreadSafe());
  }

private:
  double DistanceBeyond(const double x[3]) const;

  Target& Wrapped;
  const Walls& Box;
  const Obstacle* Solid;
};

/** Walls and obstacle of the surface. */
struct SurfaceBounds
{
  const Walls& Box;
  Obstacle* Solid; //< null: none
  double VoxelSize;
};

/** Clamps Next at all active nodes of the active leaves to at least the distance to the walls and
 * the depth in the obstacle [voxels]. Called after each write to Next, before CommitStep. Samples
 * the obstacle in leaves where it has not been sampled. Sampled leaves farther from the obstacle
 * than Obstacle::Reach cost only a test. */
void ClampToBounds(const SurfaceBounds& bounds, const LeafTable& table, const ActiveSet& set,
  SubstepBuffers& buffers);

/** Samples the obstacle in all leaves. obstacle: may be null. Throws std::runtime_error if the
 * obstacle is NaN at a node of a sampled leaf. */
void CheckObstacle(const LeafTable& table, Obstacle* obstacle);

}

#endif
