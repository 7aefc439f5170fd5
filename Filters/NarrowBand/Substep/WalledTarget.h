/**
 * Walls and obstacle: the surface does not leave the box of the one, nor enter the other.
 *
 * The target is cut off there, so the surface stops by itself. Other motions (Tension,
 * controls) are stopped by clamping the potential at the distance to the walls, or at the
 * obstacle's depth: both lie at the same nodes, so that what is at rest stays. The clamp alone
 * ends in the same place. But then the speed of a surface pressed on a wall stays large and limits
 * the time step, which costs 3 to 15 times as many substeps.
 */
#ifndef WalledTarget_h
#define WalledTarget_h

#include "Leaves/ActiveSet.h"
#include "Obstacle.h"
#include "Target.h"
#include "Walls.h"

namespace activesurface
{

struct SubstepBuffers;

/** A target within walls and outside an obstacle. */
class WalledTarget : public Target
{
public:
  /** The caller owns all; obstacle: or null. */
  WalledTarget(Target& target, const Walls& walls, const Obstacle* obstacle = nullptr)
    : Within(target)
    , Box(walls)
    , Solid(obstacle)
  {
  }

  /** Whether there is anything to cut it off. */
  bool IsCut() const { return this->Box.Present || this->Solid; }

  void MoveTo(double time) override { this->Within.MoveTo(time); }
  bool MayHaveChanged(const double bounds[6]) const override
  {
    return this->Within.MayHaveChanged(bounds);
  }
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;
  bool HasRegions() const override { return this->Within.HasRegions(); }
  std::size_t CountRegionSources() const override { return this->Within.CountRegionSources(); }
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override
  {
    this->Within.VisitRegions(first, end, visit);
  }
  void ForEachPart(const PartVisitor& visit) const override { this->Within.ForEachPart(visit); }
  bool IsThreadSafe() const override
  {
    return this->Within.IsThreadSafe() && (!this->Solid || this->Solid->IsThreadSafe());
  }

private:
  double DistanceBeyond(const double x[3]) const;

  Target& Within;
  const Walls& Box;
  const Obstacle* Solid;
};

/** What the surface does not leave, and does not enter. */
struct SurfaceBounds
{
  const Walls& Box;
  Obstacle* Solid; //< null: none
  double VoxelSize;
};

/** Next is no less than the distance to the walls, nor than the depth in the obstacle [voxels], at
 * any active node of the active leaves. To be called wherever Next has been written, before
 * CommitStep. Leaves that the obstacle does not know yet are sampled; the others cost a look, if it
 * is farther away than its Reach. */
void ClampToBounds(const SurfaceBounds& bounds, const LeafTable& table, const ActiveSet& set,
  SubstepBuffers& buffers);

/** Has the obstacle (or null) know all leaves, and throws std::runtime_error if it is not a number
 * in one of them: before a substep changes anything. */
void CheckObstacle(const LeafTable& table, Obstacle* obstacle);

}

#endif
