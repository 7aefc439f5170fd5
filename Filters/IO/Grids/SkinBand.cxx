#include "Grids/SkinBand.h"

#include "Base/OpenVDB.h"
#include "NarrowBandGrid.h"
#include "Surface/Skin.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

using openvdb::Coord;
using openvdb::Vec3d;

struct Nearest
{
  std::int32_t Triangle = -1;
  double Square = std::numeric_limits<double>::infinity(); // squared distance to Triangle
  Vec3d Foot;
};

// Lookup of triangles by the voxel of their centroid. Each triangle of a skin lies in one voxel.
class TrianglesOfVoxels
{
public:
  explicit TrianglesOfVoxels(const LatticeMesh& mesh)
    : Mesh(mesh)
    , Next(mesh.Triangles.size(), -1)
  {
    openvdb::tree::ValueAccessor<openvdb::Int32Tree> first(this->First);
    for (std::size_t i = mesh.Triangles.size(); i-- > 0;)
    {
      const auto& t = mesh.Triangles[i];
      const Coord voxel =
        Coord::floor((mesh.Points[t[0]] + mesh.Points[t[1]] + mesh.Points[t[2]]) / 3.0);
      this->Next[i] = first.getValue(voxel);
      first.setValue(voxel, static_cast<std::int32_t>(i));
    }
  }

  const openvdb::Int32Tree& GetVoxels() const { return this->First; }

  using Reader = openvdb::tree::ValueAccessor<const openvdb::Int32Tree>;

  // Replaces `nearest` if the triangle is closer to the node.
  void Try(std::int32_t triangle, const Vec3d& node, Nearest& nearest) const
  {
    const auto& t = this->Mesh.Triangles[triangle];
    Vec3d weights;
    const Vec3d foot = openvdb::math::closestPointOnTriangleToPoint(
      this->Mesh.Points[t[0]], this->Mesh.Points[t[1]], this->Mesh.Points[t[2]], node, weights);
    const double square = (foot - node).lengthSqr();
    if (square < nearest.Square)
    {
      nearest = { triangle, square, foot };
    }
  }

  // Tries the triangles of those voxels in a box that are closer to the node than `nearest`.
  void TryBox(Reader& first, const Coord& lower, const Coord& upper, const Vec3d& node,
    Nearest& nearest) const
  {
    Coord voxel;
    for (voxel[0] = lower[0]; voxel[0] <= upper[0]; ++voxel[0])
    {
      const double x = SquareOfGap(voxel[0], node[0]);
      for (voxel[1] = lower[1]; voxel[1] <= upper[1]; ++voxel[1])
      {
        const double xy = x + SquareOfGap(voxel[1], node[1]);
        for (voxel[2] = lower[2]; voxel[2] <= upper[2]; ++voxel[2])
        {
          const bool isFar = xy + SquareOfGap(voxel[2], node[2]) >= nearest.Square;
          for (std::int32_t i = isFar ? -1 : first.getValue(voxel); i >= 0; i = this->Next[i])
          {
            this->Try(i, node, nearest);
          }
        }
      }
    }
  }

  // Moves to closer triangles around the foot point until no triangle is closer.
  void Descend(Reader& first, const Vec3d& node, Nearest& nearest) const
  {
    Coord last = Coord::max();
    for (Coord voxel = Coord::floor(nearest.Foot); voxel != last;
         voxel = Coord::floor(nearest.Foot))
    {
      last = voxel;
      this->TryBox(first, voxel.offsetBy(-1), voxel.offsetBy(1), node, nearest);
    }
  }

  // Squared distance of a coordinate from a voxel along one axis.
  static double SquareOfGap(int voxel, double x)
  {
    const double gap = std::max({ voxel - x, x - voxel - 1.0, 0.0 });
    return gap * gap;
  }

private:
  const LatticeMesh& Mesh;
  openvdb::Int32Tree First{ -1 };
  std::vector<std::int32_t> Next; // in the same voxel
};

using Layer = std::vector<Coord>;

// Corners of the voxels that contain triangles.
Layer FindFirstLayer(const openvdb::Int32Tree& voxels)
{
  openvdb::MaskTree nodes;
  openvdb::tree::ValueAccessor<openvdb::MaskTree> mask(nodes);
  for (auto voxel = voxels.cbeginValueOn(); voxel; ++voxel)
  {
    for (int c = 0; c < 8; ++c)
    {
      mask.setValueOn(voxel.getCoord().offsetBy(c >> 2, c >> 1 & 1, c & 1));
    }
  }
  Layer layer;
  for (auto node = nodes.cbeginValueOn(); node; ++node)
  {
    layer.push_back(node.getCoord());
  }
  return layer;
}

// Grows layers of nodes from the skin to the distance HalfWidth.
class Growth
{
public:
  Growth(const NarrowBand& band, const TrianglesOfVoxels& triangles, MeshBand& result)
    : Band(band)
    , Triangles(triangles)
    , Result(result)
  {
  }

