/**
 * Distances near the zero set of a function.
 */
#ifndef InitialDistances_h
#define InitialDistances_h

#include "OpenVDB.h"

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
 * The nodes near the crossed ones get the function's first-order distance F/|grad F|, which is
 * smooth where F is, clamped to within half of OpenVDB's fast-sweeping distance around it. Sweeping
 * needs several times the memory of its input, so it is done slab by slab.
 *
 * Returns a tree of distances in voxels with background Far, inside tiles -Far; null if nothing is
 * inside. Clears the crossed nodes, because their memory is needed.
 */
openvdb::FloatTree::Ptr MakeNearbyDistances(CrossedNodes& crossed, const NodeFunction& function);

}

#endif
