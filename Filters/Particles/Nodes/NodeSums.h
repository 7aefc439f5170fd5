// Potential of ellipsoids at the nodes of a leaf, eight nodes in SIMD lanes, summed in the order of
// the particles.

#ifndef NodeSums_h
#define NodeSums_h

#include "Nodes/ParticleRuns.h"

#include <cstdint>

namespace activesurface
{

// Surface: x^T Metric x = 1, with x the offset from the centre [voxels]. Metric: xx xy xz yy yz zz.
// Extent: half of the box's sides.
struct NodeEllipsoid
{
  float Metric[6];
  float Strength;
  float Extent[3];
};

// Centres, relative to the block, and squared support radii, padded by LanePadding.
struct EllipsoidColumns
{
  const float *X, *Y, *Z, *Reach2;
};

// Finds 1 - (sum of strength (1 - d^2)^3)^(1/4), with d^2 = x^T Metric x, at the nodes of some rows
// of a leaf (bits 8 x + y), and sets 1 at all other nodes. Shifts of the runs are relative to the
// first node of the leaf.
void FindPotential(const EllipsoidColumns& columns, const NodeEllipsoid* ellipsoids,
  const ParticleRuns& runs, std::uint64_t rows, float* values);

}

#endif