  void Run()
  {
    Layer layer = FindFirstLayer(this->Triangles.GetVoxels());
    bool isFirst = true;
    while (!layer.empty())
    {
      const std::vector<Nearest> found = this->Find(layer, isFirst);
      layer = this->Grow(this->Store(layer, found));
      isFirst = false;
    }
    openvdb::tools::signedFloodFill(this->Result.Distances->tree());
  }

private:
  std::vector<Nearest> Find(const Layer& layer, bool isFirst) const
  {
    std::vector<Nearest> found(layer.size());
    constexpr std::size_t grain = 256;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, layer.size(), grain),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        TrianglesOfVoxels::Reader voxels(this->Triangles.GetVoxels());
        TrianglesOfVoxels::Reader known(this->Result.Triangles->tree());
        for (std::size_t i = range.begin(); i < range.end(); ++i)
        {
          const Vec3d node = layer[i].asVec3d();
          if (isFirst)
          {
            this->Triangles.TryBox(voxels, layer[i].offsetBy(-1), layer[i], node, found[i]);
          }
          else
          {
            this->TryNeighbours(known, layer[i], found[i]);
          }
          this->Triangles.Descend(voxels, node, found[i]);
        }
      });
    return found;
  }

  void TryNeighbours(TrianglesOfVoxels::Reader& known, const Coord& place, Nearest& nearest) const
  {
    const Vec3d node = place.asVec3d();
    std::int32_t last = -1;
    for (int n = 0; n < 27; ++n)
    {
      const std::int32_t triangle =
        known.getValue(place.offsetBy(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1));
      if (triangle >= 0 && triangle != last)
      {
        this->Triangles.Try(triangle, node, nearest);
        last = triangle;
      }
    }
  }

  // Stores and returns the nodes of a layer that are within HalfWidth of the skin.
  Layer Store(const Layer& layer, const std::vector<Nearest>& found)
  {
    const openvdb::FloatGrid::ConstPtr band = GetPotential(this->Band);
    auto potential = band->getConstUnsafeAccessor();
    auto distances = this->Result.Distances->getAccessor();
    auto triangles = this->Result.Triangles->getAccessor();
    Layer stored;
    for (std::size_t i = 0; i < layer.size(); ++i)
    {
      const auto distance = static_cast<float>(std::sqrt(found[i].Square));
      if (distance < HalfWidth)
      {
        distances.setValue(layer[i], potential.getValue(layer[i]) < 0.f ? -distance : distance);
        triangles.setValue(layer[i], found[i].Triangle);
        stored.push_back(layer[i]);
      }
    }
    return stored;
  }

  // Returns all neighbours of the layer's nodes except visited neighbours.
  Layer Grow(const Layer& layer)
  {
    auto known = this->Result.Triangles->getConstUnsafeAccessor();
    openvdb::tree::ValueAccessor<openvdb::MaskTree> seen(this->Seen);
    Layer next;
    for (const Coord& node : layer)
    {
      for (int side = 0; side < 6; ++side)
      {
        Coord beside = node;
        beside[side >> 1] += side & 1 ? 1 : -1;
        if (!known.isValueOn(beside) && !seen.isValueOn(beside))
        {
          seen.setValueOn(beside);
          next.push_back(beside);
        }
      }
    }
    return next;
  }

  const NarrowBand& Band;
  const TrianglesOfVoxels& Triangles;
  MeshBand& Result;
  openvdb::MaskTree Seen; // visited nodes, except those of the first layer
};

template <class Number>
LatticeMesh Collect(const Skin& skin, double voxelSize)
{
  LatticeMesh mesh;
  if (skin.GetNumberOfTriangles() == 0)
  {
    return mesh;
  }
  std::vector<Number> points(3 * skin.GetNumberOfPoints());
  mesh.Triangles.resize(skin.GetNumberOfTriangles());
  mesh.Points.reserve(skin.GetNumberOfPoints());
  static_assert(sizeof(mesh.Triangles[0]) == 3 * sizeof(std::int64_t),
    "Write writes three integers for each triangle");
  skin.Write(points.data(), nullptr, mesh.Triangles.data()->data());
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    mesh.Points.emplace_back(
      points[i] / voxelSize, points[i + 1] / voxelSize, points[i + 2] / voxelSize);
  }
  return mesh;
}

}

LatticeMesh MakeSkinMesh(const NarrowBand& band)
{
  const Skin skin(band);
  return skin.NeedsDoublePrecision() ? Collect<double>(skin, band.GetVoxelSize())
                                     : Collect<float>(skin, band.GetVoxelSize());
}

MeshBand MakeSkinBand(const NarrowBand& band, const LatticeMesh& mesh)
{
  MeshBand result;
  result.Distances = openvdb::FloatGrid::create(HalfWidth);
  result.Triangles = openvdb::Int32Grid::create(openvdb::Int32(MeshBand::NoTriangle));
  band.Run(
    [&]
    {
      const TrianglesOfVoxels triangles(mesh);
      Growth(band, triangles, result).Run();
    });
  return result;
}

}
