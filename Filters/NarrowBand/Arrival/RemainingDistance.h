/**
 * How far the surface still has to go from a point, to the farthest place that it gets to by that
 * point: along ways between the surface and its target.
 *
 * With T(y) the distance of a node from the surface along such ways, and d(x,y) that of two nodes,
 *
 *   K(x) = max over y of  2 (T(y) - T(x)) - d(x,y),
 *
 * which is T(y) - T(x) where y is reached by x, and falls off beside that way: a front that goes
 * K / (remaining time) is flat, however thin the part is that it fills, and arrives everywhere at
 * once. Where y is in the middle of a part that vanishes, and d(x,y) longer by less than a tenth, K
 * is d(x,y): x is a bump then, which has to go farther than what is around it, or it would grow.
 * Where the target is a distance and the surface near, K is about |F|.
 */
#ifndef RemainingDistance_h
#define RemainingDistance_h

#include "Arrival/DifferingNodes.h"

namespace activesurface
{

class RemainingDistance
{
public:
  /** None is known where the lattice would need too many nodes. */
  explicit RemainingDistance(const ArrivalSearch& search);

  /** At points (x y z each) by trilinear interpolation between the nodes at which the surface still
   * has to grow, or to shrink; negative where none is near. */
  void Find(std::size_t count, const double* points, const bool* grow, double* distances) const;

private:
  void Keep(DifferingNodes& nodes);
  void ExtendBehindSurface(const DifferingNodes& nodes, std::size_t i, double distance);

  double Spacing = 1.0;
  openvdb::FloatTree Growing{ -1.f };
  openvdb::FloatTree Shrinking{ -1.f };
};

}

#endif
