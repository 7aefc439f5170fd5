/**
 * Where the surface of a function can be: boxes, or the connected parts of a shape.
 */
#ifndef TargetRegion_h
#define TargetRegion_h

#include <functional>

namespace activesurface
{

/**
 * What tells whether a region has a part of the target that no skin reaches, or a hollow: the
 * values at all nodes of the leaves that the box touches; or the value at its centre, which the
 * part or the hollow holds; or the same for parts alone, or for hollows alone. The last two are for
 * particles: within one a part is looked for, beside it a hollow. Where the skin is around the one
 * and not around the other, they cost no value.
 */
enum class RegionSeeds
{
  AllNodes,
  Centre,
  PartAtCentre,
  HollowAtCentre
};

/** A box, in world units. One that is empty or not finite holds nothing. */
struct TargetRegion
{
  double Bounds[6] = {};                     //< xmin xmax ymin ymax zmin zmax
  RegionSeeds Seeds = RegionSeeds::AllNodes; //< for new parts; at the start they are all the same
};

using RegionVisitor = std::function<void(const TargetRegion&)>;

/** Called for points (x y z) until it returns false. */
using PointVisitor = std::function<bool(const double x[3])>;

/**
 * A connected part of the inside of a shape that the target is, or goes to; or a hollow of it, a
 * part of its outside that is enclosed.
 */
class TargetPart
{
public:
  virtual ~TargetPart() = default;

  virtual bool IsHollow() const = 0;

  /** Some points of it, the deepest ones first: some in each piece of a few voxels. */
  virtual void ForEachSample(const PointVisitor& visit) const = 0;

  /** All that are known; a skin that holds none of them does not meet the part. */
  virtual void ForEachPoint(const PointVisitor& visit) const = 0;
};

using PartVisitor = std::function<void(const TargetPart&)>;

}

#endif
