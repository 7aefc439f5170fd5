/**
 * Sets of lattice nodes, stored as a mask per leaf: for example the nodes on one side of a
 * function.
 */
#ifndef LeafSigns_h
#define LeafSigns_h

#include "Base/OpenVDB.h"
#include "Base/TargetRegion.h"
#include "Leaves/LeafMask.h"

#include <openvdb/tree/ValueAccessor.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

struct LatticeBox;

inline openvdb::Coord OriginOfLeaf(const openvdb::Coord& node)
{
  return openvdb::Coord(node[0] & ~7, node[1] & ~7, node[2] & ~7);
}

inline int NumberInLeaf(const openvdb::Coord& node)
{
  return (node[0] & 7) << 6 | (node[1] & 7) << 3 | (node[2] & 7);
}

/** Leaves, numbered in the order of insertion, each with a mask of its nodes. Potentials do not
 * depend on the order. */
class LeafSigns
{
public:
  static constexpr std::int32_t None = -1;

  struct Leaf
  {
    openvdb::Coord Origin;
    LeafMask Nodes;
  };

  LeafSigns() = default;
  LeafSigns(const LeafSigns&) = delete; // the accessor belongs to this tree
  void operator=(const LeafSigns&) = delete;

  std::size_t Size() const { return this->Leaves.size(); }
  Leaf& operator[](std::size_t i) { return this->Leaves[i]; }
  const Leaf& operator[](std::size_t i) const { return this->Leaves[i]; }

  /** Returns the index of a leaf, or None. */
  std::int32_t Find(const openvdb::Coord& origin) const;

  bool Has(const openvdb::Coord& node) const;

  /** Adds a leaf without nodes unless the leaf exists. Returns the index of the leaf. */
  std::int32_t Add(const openvdb::Coord& origin);

  /** Adds the leaves of the smallest box of nodes that contains a region, within the limits. Throws
   * like RefuseManyLeaves. */
  void AddRegion(const TargetRegion& region, double voxelSize, const LatticeBox* limits,
    std::size_t maximumNumberOfActiveVoxels);

  /** Returns the index of the leaf across a face, or None. */
  std::int32_t FindNext(std::size_t i, int axis, int sign) const;
  openvdb::Coord OriginOfNext(std::size_t i, int axis, int sign) const;

private:
  std::vector<Leaf> Leaves;
  openvdb::Int32Tree Numbers{ None }; // at coordinates of leaves
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> Recent{ this->Numbers };
};

/** Throws std::runtime_error if the leaves have more than 40 nodes for each active voxel of the
 * maximum. This error ends the otherwise endless fill of a function that is negative everywhere.
 */
void RefuseManyLeaves(double leaves, std::size_t maximumNumberOfActiveVoxels);

}

#endif
