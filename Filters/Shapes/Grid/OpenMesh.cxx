#include "Grid/OpenMesh.h"

#include "Base/OpenVDB.h"
#include "Grid/WindingNumber.h"
#include "Input/MeshTriangles.h"

#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/ValueAccessor.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace activesurface
{

namespace
{

using openvdb::Coord;
using openvdb::Vec3d;
using Nodes = std::vector<Coord>;

// 0.5 plus the error of dipoles; without this margin a large sheet would have spurious insides.
constexpr double Half = 0.51;
// Distance from the mesh up to which all nodes are evaluated [voxels].
constexpr float Near = 2.f;
constexpr double Known = 3.0;

Coord Step(int axis)
{
  Coord step(0);
  step[axis] = 1;
  return step;
}

// Winding numbers at all nodes near the mesh and near the caps of its holes.
class Caps
{
public:
  Caps(const MeshTriangles& mesh, double voxelSize);

  // Returns 1 outside and -1 inside, at every node.
  openvdb::FloatTree FindSigns() const;
  // Adds the caps as triangles, up to a voxel from the mesh.
  void AddTo(MeshTriangles& mesh) const;

private:
  using Reader = openvdb::tree::ValueAccessor<const openvdb::FloatTree>;

  void Evaluate(const Nodes& nodes);
  Nodes Grow(const Nodes& nodes);

  // Returns true if a cap separates two neighbours. The mesh separates only neighbours within a
  // voxel.
  static bool IsCut(const Coord& a, const Coord& b, const Reader& windings, const Reader& distances)
  {
    float x, y;
    return windings.probeValue(a, x) && windings.probeValue(b, y) && (x > Half) != (y > Half) &&
      std::max(distances.getValue(a), distances.getValue(b)) > 1.f;
  }

  const double VoxelSize;
  const WindingNumber Winding;
  const openvdb::FloatGrid::Ptr Distance;
  openvdb::FloatTree Windings; // active where they are computed
  openvdb::MaskTree Seen;
};

Caps::Caps(const MeshTriangles& mesh, double voxelSize)
  : VoxelSize(voxelSize)
  , Winding(mesh)
  , Distance(MakeMeshDistance(mesh, { voxelSize, Known, false }))
  , Windings(0.f)
{
  Nodes nodes;
  for (auto node = this->Distance->tree().cbeginValueOn(); node; ++node)
  {
    if (*node <= Near)
    {
      nodes.push_back(node.getCoord());
      this->Seen.setValueOn(node.getCoord());
    }
  }
  while (!nodes.empty())
  {
    this->Evaluate(nodes);
    nodes = this->Grow(nodes);
  }
}

void Caps::Evaluate(const Nodes& nodes)
{
  std::vector<float> values(nodes.size());
  tbb::parallel_for(std::size_t(0), nodes.size(),
    [&](std::size_t i)
    {
      const double winding = this->Winding.Evaluate(this->VoxelSize * nodes[i].asVec3d());
      values[i] = static_cast<float>(std::fabs(winding));
    });
  openvdb::tree::ValueAccessor<openvdb::FloatTree> windings(this->Windings);
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    windings.setValue(nodes[i], values[i]);
  }
}

// Returns the nodes around a cap that have not been visited.
Nodes Caps::Grow(const Nodes& nodes)
{
  const Reader windings(this->Windings), distances(this->Distance->tree());
  openvdb::tree::ValueAccessor<openvdb::MaskTree> seen(this->Seen);
  Nodes next;
  for (const Coord& node : nodes)
  {
    bool isCut = false;
    for (int side = 0; side < 6 && !isCut; ++side)
    {
      const Coord beside = side % 2 ? node - Step(side / 2) : node + Step(side / 2);
      isCut = IsCut(node, beside, windings, distances);
    }
    for (int n = 0; isCut && n < 125; ++n)
    {
      const Coord place = node.offsetBy(n / 25 - 2, n / 5 % 5 - 2, n % 5 - 2);
      if (!seen.isValueOn(place))
      {
        seen.setValueOn(place);
        next.push_back(place);
      }
    }
  }
  return next;
}

openvdb::FloatTree Caps::FindSigns() const
{
  openvdb::FloatTree signs(1.f);
  openvdb::tree::ValueAccessor<openvdb::FloatTree> writer(signs);
  for (auto node = this->Windings.cbeginValueOn(); node; ++node)
  {
    writer.setValue(node.getCoord(), *node > Half ? -1.f : 1.f);
  }
  openvdb::tools::signedFloodFillWithValues(signs, 1.f, -1.f);
  return signs;
}

// Surface nets: a point in each cell that a cap crosses, the mean of the crossings of the cell's
// edges, and a quadrangle around each such edge.
void Caps::AddTo(MeshTriangles& mesh) const
{
  const Reader windings(this->Windings), distances(this->Distance->tree());
  openvdb::Int32Tree cells(-1);
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> numbers(cells);
  const std::size_t first = mesh.Points.size();
  std::vector<Vec3d> sums;
  std::vector<double> counts;
  const auto add = [&](const Coord& cell, const Vec3d& crossing)
  {
    if (numbers.getValue(cell) < 0)
    {
      numbers.setValue(cell, static_cast<openvdb::Int32>(sums.size()));
      sums.emplace_back(0.0);
      counts.push_back(0.0);
    }
    const auto number = static_cast<std::size_t>(numbers.getValue(cell));
    sums[number] += crossing;
    counts[number] += 1.0;
    return static_cast<vtkIdType>(first) + static_cast<vtkIdType>(number);
  };
  for (auto node = this->Windings.cbeginValueOn(); node; ++node)
  {
    const Coord from = node.getCoord();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Coord to = from + Step(axis), u = Step((axis + 1) % 3), v = Step((axis + 2) % 3);
      if (IsCut(from, to, windings, distances))
      {
        Vec3d crossing = from.asVec3d();
        crossing[axis] += (Half - *node) / (windings.getValue(to) - *node);
        const vtkIdType a = add(from, crossing), b = add(from - u, crossing),
                        c = add(from - u - v, crossing), d = add(from - v, crossing);
        mesh.Triangles.push_back({ a, b, c });
        mesh.Triangles.push_back({ a, c, d });
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    const Vec3d place = this->VoxelSize / counts[i] * sums[i];
    mesh.Points.push_back({ place[0], place[1], place[2] });
  }
}

}

openvdb::FloatGrid::Ptr MakeOpenMeshDistance(
  const MeshTriangles& mesh, double voxelSize, double band)
{
  const Caps caps(mesh, voxelSize);
  const openvdb::FloatTree signs = caps.FindSigns();
  MeshTriangles closed = mesh;
  caps.AddTo(closed);
  openvdb::FloatGrid::Ptr distance = MakeMeshDistance(closed, { voxelSize, band, false });
  const openvdb::tree::ValueAccessor<const openvdb::FloatTree> sign(signs);
  for (auto node = distance->tree().beginValueOn(); node; ++node)
  {
    node.setValue(std::copysign(*node, sign.getValue(node.getCoord())));
  }
  openvdb::tools::signedFloodFill(distance->tree());
  return distance;
}

}
