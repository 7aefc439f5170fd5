/**
 * Walls: the surface does not leave their box.
 *
 * The target is cut off at the walls, so the surface stops there by itself. Other motions (Tension,
 * controls) are stopped by clamping the potential at the distance to the walls. The clamp alone
 * ends in the same place. But then the speed of a surface pressed on a wall stays large and limits
 * the time step, which costs 3 to 15 times as many substeps.
 */
#ifndef WalledTarget_h
#define WalledTarget_h

#include "Leaves/ActiveSet.h"
#include "Target.h"
#include "Walls.h"

namespace activesurface
{

struct SubstepBuffers;

/** A target within walls. */
class WalledTarget : public Target
{
public:
  /** The caller owns both. */
  WalledTarget(Target& target, const Walls& walls)
    : Within(target)
    , Box(walls)
  {
  }

  void MoveTo(double time) override { this->Within.MoveTo(time); }
  bool MayHaveChanged(const double bounds[6]) const override
  {
    return this->Within.MayHaveChanged(bounds);
  }
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;
  bool HasRegions() const override { return this->Within.HasRegions(); }
  void ForEachRegion(const RegionVisitor& visit) const override
  {
    this->Within.ForEachRegion(visit);
  }
  void ForEachPart(const PartVisitor& visit) const override { this->Within.ForEachPart(visit); }
  bool IsThreadSafe() const override { return this->Within.IsThreadSafe(); }

private:
  Target& Within;
  const Walls& Box;
};

/** Next is no less than the distance to the walls [voxels] at any active node of the active leaves.
 */
void ClampToWalls(const LeafTable& table, const ActiveSet& set, const Walls& walls,
  double voxelSize, SubstepBuffers& buffers);

}

#endif
