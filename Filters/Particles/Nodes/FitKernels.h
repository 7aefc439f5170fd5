// Fits of particles to their neighbours, for eight particles in SIMD lanes with one list of
// neighbours. Lengths in voxels.
//
// The fit of a particle near a surface is an ellipsoid with the shape of its neighbourhood (Yu and
// Turk 2013); see NodeFits.h for the strength. The support radius grows with the density of the
// neighbours, and is least for an isolated particle. The kernels of small drops therefore overlap
// less. With HasTriangles, the ball of an isolated particle is a little larger than the particle,
// to compensate for the volume that triangulation loses.

#ifndef FitKernels_h
#define FitKernels_h

#include "Index/UnsetVector.h"
#include "Nodes/ParticleRuns.h"

#include <cstdint>

namespace activesurface
{

// Up to eight particles near each other, or points (then only Place is set), with positions
// relative to a common origin. Entries from Count on repeat the last one; Members has none there.
struct FitGroup
{
  int Count = 0;
  std::uint32_t Members[8];
  alignas(32) float Place[3][8];
  alignas(32) float OwnRadius[8];
  alignas(32) float Reach[8]; // support radius in a body
  alignas(32) float Strength[8];

  float Middle[3]; // centre of the box of the positions, and half of the box's sides
  float Half[3];

  void FindBox();
};

// Neighbour of a group: position relative to the group's origin, and row in the columns.
struct FitNeighbour
{
  float Place[3];
  std::uint32_t Number;
};

using FitNeighbours = UnsetVector<FitNeighbour>;

// Positions, relative to the origin of each run's block, and squared support radii, padded by
// LanePadding.
struct PlaceColumns
{
  const float *X, *Y, *Z, *Reach2;
};

// Lists the particles whose supports touch the group's box. Shifts of the runs are relative to the
// group's origin.
void ListNeighbours(const FitGroup& group, const PlaceColumns& columns, const ParticleRuns& runs,
  FitNeighbours& neighbours);

// Returns radius / ownRadius - 1 for the ball of an isolated particle, with HasTriangles.
// ownRadius: own radius of the particle [voxels].
double FindLossOfBall(double ownRadius);

struct FitLaw
{
  float WidePerReach; // radius of the neighbourhood over support radius
  float Anisotropy;   // largest ratio of axes
  bool HasTriangles;  // otherwise balls are not enlarged, see FindLossOfBall
};

// The fits of a group, without the strengths.
struct GroupFits
{
  alignas(32) float Bulk[8];      // in [0,1]: 0 for sheets and isolated particles, 1 in a body
  alignas(32) float Shape[8];     // in [0,1], weight of the ellipsoid: 0 for an isolated particle
  alignas(32) float Deep[8];      // weight of the point at Away
  alignas(32) float Thin[8];      // weight of the point at Across
  alignas(32) float Offset[3][8]; // from the particle to the centre
  alignas(32) float Metric[6][8]; // see NodeEllipsoid
  alignas(32) float Extent[3][8];
  alignas(32) float Reach[8];     // bound on the longest half-axis
  alignas(32) float Lone[8];      // kernel at the surface of an isolated particle
  alignas(32) float Away[3][8];   // from the particle to the expected surface of a body
  alignas(32) float Across[3][8]; // to the expected surface of a sheet or thread
};

// Weight of a neighbour at the distance d < W: its strength * (1 - d^2/W^2)^2, with its own W =
// WidePerReach * reach; 0 beyond W.
struct WeightColumns
{
  const float* InverseWide2;
  const float* Strength;
};
void FindGroupFits(const FitLaw& law, const FitGroup& group, const FitNeighbours& neighbours,
  const WeightColumns& weights, GroupFits& fits);

struct NodeEllipsoid;

// Sums strength (1 - d^2)^3 over ellipsoids at the group's positions; d: distance from an
// ellipsoid's centre / its radius in this direction. The neighbours' positions are the centres.
void SumEllipsoids(const FitGroup& group, const FitNeighbours& neighbours,
  const NodeEllipsoid* ellipsoids, float (&sums)[8]);

// Sums of SumEllipsoids, and their gradients.
struct PointSums
{
  alignas(32) float Sum[8];
  alignas(32) float Gradient[3][8];
};
void SumEllipsoids(const FitGroup& group, const FitNeighbours& neighbours,
  const NodeEllipsoid* ellipsoids, PointSums& sums);

// Sums k * Share and k * Share * Lack over the neighbours, at the group's positions. The kernel k
// is (1 - d^2/W^2)^2, see WeightColumns. Share: weight of a particle at a surface, otherwise 0.
// Lack: see NodeFits.h.
struct ShareColumns
{
  const float* InverseWide2;
  const float* Share; // multiplied by the strength
  const float* Lack;
};
void SumShares(const FitGroup& group, const FitNeighbours& neighbours, const ShareColumns& columns,
  float (&shares)[8], float (&lacks)[8]);

}

#endif
