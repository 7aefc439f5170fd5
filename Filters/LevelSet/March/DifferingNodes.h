/**
 * Nodes of a lattice that are inside the surface and outside its target, or the reverse: there the
 * surface still has to move. The lattice's spacing is GetStride() voxels.
 *
 * Node (i,j,k) is at (i,j,k) * GetSpacing(). The search starts at the surface and follows connected
 * nodes along edges. The cost is proportional to the volume between the surface and the target.
 */
#ifndef DifferingNodes_h
#define DifferingNodes_h

#include "Base/OpenVDB.h"
#include "Base/Target.h"
#include "Leaves/LeafTable.h"

#include <openvdb/tree/ValueAccessor.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** The surface, its target, and the box of the search [world units]. */
struct ArrivalSearch
{
  const LeafTable& Leaves;
  const PotentialTree& Potential;
  double VoxelSize;
  const activesurface::Target& Target;
  std::array<double, 6> Bounds; // xmin xmax ymin ymax zmin zmax
};

/** Maximum number of differing nodes; a search that finds this number takes a fraction of a second.
 * If more nodes differ, the lattice is coarsened by factors of two, up to a spacing of
 * LargestStride voxels. */
constexpr std::size_t MostDifferingNodes = 400000;
constexpr int LargestStride = 8;

class DifferingNodes
{
public:
  static constexpr std::int32_t None = -1;

  struct Node
  {
    openvdb::Coord Place;
    bool IsInside;   //< inside the surface, and therefore outside the target
    double Distance; //< |F|
  };

  /** stride: spacing of the lattice [voxels]. The search advances front by front, and stops after
   * the front that exceeds `most` nodes. */
  DifferingNodes(const ArrivalSearch& search, int stride, std::size_t most);
  DifferingNodes(const DifferingNodes&) = delete; // the accessor belongs to this tree
  void operator=(const DifferingNodes&) = delete;

  /** Adds a differing node that was not found from the surface, and all differing nodes connected
   * with this node. Returns false if the node was found before, does not differ or is out of
   * bounds, or if IsCut. */
  bool AddFrom(const openvdb::Coord& place);
  /** Returns the given nodes that differ. */
  std::vector<openvdb::Coord> FindDiffering(const std::vector<openvdb::Coord>& places) const;

  /** Returns the smaller of the depths in surface and target [voxels] at nodes that are inside both
   * (areInside) or outside both (not areInside); -1 at other nodes and out of bounds. */
  std::vector<double> FindCommonDepths(
    const std::vector<openvdb::Coord>& places, bool areInside) const;

  std::size_t Size() const { return this->Nodes.size(); }
  const Node& operator[](std::size_t i) const { return this->Nodes[i]; }
  /** Returns true if nodes may be missing because the maximum was exceeded. */
  bool IsCut() const { return this->Nodes.size() > this->Most; }

  /** Returns true for a differing node, on either side. */
  bool Has(const openvdb::Coord& place) { return this->Recent.getValue(place) >= 0; }
  /** Returns the index of the next node along an axis if that node differs on the same side,
   * otherwise None. */
  std::int32_t FindNext(std::size_t i, int axis, int sign);

  /** Returns u at a node [voxels], clamped to +-GetStride(). */
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
  openvdb::Int32Tree Numbers; // Unknown at unvisited nodes
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> Recent;
};

}

#endif
