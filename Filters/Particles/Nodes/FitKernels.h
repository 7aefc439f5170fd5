// What particles find out about their neighbours, eight particles side by side, by the same list of
// neighbours. Lengths in voxels.
//
// A particle's fit is its ellipsoid: what its neighbourhood is like (Yu and Turk 2013), near a
// surface; see NodeFits.h for the strength. Few neighbours have a shorter reach, so that drops
// do not grow into each other's kernels: from a lone particle to a body it grows by the density of
// the neighbours. A ball is a little larger than its particle, for what triangles between points on
// a sphere lose.

#ifndef FitKernels_h
#define FitKernels_h

#include "Index/UnsetVector.h"
#include "Nodes/ParticleRuns.h"

#include <cstdint>

namespace activesurface
{

// Up to eight particles that are near one another; places relative to an origin that they share.
// Columns that are not used repeat the last particle.
struct FitGroup
{
  int Count = 0;
  std::uint32_t Members[8];
  alignas(32) float Place[3][8];
  alignas(32) float OwnRadius[8];
  alignas(32) float Reach[8]; // of the kernel in a body
  alignas(32) float Strength[8];

  float Middle[3]; // of the box of the places, and half of its sides
  float Half[3];

  void FindBox();
};

// One of the neighbours of a group, relative to the same origin.
struct FitNeighbour
{
  float Place[3];
  std::uint32_t Number;
};

using FitNeighbours = UnsetVector<FitNeighbour>;

// Places, relative to their own origin, and squared reaches, of eight more than there are.
struct PlaceColumns
{
  const float *X, *Y, *Z, *Reach2;
};

// Lists the particles whose reach comes to the group's box. Shifts of the runs are from the group's
// origin.
void ListNeighbours(const FitGroup& group, const PlaceColumns& columns, const ParticleRuns& runs,
  FitNeighbours& neighbours);

// A ball is larger than its particle by this share of its radius, which is in voxels.
double FindLossOfBall(double ownRadius);

struct FitLaw
{
  float WidePerReach; // neighbourhood over reach of the kernel
  float Anisotropy;   // largest ratio of axes
  bool HasTriangles;  // else a ball has no loss, see FindLossOfBall
};

// The fits of a group, but for the strengths.
struct GroupFits
{
  alignas(32) float Bulk[8];      // in [0,1], how much of a body is around
  alignas(32) float Shape[8];     // in [0,1], 0 for a lone particle: of what it is among neighbours
  alignas(32) float Deep[8];      // how much the place Away counts
  alignas(32) float Thin[8];      // how much the place Across counts
  alignas(32) float Offset[3][8]; // from the particle to the centre
  alignas(32) float Metric[6][8];
  alignas(32) float Extent[3][8];
  alignas(32) float Reach[8];     // longest half-axis
  alignas(32) float Lone[8];      // the kernel at the surface of a lone one
  alignas(32) float Away[3][8];   // from the particle to where the surface of a body should be,
  alignas(32) float Across[3][8]; // and to that of a sheet or thread
};

// Weight of a neighbour: (1 - d^2/W^2)^2 with its own W = WidePerReach * reach, by its strength.
struct WeightColumns
{
  const float* InverseWide2;
  const float* Strength;
};
void FindGroupFits(const FitLaw& law, const FitGroup& group, const FitNeighbours& neighbours,
  const WeightColumns& weights, GroupFits& fits);

struct NodeEllipsoid;

// Sums of strength (1 - d^2)^3 over ellipsoids at the group's places; the neighbours' places are
// the ellipsoids' centres.
void SumEllipsoids(const FitGroup& group, const FitNeighbours& neighbours,
  const NodeEllipsoid* ellipsoids, float (&sums)[8]);

// Sums as above, and their gradients.
struct PointSums
{
  alignas(32) float Sum[8];
  alignas(32) float Gradient[3][8];
};
void SumEllipsoids(const FitGroup& group, const FitNeighbours& neighbours,
  const NodeEllipsoid* ellipsoids, PointSums& sums);

// Sums over the neighbours at the group's places of weight * Share and of weight * Share * Lack.
struct ShareColumns
{
  const float* InverseWide2;
  const float* Share; // times the strength
  const float* Lack;
};
void SumShares(const FitGroup& group, const FitNeighbours& neighbours, const ShareColumns& columns,
  float (&shares)[8], float (&lacks)[8]);

}

#endif
