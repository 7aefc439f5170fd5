/**
 * A function's zero set as distances near it.
 */
#ifndef InitialDistances_h
#define InitialDistances_h

#include <openvdb/openvdb.h>

#include <functional>
#include <vector>

namespace activesurface
{

/** The corners of the voxels that a surface crosses. */
struct CrossedNodes
{
  openvdb::BoolTree Nodes;
  double Largest = 0.0; //< largest finite |value| there
};

/** A function, negative inside, at nodes of the lattice. */
struct NodeFunction
{
  std::function<void(const std::vector<openvdb::Coord>& nodes, std::vector<double>& values)>
    Evaluate;
  bool ThreadSafe;
};

/**
 * The nodes near the crossed ones get OpenVDB's fast-sweeping distance, and within half of it
 * either way the function's own first-order distance F/|grad F|, which is smoother where F is
 * smooth. Sweeping takes several times the memory of what it sweeps, and goes slab by slab.
 *
 * Returns a tree of distances in voxels with background Far, inside tiles -Far; null if there is
 * nothing inside. The crossed nodes are gone then: their room is needed.
 */
openvdb::FloatTree::Ptr MakeNearbyDistances(CrossedNodes& crossed, const NodeFunction& function);

}

#endif
