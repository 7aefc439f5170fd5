/** Regions that may contain the surface of a function: boxes, or the connected parts of a shape. */
#ifndef TargetRegion_h
#define TargetRegion_h

#include <functional>

namespace activesurface
{

/**
 * Points of a region at which the target is compared with the skin. The comparison finds parts of
 * the target that the skin does not reach, and hollows. AllNodes: all nodes of the leaves that the
 * box touches. Centre: the centre of the box, a point of the part or hollow. PartAtCentre and
 * HollowAtCentre: the centre, only for parts or only for hollows. Particles use PartAtCentre to
 * search for a part in a particle, and HollowAtCentre to search for a hollow next to a particle.
 * PartAtCentre costs no evaluation if the skin contains the centre, HollowAtCentre if the skin does
 * not contain the centre.
 */
enum class RegionSeeds
{
  AllNodes,
  Centre,
  PartAtCentre,
  HollowAtCentre
};

/** A box [world units]. A box that is empty or not finite contains nothing. */
struct TargetRegion
{
  double Bounds[6] = {};                     //< xmin xmax ymin ymax zmin zmax
  RegionSeeds Seeds = RegionSeeds::AllNodes; //< for new parts; not used at the start
};

using RegionVisitor = std::function<void(const TargetRegion&)>;

/** Called for each point (x y z), until a call returns false. */
using PointVisitor = std::function<bool(const double x[3])>;

/**
 * A connected part of the inside of a shape, or a hollow: an enclosed part of the outside of the
 * shape. The target moves between shapes; the part belongs to one of these shapes.
 */
class TargetPart
{
public:
  virtual ~TargetPart() = default;

  virtual bool IsHollow() const = 0;

  /** Visits some points of the part, the deepest ones first: at least one in each leaf or tile. */
  virtual void ForEachSample(const PointVisitor& visit) const = 0;

  /** Visits points throughout the part. The skin meets a part of the inside if a point of the
   * part is inside the skin, and a hollow if a point of the hollow is outside the skin. */
  virtual void ForEachPoint(const PointVisitor& visit) const = 0;
};

using PartVisitor = std::function<void(const TargetPart&)>;

}

#endif
