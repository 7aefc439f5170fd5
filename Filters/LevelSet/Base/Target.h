/**
 * The target: the function whose level set attracts the surface.
 */
#ifndef Target_h
#define Target_h

#include "Base/TargetRegion.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

/** Results of a target at some points. */
struct TargetResults
{
  /** F - iso, negative inside the target. A value that is not finite in single precision drops the
   * sample point. */
  double* Values = nullptr;
  /** Upper bounds of the target slope |dF/dn|, which limits the time step. The slope is 1 for a
   * distance, and 0 where F is constant. */
  double* Slopes = nullptr;
};

class NodeTarget;

class Target
{
public:
  virtual ~Target() = default;

  /**
   * Sets the time of the next evaluations. Called by one thread before the evaluations of each
   * explicit substep.
   */
  virtual void MoveTo(double time) { static_cast<void>(time); }

  /**
   * Returns true if results in a box (xmin xmax ymin ymax zmin zmax) may differ from those before
   * the last MoveTo. Otherwise converged leaves in the box are not evaluated again.
   */
  virtual bool MayHaveChanged(const double bounds[6]) const
  {
    static_cast<void>(bounds);
    return true;
  }

  /** Writes the results at `count` points (x y z each, world coordinates). The results of a point
   * must be bitwise identical in any batch. */
  virtual void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const = 0;

  /** Returns true if ForEachRegion and ForEachPart together cover all new parts. */
  virtual bool HasRegions() const { return false; }

  /**
   * Visits the boxes in which new parts of the target, or new hollows, can be at the time of the
   * last MoveTo. One box per part is enough; the box has to meet the part. The boxes and their
   * order must depend only on the time, otherwise a restart may create different parts.
   * TargetRegion.h describes the cost. A part that touches the skin is not created, because the
   * skin grows into the part. The boxes of such a part have to be visited in later substeps too,
   * because the contact may end.
   */
  void ForEachRegion(const RegionVisitor& visit) const
  {
    this->VisitRegions(0, this->CountRegionSources(), visit);
  }

  ///@{
  /** CountRegionSources returns the number of sources of regions, for example particles.
   * VisitRegions visits all regions of the sources `first` to `end` - 1. Thread-safe. */
  virtual std::size_t CountRegionSources() const { return 0; }
  virtual void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const
  {
    static_cast<void>(first);
    static_cast<void>(end);
    static_cast<void>(visit);
  }
  ///@}

  /**
   * Visits the parts and hollows of the shapes between which the target moves. A part that the skin
   * does not meet is created once the target is wide enough in that part (NewParts.h). The order
   * must depend only on the time.
   */
  virtual void ForEachPart(const PartVisitor& visit) const { static_cast<void>(visit); }

  /** Returns this target as a NodeTarget, for TimeIntegration::Nodes; null if this is not
   * possible. */
  virtual NodeTarget* GetNodes() { return nullptr; }

  /** Returns true if several threads may call Evaluate at once. */
  virtual bool IsThreadSafe() const { return true; }
};

}

#endif
