/**
 * Distances near the zero set of a function.
 */
#ifndef InitialDistances_h
#define InitialDistances_h

#include "Base/OpenVDB.h"

#include <functional>
#include <vector>

namespace activesurface
{

/** The corners of the voxels that a surface crosses. */
struct CrossedNodes
{
  openvdb::BoolTree Nodes;
  double Largest = 0.0; //< largest finite |value| at the nodes
};

/** A function, negative inside, at nodes of the lattice. */
struct NodeFunction
{
  std::function<void(const std::vector<openvdb::Coord>& nodes, std::vector<double>& values)>
    Evaluate;
  bool ThreadSafe;
};

/**
 * Sets the nodes near the crossed nodes to the function's first-order distance F/|grad F|, which is
 * smooth where F is smooth. This distance is clamped to 0.5 to 1.5 times OpenVDB's fast-sweeping
 * distance. Sweeping needs several times the memory of its input, so the sweeping is done slab by
 * slab.
 *
 * Returns a tree of distances [voxels] with background Far and inside tiles -Far; null if no value
 * is clearly negative (HasInside). Clears the crossed nodes to free their memory.
 */
openvdb::FloatTree::Ptr MakeNearbyDistances(CrossedNodes& crossed, const NodeFunction& function);

}

#endif
