/**
 * Where the surface still has to go: the nodes of a coarser lattice at which the surface and its
 * target are on different sides.
 *
 * A node of it is at (i,j,k) * GetSpacing(). Nodes are found from the surface on, as far as they
 * are connected along edges; so what they cost is the volume between the surface and the target.
 */
#ifndef DifferingNodes_h
#define DifferingNodes_h

#include "Leaves/LeafTable.h"
#include "OpenVDB.h"
#include "Target.h"

#include <openvdb/tree/ValueAccessor.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** The surface, its target, and the box in which the difference is looked for [world units]. */
struct ArrivalSearch
{
  const LeafTable& Leaves;
  const PotentialTree& Potential;
  double VoxelSize;
  const Target& Goal;
  std::array<double, 6> Bounds; // xmin xmax ymin ymax zmin zmax
};

/** Nodes that a lattice may have: a fraction of a second. One that would have more is coarser, by
 * factors of two up to this stride. */
constexpr std::size_t MostDifferingNodes = 400000;
constexpr int LargestStride = 8;

class DifferingNodes
{
public:
  static constexpr std::int32_t None = -1;

  struct Node
  {
    openvdb::Coord Place;
    bool IsInside;   //< of the surface, and so outside the target
    double Distance; //< |F|
  };

  /** stride: of the lattice, in voxels. No more nodes are found than `most`, or a few more. */
  DifferingNodes(const ArrivalSearch& search, int stride, std::size_t most);
  DifferingNodes(const DifferingNodes&) = delete; // the accessor is of this tree
  void operator=(const DifferingNodes&) = delete;

  /** Adds a node that was not found from the surface, and what is connected with it; false if it
   * was, or does not differ. */
  bool AddFrom(const openvdb::Coord& place);
  /** Those of these places that differ. */
  std::vector<openvdb::Coord> FindDiffering(const std::vector<openvdb::Coord>& places) const;

  /** At places where the surface and its target are both inside, or both outside, the smaller of
   * the two depths [voxels]; elsewhere -1. */
  std::vector<double> FindCommonDepths(
    const std::vector<openvdb::Coord>& places, bool areInside) const;

  std::size_t Size() const { return this->Nodes.size(); }
  const Node& operator[](std::size_t i) const { return this->Nodes[i]; }
  /** Whether there may be others, beyond the maximum. */
  bool IsCut() const { return this->Nodes.size() > this->Most; }

  /** True for a node on either side. */
  bool Has(const openvdb::Coord& place) { return this->Recent.getValue(place) >= 0; }
  /** The number of the next node along an axis that is on the same side, or None. */
  std::int32_t FindNext(std::size_t i, int axis, int sign);

  /** u at a node, at most its distance to the next one in magnitude [voxels]. */
  double PotentialAt(const openvdb::Coord& place) const;
  bool IsInside(const openvdb::Coord& place) const { return this->PotentialAt(place) < 0.0; }

  int GetStride() const { return this->Stride; }
  double GetSpacing() const { return this->Stride * this->Search.VoxelSize; }
  openvdb::Coord FindNearest(const double point[3]) const;

private:
  using Places = std::vector<openvdb::Coord>;

  double ValueAt(const openvdb::Coord& place) const
  {
    return this->Search.Potential.getValue(
      { place[0] * this->Stride, place[1] * this->Stride, place[2] * this->Stride });
  }

  Places FindNearSurface();
  bool Visit(const openvdb::Coord& place);
  void Flood(Places places);
  std::vector<double> EvaluateAt(const Places& places) const;
  bool Differs(const openvdb::Coord& place, double value) const
  {
    return !std::isnan(value) && (value < 0.0) != this->IsInside(place);
  }
  void AddDiffering(const Places& places, const std::vector<double>& values, Places& next);

  const ArrivalSearch Search;
  const int Stride;
  const std::size_t Most;
  openvdb::CoordBBox Limits;
  std::vector<Node> Nodes;
  openvdb::Int32Tree Numbers; // Unknown where not visited
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> Recent;
};

}

#endif
