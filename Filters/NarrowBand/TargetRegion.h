/**
 * Where the surface of a function can be: boxes.
 */
#ifndef TargetRegion_h
#define TargetRegion_h

#include <functional>

namespace activesurface
{

/**
 * What tells whether a region has a part of the target that no skin reaches, or a hollow: the
 * values at all nodes of the leaves that the box touches; or the value at its centre, which the
 * part or the hollow holds; or the same for parts alone. The last is for a particle's support: it
 * costs no value where the skin is around the particle.
 */
enum class RegionSeeds
{
  AllNodes,
  Centre,
  PartAtCentre
};

/** A box, in world units. One that is empty or not finite holds nothing. */
struct TargetRegion
{
  double Bounds[6] = {};                     //< xmin xmax ymin ymax zmin zmax
  RegionSeeds Seeds = RegionSeeds::AllNodes; //< for new parts; at the start they are all the same
};

using RegionVisitor = std::function<void(const TargetRegion&)>;

}

#endif
