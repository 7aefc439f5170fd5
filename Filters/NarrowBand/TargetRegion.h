/**
 * Where the surface of a function can be: boxes.
 */
#ifndef TargetRegion_h
#define TargetRegion_h

#include <functional>

namespace activesurface
{

/** What tells whether a region has a part of the target that no skin reaches, or a hollow. */
enum class RegionSeeds
{
  AllNodes,    //< the values at all nodes of the leaves that the box touches
  Centre,      //< the value at its centre: the part, or the hollow, holds it
  PartAtCentre //< the same for parts alone, as the box is a particle's support: costs no value
               //where < the skin is around the particle
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
