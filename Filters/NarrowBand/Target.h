/**
 * What the surface is attracted by.
 */
#ifndef Target_h
#define Target_h

#include <cstddef>

namespace activesurface
{

class Target
{
public:
  virtual ~Target() = default;

  /**
   * The motion time at which the next evaluations are wanted. Called by one thread, at the
   * beginning of each substep.
   */
  virtual void MoveTo(double time) { static_cast<void>(time); }

  /**
   * Whether values or slopes in this box (xmin xmax ymin ymax zmin zmax) may differ from those
   * before the last MoveTo. What does not change is evaluated once where the surface rests.
   */
  virtual bool MayHaveChanged(const double bounds[6]) const
  {
    static_cast<void>(bounds);
    return true;
  }

  /**
   * At `count` points (x y z each, world coordinates): values = F - iso, negative inside the
   * target; slopes = an upper bound of |dF/dn| there, the stiffness that limits the time step
   * (1 for a distance, 0 where F is constant). A value that is not finite drops its sample point.
   * Must give the same bytes for a point whatever the batch it comes in.
   */
  virtual void Evaluate(
    std::size_t count, const double* points, double* values, double* slopes) const = 0;

  /** Whether Evaluate may be called by several threads at once. */
  virtual bool IsThreadSafe() const { return true; }
};

}

#endif
