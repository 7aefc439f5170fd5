/**
 * The target: the function whose level set attracts the surface.
 */
#ifndef Target_h
#define Target_h

#include "TargetRegion.h"

#include <cstddef>

namespace activesurface
{

class Target
{
public:
  virtual ~Target() = default;

  /**
   * Sets the motion time of the next evaluations. Called by one thread, at the beginning of each
   * substep.
   */
  virtual void MoveTo(double time) { static_cast<void>(time); }

  /**
   * Whether values or slopes in this box (xmin xmax ymin ymax zmin zmax) may differ from those
   * before the last MoveTo. Where they do not, converged leaves are not evaluated again.
   */
  virtual bool MayHaveChanged(const double bounds[6]) const
  {
    static_cast<void>(bounds);
    return true;
  }

  /**
   * At `count` points (x y z each, world coordinates): values = F - iso, negative inside the
   * target; slopes = upper bounds of the target slope |dF/dn| there, which limits the time step
   * (1 for a distance, 0 where F is constant). A value that is not finite drops its sample point.
   * A point must give the same bytes in any batch.
   */
  virtual void Evaluate(
    std::size_t count, const double* points, double* values, double* slopes) const = 0;

  /**
   * Whether ForEachRegion knows where the surface of the target can be.
   */
  virtual bool HasRegions() const { return false; }

  /**
   * Visits the boxes in which new parts of the target, or new hollows, can be at the time of the
   * last MoveTo; one that meets a part is enough. In any order, but the boxes have to depend on the
   * time alone, else so does what a restart creates. What they cost is said in TargetRegion.h. A
   * part that touches the skin is not created, as the skin gets there by itself: as long as that
   * may end, its boxes have to come again.
   */
  virtual void ForEachRegion(const RegionVisitor& visit) const { static_cast<void>(visit); }

  /** Whether several threads may call Evaluate at once. */
  virtual bool IsThreadSafe() const { return true; }
};

}

#endif
