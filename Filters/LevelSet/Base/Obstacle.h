/**
 * A solid that the surface may not enter, sampled at the nodes of the lattice.
 *
 * The depth of a node is minus the signed distance to the obstacle: positive inside, exact to first
 * order near the obstacle's surface. The obstacle does not change, so the depths of a leaf are
 * sampled once and stored. An obstacle has no effect at nodes that are Reach voxels or more
 * outside.
 */
#ifndef Obstacle_h
#define Obstacle_h

#include "ActiveLevelSetExport.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace activesurface
{

class ACTIVELEVELSET_EXPORT Obstacle
{
public:
  /** Origin of a leaf [nodes]. */
  using LeafOrigin = std::array<int, 3>;

  /** Signed distances at `count` points (x y z each) [world units], negative inside. */
  using DistanceFunction =
    std::function<void(std::size_t count, const double* points, double* distances)>;

  /** Distance beyond which the obstacle has no effect [voxels]; more than half the band's width. */
  static constexpr float Reach = 8.f;

  /** origin: position of node 0, for messages; the function's points are relative to it. */
  Obstacle(double voxelSize, const DistanceFunction& distances, bool isThreadSafe,
    const std::array<double, 3>& origin = {});
  Obstacle(const Obstacle&) = delete;
  void operator=(const Obstacle&) = delete;
  ~Obstacle();

  bool IsThreadSafe() const { return this->ThreadSafe; }

  /** Samples the leaves at these origins, except leaves already sampled. Calls must not overlap. */
  void SampleLeaves(const std::vector<LeafOrigin>& origins);
  bool IsKnown(const LeafOrigin& origin) const;

  /** Returns the depths [voxels] at the 512 nodes of a sampled leaf, or null if the obstacle has no
   * effect at any node of the leaf. At a node without effect, the depth is below all values of the
   * band. */
  const float* FindDepths(const LeafOrigin& origin) const;

  /** Returns the depth [length] at a point [world units], interpolated linearly between nodes.
   * Returns -infinity if at one of these nodes the obstacle has no effect or the function is NaN,
   * or if a coordinate of the point is NaN, or 10^9 voxels or more from 0. */
  double DepthAt(const double x[3]) const;

  /** Throws std::runtime_error if the function was NaN at a node of a sampled leaf. */
  void Check() const;

private:
  float ToDepth(double distance) const;
  bool SampleLeaf(const LeafOrigin& origin, float* depths) const;
  float DepthOfNode(const std::array<int, 3>& node) const;

  const double VoxelSize;
  const DistanceFunction Distances;
  const bool ThreadSafe;
  const std::array<double, 3> Origin;
  struct SampledDepths;
  std::unique_ptr<SampledDepths> Depths;
  bool IsBad = false;
  LeafOrigin BadLeaf{};
};

}

#endif
