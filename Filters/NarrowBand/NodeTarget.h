/**
 * A target that is evaluated at the nodes of the lattice, once for each frame: see
 * Nodes/NodeStep.h.
 */
#ifndef NodeTarget_h
#define NodeTarget_h

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

using NodeIndex = std::array<int, 3>;

/** In place of ==, which calls memcmp. */
inline bool AreSame(const NodeIndex& a, const NodeIndex& b)
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/** A leaf of 8^3 nodes at which the surface of the target can be. A row is 8 nodes along z; row
 * (x, y) is bit 8 x + y. */
struct ShellLeaf
{
  NodeIndex Origin;         //< of its first node
  std::uint64_t Rows;       //< rows in the shell
  std::uint64_t InsideRows; //< rows that are inside the target as a whole; none of Rows
};

/** Leaves near the surface of a target; every other leaf is on one side of the surface. */
struct Shell
{
  std::vector<ShellLeaf> Leaves;       //< ascending by their origins (x, y, z)
  std::vector<NodeIndex> InsideLeaves; //< other leaves inside, in any order; if wanted
};

/** Motion of the target in a leaf, at 27 points that are 4 nodes apart: point 9 i + 3 j + k is at
 * the node (4 i, 4 j, 4 k) of the leaf. */
struct LeafMotion
{
  static constexpr int Points = 27;
  float Displacement[3][Points]; //< since the last frame [voxels]
  float Bulk[Points];            //< in [0,1], how much of a body of particles is around the point
  bool IsStill = true;           //< all displacements are 0
};

class Domain;

/** A motion of the target. */
struct NodeMotion
{
  double Begin, End; //< motion times
  double Transport;  //< factor of displacements
  double VoxelSize;
  const Domain* Space = nullptr; //< shared out to ranks; null: all is this rank's
};

class NodeTarget
{
public:
  virtual ~NodeTarget() = default;

  /** Places the target at the end of a motion; displacements are those since its begin. Called by
   * one thread; collective where space is shared out: what follows then holds in leaves of this
   * rank, and sides in those around them. */
  virtual void PlaceNodes(const NodeMotion& motion) = 0;

  /** Finds the shell of the placed target; and the leaves inside, if they are wanted. */
  virtual void FindShell(bool wantsInside, Shell& shell) const = 0;

  /** Returns true if a node outside the shell is inside the target. */
  virtual bool IsInside(const NodeIndex& node) const = 0;

  /** A potential at the nodes of a leaf's Rows, negative inside, with the zero set of the target;
   * nearly linear across it, 1 where nothing is near. Several threads may call it at once. */
  virtual void EvaluateLeaf(const ShellLeaf& leaf, float* values) const = 0;

  /** Several threads may call it at once. */
  virtual void FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const = 0;

  /** Distance within which the surface of a body is noise, see TargetNoise [voxels]; 0: none. */
  virtual float GetNoise() const = 0;
};

}

#endif
