// Sums over particles at the nodes of a leaf, eight nodes or points side by side, in the order in
// which particles are added.

#ifndef NodeSums_h
#define NodeSums_h

#include "NodeTarget.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// dT Metric d = 1 [voxels], metric: xx xy xz yy yz zz; Extent: of its box, from the centre.
struct NodeEllipsoid
{
  float Metric[6];
  float Strength;
  float Extent[3];
};

// Columns have this many numbers more than there are particles.
constexpr std::size_t LanePadding = 8;

// Centres, relative to some origin, and squared reaches, of eight more than there are.
struct EllipsoidColumns
{
  const float *X, *Y, *Z, *Reach2;
};

// The potential 1 - (sum of strength (1 - d^2)^3)^(1/4) at the nodes of some rows of a leaf.
class EllipsoidSum
{
public:
  EllipsoidSum(std::uint64_t rows, float* values);

  // Adds ellipsoids first to end - 1. shift: from the first node of the leaf to the columns'
  // origin.
  void Add(const EllipsoidColumns& columns, const NodeEllipsoid* ellipsoids, std::uint32_t first,
    std::uint32_t end, const float (&shift)[3]);
  void Finish();

private:
  std::uint64_t Rows;
  float* Values;
};

struct MotionColumns
{
  const float* Place[3]; // relative to some origin
  const float* Displacement[3];
  const float* IsMoved; // 1, or 0 if the displacement is unknown
  const float* Bulk;
  const float* InverseReach2;
};

// Means of displacements and bulks at the points of a leaf. A mean displacement is less what may be
// the noise of the particles it is the mean of, by their spread.
class MotionSum
{
public:
  void Clear();
  void Add(
    const MotionColumns& columns, std::uint32_t first, std::uint32_t end, const float (&shift)[3]);
  void Finish(bool hasNoise, LeafMotion& motion) const;

private:
  struct Neighbour
  {
    float Place[3];
    float Displacement[3];
    float Square; // of the displacement
    float IsMoved;
    float Bulk;
    float InverseReach2;
  };
  struct Sums;
  struct SumKernel;

  std::vector<Neighbour> Near;
};

}

#endif
