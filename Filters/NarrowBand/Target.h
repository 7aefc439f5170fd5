/**
 * The target: the function whose level set attracts the surface.
 */
#ifndef Target_h
#define Target_h

#include "TargetRegion.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

/** What is wanted of a target at each of some points. */
struct TargetResults
{
  /** F - iso, negative inside the target. A value that is not finite drops its sample point. */
  double* Values = nullptr;
  /** Upper bounds of the target slope |dF/dn|, which limits the time step: 1 for a distance, 0
   * where F is constant. */
  double* Slopes = nullptr;
};

class NodeTarget;

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
   * Whether results in this box (xmin xmax ymin ymax zmin zmax) may differ from those before the
   * last MoveTo. Where they do not, converged leaves are not evaluated again.
   */
  virtual bool MayHaveChanged(const double bounds[6]) const
  {
    static_cast<void>(bounds);
    return true;
  }

  /** Writes the results at `count` points (x y z each, world coordinates). A point must give the
   * same bytes in any batch. */
  virtual void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const = 0;

  /**
   * Whether ForEachRegion and ForEachPart together know where new parts can be.
   */
  virtual bool HasRegions() const { return false; }

  /**
   * Visits the boxes in which new parts of the target, or new hollows, can be at the time of the
   * last MoveTo; one that meets a part is enough. The boxes, and their order, have to depend on the
   * time alone, else so does what a restart creates. What they cost is said in TargetRegion.h. A
   * part that touches the skin is not created, as the skin gets there by itself: as long as that
   * may end, its boxes have to come again.
   */
  void ForEachRegion(const RegionVisitor& visit) const
  {
    this->VisitRegions(0, this->CountRegionSources(), visit);
  }

  ///@{
  /** The same by sources, as particles are, each of any number of boxes: those of the sources from
   * first to end - 1. Several threads may call it at once. */
  virtual std::size_t CountRegionSources() const { return 0; }
  virtual void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const
  {
    static_cast<void>(first);
    static_cast<void>(end);
    static_cast<void>(visit);
  }
  ///@}

  /**
   * Visits the parts of the shapes that the target is on its way between, and their hollows: those
   * that the skin does not meet are created when the target is there. In any order, but it has to
   * depend on the time alone.
   */
  virtual void ForEachPart(const PartVisitor& visit) const { static_cast<void>(visit); }

  /** Returns this target as one at lattice nodes, for TimeIntegration::Nodes; null if it has no
   * such form. */
  virtual NodeTarget* GetNodes() { return nullptr; }

  /** Whether several threads may call Evaluate at once. */
  virtual bool IsThreadSafe() const { return true; }
};

}

#endif
