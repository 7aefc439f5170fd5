/**
 * Remaining distance of the surface at a point, along paths between the surface and its target.
 * Each path ends at the farthest point of the target that the surface reaches through the given
 * point.
 *
 * T(y) is the distance of a node y from the surface along such paths, d(x,y) the distance between
 * two nodes. The remaining distance at x is
 *
 *   K(x) = max over y of  2 (T(y) - T(x)) - d(x,y).
 *
 * If the path to y passes through x, K is T(y) - T(x); off that path K is smaller. With the speed
 * K / (remaining time) the front in a thin part of the target stays flat across the part, and all
 * points of the surface arrive at once.
 *
 * Exception: if y is in the middle of a vanishing part or hollow, K is d(x,y) where d(x,y) <= 1.1
 * (T(y) - T(x)); the exception fades out up to 1.3 (T(y) - T(x)). Such a point x is on a bump,
 * which would grow unless x moved farther than its neighbours.
 */
#ifndef RemainingDistance_h
#define RemainingDistance_h

#include "March/DifferingNodes.h"

namespace activesurface
{

class RemainingDistance
{
public:
  /** If the lattice would need too many nodes, Find returns only negative distances. */
  explicit RemainingDistance(const ArrivalSearch& search);

  /** Finds distances at points (x y z each) by trilinear interpolation between the nodes at which
   * the surface has to grow (grow[i]), or to shrink (not grow[i]). A distance is negative if no
   * corner of the lattice cell around the point is such a node, or a neighbour of such a node
   * across the surface. */
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
