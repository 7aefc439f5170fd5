/**
 * A target that is evaluated at the nodes of the lattice once per frame; see Nodes/NodeStep.h.
 */
#ifndef NodeTarget_h
#define NodeTarget_h

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

using NodeIndex = std::array<int, 3>;

/** Returns true if two indices are equal, without the call of memcmp by == of std::array. */
inline bool AreSame(const NodeIndex& a, const NodeIndex& b)
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/** Limit of |u| and |psi| in the node scheme [voxels; with NodeFreedom in its Unit]. */
constexpr float NodeLimit = 3.f;

/** A leaf of 8^3 nodes that the surface of the target may cross. A row is 8 nodes along z; row (x,
 * y) is bit 8 x + y. */
struct ShellLeaf
{
  NodeIndex Origin;         //< index of the leaf's first node
  std::uint64_t Rows;       //< rows in the shell
  std::uint64_t InsideRows; //< rows wholly inside the target; disjoint from Rows
};

/** Leaves near the surface of a target; every other leaf is on one side of the surface. */
struct Shell
{
  std::vector<ShellLeaf> Leaves;       //< ascending by origin (x, y, z)
  std::vector<NodeIndex> InsideLeaves; //< wholly inside, not in Leaves; only if wanted; any order
};

/** Motion of the target in a leaf, at 27 points 4 nodes apart: point 9 i + 3 j + k is (4 i, 4 j, 4
 * k) nodes from the leaf's origin. */
struct LeafMotion
{
  static constexpr int Points = 27;
  float Displacement[3][Points]; //< since NodeMotion::Begin, times Transport [voxels]
  float Bulk[Points];            //< in [0,1]: 1 in a body or if unknown, less around lone particles
  bool IsStill = true;           //< true only if no Displacement is noticeable
};

class Domain;

/** Interval of a motion of the target. */
struct NodeMotion
{
  double Begin, End; //< times of the band
  double Transport;  //< factor of displacements
  double VoxelSize;
  const Domain* Space = nullptr; //< partition among ranks; null: this rank owns all
};

/** Freedom of the skin around a target whose surface is uncertain by a pixel, for example a label
 * image. The skin stays where the potential of EvaluateLeaf is between -HalfWidth and HalfWidth. In
 * this range tension smooths the skin, without attraction. */
struct NodeFreedom
{
  float HalfWidth = 0.f; //< unit of that potential; 0: the skin is attracted everywhere
  /** Lower bound of the potential's slope [1/voxel]: in thin parts central differences give smaller
   * slopes. */
  float LeastSlope = 0.f;
  /** Unit of the distances in the stages [voxels], at least 1. Stages know distances up to
   * NodeLimit units from the target's surface. */
  float Unit = 1.f;
};

class NodeTarget
{
public:
  virtual ~NodeTarget() = default;

  /** Places the target at the end of a motion. Displacements are those since the beginning of the
   * motion. Called by one thread. If space is partitioned: collective, and results are valid only
   * in this rank's leaves; the side of a leaf (inside or outside) is also valid in neighbours of
   * these leaves. */
  virtual void PlaceNodes(const NodeMotion& motion) = 0;

  /** Finds the shell of the placed target, and the inside leaves if wanted. */
  virtual void FindShell(bool wantsInside, Shell& shell) const = 0;

  /** Returns true if a node outside the shell is inside the target. */
  virtual bool IsInside(const NodeIndex& node) const = 0;

  /** Writes a potential at the nodes of a leaf's Rows: negative inside, 0 at the target's surface,
   * nearly linear across the surface, 1 far outside the target. Thread-safe. */
  virtual void EvaluateLeaf(const ShellLeaf& leaf, float* values) const = 0;

  /** Writes the motion of the target in a leaf. Thread-safe. */
  virtual void FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const = 0;

  /** Amplitude of the noise of a body's surface [voxels], see property TargetNoise; 0: no noise. */
  virtual float GetNoise() const = 0;

  /** A surface that faces a wall is shifted onto the wall: wholly within this distance [voxels], at
   * most 2, partly up to 1.5 times the distance; 0: no shift. */
  virtual float GetWallGap() const = 0;

  virtual NodeFreedom GetFreedom() const { return {}; }
};

}

#endif
