// Width of the margin around a rank's partition in which the rank needs particles.

#include "ParticleNodes.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

int FindMarginOfNodes(const NodeParticleOptions& options, double longestReach)
{
  // Margins around nodes and around leaves [voxels], and around full cells (ParticleBlocks.h) [own
  // radii].
  constexpr double nodesAround = 5.0, leafAround = 12.0, cellsBeside = 4.0;
  // The centre of an ellipsoid is nearer to its particle than the radius of the neighbourhood.
  const double wide = GetNeighbourhoodPerRadius(options.Model) * longestReach;
  const double ellipsoid =
    longestReach * std::max(std::cbrt(options.Anisotropy * options.Anisotropy), 1.0) + wide;
  const double filling = StretchInBody * longestReach + cellsBeside * options.OwnRadius;
  const double voxels =
    std::max(ellipsoid / options.VoxelSize + nodesAround, filling / options.VoxelSize + leafAround);
  constexpr double most = 1e6;
  return static_cast<int>(std::ceil(std::min(voxels, most)));
}

}
