/**
 * Where the surface of a function can be: boxes.
 */
#ifndef TargetRegion_h
#define TargetRegion_h

#include <functional>

namespace activesurface
{

/** A box, in world units. One that is empty or not finite holds nothing. */
struct TargetRegion
{
  double Bounds[6] = {}; //< xmin xmax ymin ymax zmin zmax

  /**
   * Whether the region can be looked at by one value: a part of the target that no skin reaches
   * has the centre of such a box in it, as a particle's support has. Otherwise all nodes of the
   * leaves that the box touches are sampled for new parts. At the start both are the same.
   */
  bool SeededAtCentre = false;
};

using RegionVisitor = std::function<void(const TargetRegion&)>;

}

#endif
