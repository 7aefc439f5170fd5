#include "Surface/PointsOutside.h"

#include "Base/CubeTriangles.h"
#include "Base/OpenVDB.h"
#include "Base/Trilinear.h"
#include "NarrowBandGrid.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/tree/ValueAccessor.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace activesurface
{

namespace
{

using openvdb::Coord;
using openvdb::Vec3d;
using Tree = openvdb::FloatTree;

// Not registered with the tree, so each task can create an accessor cheaply.
using Reader = openvdb::tree::ValueAccessor<const Tree, false>;

constexpr unsigned AllInside = 255;

/** u at the corners of a voxel. */
struct VoxelCorners
{
  double U[CornersOfVoxel];
  unsigned Inside = 0; //< one bit per corner

  VoxelCorners(Reader& potential, const Coord& lower)
  {
    for (int c = 0; c < CornersOfVoxel; ++c)
    {
      this->U[c] = potential.getValue(lower.offsetBy(c >> 2, c >> 1 & 1, c & 1));
      this->Inside |= this->U[c] < 0.0 ? 1u << c : 0u;
    }
  }

  bool IsCrossed() const { return this->Inside != 0 && this->Inside != AllInside; }

  /** Position of the surface on an edge, from the lower corner. */
  Vec3d GetVertex(int edge) const
  {
    const int lower = LowerCornerOfEdge[edge], axis = AxisOfEdge(edge);
    Vec3d at(lower >> 2, lower >> 1 & 1, lower & 1);
    at[axis] += this->U[lower] / (this->U[lower] - this->U[UpperCornerOfEdge(edge)]);
    return at;
  }

  /** Returns true if a triangle of the skin in this voxel is within the distance [voxels] of
   * `place`. place: relative to the lower corner [voxels]. */
  bool HasTriangleWithin(const Vec3d& place, double distance) const
  {
    const VoxelTriangles& triangles = TrianglesOfVoxel(this->Inside);
    for (int t = 0; t < triangles.Count; ++t)
    {
      const std::uint8_t* edge = triangles.Edge[t];
      Vec3d weights;
      const Vec3d foot = openvdb::math::closestPointOnTriangleToPoint(this->GetVertex(edge[0]),
        this->GetVertex(edge[1]), this->GetVertex(edge[2]), place, weights);
      if ((foot - place).lengthSqr() <= distance * distance)
      {
        return true;
      }
    }
    return false;
  }
};

/** Searches the potential of a band, for one task. */
class SkinSearch
{
public:
  /** leaves: box of all leaves, which contains all triangles. */
  SkinSearch(const NarrowBand& band, const openvdb::CoordBBox& leaves)
    : VoxelSize(band.GetVoxelSize())
    , Leaves(leaves)
    , Potential(GetPotential(band)->constTree())
  {
  }

  bool IsOutside(const PointWithMargin& point)
  {
    const Vec3d place = Vec3d(point.Position) / this->VoxelSize;
    const double margin = point.Margin / this->VoxelSize;
    if (!place.isFinite() || !std::isfinite(margin))
    {
      return false;
    }
    constexpr double farthest = 1e9; // node coordinates are 32-bit integers
    const Vec3d voxel(std::floor(place[0]), std::floor(place[1]), std::floor(place[2]));
    if (voxel.length() < farthest && this->IsInside(Coord(openvdb::Vec3i(voxel)), place))
    {
      return false;
    }
    return !this->IsNear(this->FindVoxels(place, margin), place, margin);
  }

private:
  /** Returns the box of the voxels that reach within the margin of `place` along each axis, by
   * their lower corners, clipped to the box of all leaves. */
  openvdb::CoordBBox FindVoxels(const Vec3d& place, double margin) const
  {
    openvdb::CoordBBox voxels;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double least = this->Leaves.min()[axis], most = this->Leaves.max()[axis];
      const double low = std::floor(place[axis] - margin);
      const double high = std::floor(place[axis] + margin);
      if (low > most || high < least)
      {
        return {};
      }
      voxels.min()[axis] = static_cast<int>(std::max(low, least));
      voxels.max()[axis] = static_cast<int>(std::min(high, most));
    }
    return voxels;
  }

  bool IsInside(const Coord& voxel, const Vec3d& place)
  {
    const VoxelCorners corners(this->Potential, voxel);
    const Vec3d from = place - voxel.asVec3d();
    return corners.IsCrossed() ? Trilinear(corners.U, from.asPointer(), nullptr) < 0.0
                               : corners.Inside == AllInside;
  }

  bool IsNear(const openvdb::CoordBBox& voxels, const Vec3d& place, double margin)
  {
    if (voxels.empty())
    {
      return false;
    }
    for (const Coord& number : openvdb::CoordBBox(voxels.min() >> 3, voxels.max() >> 3))
    {
      const Coord origin = number << 3;
      openvdb::CoordBBox part = openvdb::CoordBBox::createCube(origin, 8);
      part.intersect(voxels);
      if (this->Potential.probeConstLeaf(origin) && this->HasTriangle(part, place, margin))
      {
        return true;
      }
    }
    return false;
  }

  bool HasTriangle(const openvdb::CoordBBox& voxels, const Vec3d& place, double margin)
  {
    for (const Coord& voxel : voxels)
    {
      const VoxelCorners corners(this->Potential, voxel);
      if (corners.IsCrossed() && corners.HasTriangleWithin(place - voxel.asVec3d(), margin))
      {
        return true;
      }
    }
    return false;
  }

  const double VoxelSize;
  const openvdb::CoordBBox Leaves;
  Reader Potential;
};

}

std::size_t CountOutside(const NarrowBand& band, const std::vector<PointWithMargin>& points)
{
  std::size_t count = 0;
  openvdb::CoordBBox leaves;
  GetPotential(band)->constTree().evalLeafBoundingBox(leaves);
  const auto countRange = [&](const tbb::blocked_range<std::size_t>& range, std::size_t before)
  {
    SkinSearch search(band, leaves);
    for (std::size_t i = range.begin(); i != range.end(); ++i)
    {
      before += search.IsOutside(points[i]) ? 1 : 0;
    }
    return before;
  };
  band.Run(
    [&]
    {
      count = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, points.size(), 256),
        std::size_t(0), countRange, std::plus<std::size_t>());
    });
  return count;
}

}
