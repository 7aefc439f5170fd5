/**
 * A solid that the surface may not enter, on the nodes of the lattice.
 *
 * It is known by its depths: minus the signed distance, positive inside, exact to first order near
 * its surface. A node's depth follows from the function alone; those of whole leaves are kept once
 * they have been sampled, as the obstacle does not change. Where it is farther away than Reach
 * voxels it does not count.
 */
#ifndef Obstacle_h
#define Obstacle_h

#include "ActiveNarrowBandExport.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace activesurface
{

class ACTIVENARROWBAND_EXPORT Obstacle
{
public:
  /** Origin of a leaf [nodes]. */
  using LeafOrigin = std::array<int, 3>;

  /** Signed distances at `count` points (x y z each) [world units], negative inside. */
  using DistanceFunction =
    std::function<void(std::size_t count, const double* points, double* distances)>;

  /** [voxels]; more than the band is wide, on either side of the surface. */
  static constexpr float Reach = 8.f;

  Obstacle(double voxelSize, const DistanceFunction& distances, bool isThreadSafe);
  Obstacle(const Obstacle&) = delete;
  void operator=(const Obstacle&) = delete;
  ~Obstacle();

  bool IsThreadSafe() const { return this->ThreadSafe; }

  /** Samples those of the leaves, by their origins, that are not known. By one thread at a time. */
  void SampleLeaves(const std::vector<LeafOrigin>& origins);
  bool IsKnown(const LeafOrigin& origin) const;

  /** The depths [voxels] at the 512 nodes of a leaf that is known, below all of the band's values
   * where the obstacle does not count; null if it does so nowhere. */
  const float* FindDepths(const LeafOrigin& origin) const;

  /** The depth at a point [world units], linear from node to node; -infinity where the obstacle
   * does not count, and where the function is not a number. */
  double DepthAt(const double x[3]) const;

  /** Throws std::runtime_error if the function was not a number at a node of a leaf. */
  void Check() const;

private:
  float ToDepth(double distance) const;
  bool SampleLeaf(const LeafOrigin& origin, float* depths) const;
  float DepthOfNode(const std::array<int, 3>& node) const;

  const double VoxelSize;
  const DistanceFunction Distances;
  const bool ThreadSafe;
  struct SampledDepths;
  std::unique_ptr<SampledDepths> Depths;
  bool IsBad = false;
  LeafOrigin BadLeaf{};
};

}

#endif
