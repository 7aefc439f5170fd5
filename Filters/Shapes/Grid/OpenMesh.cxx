#include "Grid/OpenMesh.h"

#include "Base/OpenVDB.h"
#include "Input/MeshTriangles.h"

#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/ValueAccessor.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace activesurface
{

namespace
{

// Winding number of a mesh, with or without holes, around a point.
//
// A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside Segmentation using Generalized
// Winding Numbers, SIGGRAPH 2013; far triangles as dipoles after G. Barill et al., Fast Winding
// Numbers for Soups and Clouds, SIGGRAPH 2018.
class WindingNumber
{
public:
  // The mesh has to outlive this object.
  explicit WindingNumber(const MeshTriangles& mesh);

  // Returns about 1 inside a closed mesh (n where n bodies overlap), or about -1 (-n) if the
  // polygons face inward; 0 outside. Across a hole the value changes smoothly.
  // Thread-safe; the result does not depend on the number of threads.
  double Evaluate(const openvdb::Vec3d& place) const;

private:
  struct Box
  {
    std::size_t First, Last; // of its triangles, in Order
    std::size_t Next;        // next box that is not inside this one
    openvdb::Vec3d Centre;   // weighted by area
    openvdb::Vec3d Area;     // sum of the area vectors
    double Radius;           // around the centre
  };

  openvdb::Vec3d GetCorner(std::size_t triangle, std::size_t corner) const;
  void Add(std::size_t first, std::size_t last);
  void Measure(Box& box) const;
  double SolidAngle(const openvdb::Vec3d& place, std::size_t triangle) const;

  const MeshTriangles& Mesh;
  std::vector<std::size_t> Order; // of the triangles
  std::vector<openvdb::Vec3d> Middles;
  std::vector<Box> Boxes; // each before the boxes inside it
};

constexpr std::size_t TrianglesOfLeaf = 8;

// Beyond this distance from a box's centre [radii of the box], one dipole replaces the box's
// triangles. The error of a winding number is below 0.01.
constexpr double FarInRadii = 2.5;
constexpr double Sphere = 4.0 * 3.14159265358979323846;

WindingNumber::WindingNumber(const MeshTriangles& mesh)
  : Mesh(mesh)
  , Order(mesh.Triangles.size())
{
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  for (std::size_t i = 0; i < this->Order.size(); ++i)
  {
    this->Middles.push_back(
      (this->GetCorner(i, 0) + this->GetCorner(i, 1) + this->GetCorner(i, 2)) / 3.0);
  }
  this->Add(0, this->Order.size());
}

openvdb::Vec3d WindingNumber::GetCorner(std::size_t triangle, std::size_t corner) const
{
  return openvdb::Vec3d(this->Mesh.Points[this->Mesh.Triangles[triangle][corner]].data());
}

void WindingNumber::Add(std::size_t first, std::size_t last)
{
  const std::size_t own = this->Boxes.size();
  this->Boxes.push_back({ first, last, 0, {}, {}, 0.0 });
  this->Measure(this->Boxes.back());
  if (last - first > TrianglesOfLeaf)
  {
    openvdb::BBoxd box;
    for (std::size_t i = first; i < last; ++i)
    {
      box.expand(this->Middles[this->Order[i]]);
    }
    const std::size_t axis = box.maxExtent();
    const std::size_t half = first + (last - first) / 2;
    const auto begin = this->Order.begin();
    std::nth_element(begin + first, begin + half, begin + last,
      [this, axis](std::size_t a, std::size_t b)
      {
        const double x = this->Middles[a][axis], y = this->Middles[b][axis];
        return x < y || (x == y && a < b);
      });
    this->Add(first, half);
    this->Add(half, last);
  }
  this->Boxes[own].Next = this->Boxes.size();
}

void WindingNumber::Measure(Box& box) const
{
  double whole = 0.0;
  for (std::size_t i = box.First; i < box.Last; ++i)
  {
    const std::size_t n = this->Order[i];
    const openvdb::Vec3d a = this->GetCorner(n, 0);
    const openvdb::Vec3d area = 0.5 * (this->GetCorner(n, 1) - a).cross(this->GetCorner(n, 2) - a);
    box.Area += area;
    box.Centre += area.length() * this->Middles[n];
    whole += area.length();
  }
  box.Centre = whole > 0.0 ? box.Centre / whole : this->Middles[this->Order[box.First]];
  for (std::size_t i = box.First; i < box.Last; ++i)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const double away = (this->GetCorner(this->Order[i], corner) - box.Centre).length();
      box.Radius = std::max(box.Radius, away);
    }
  }
}

// A. van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, 1983.
double WindingNumber::SolidAngle(const openvdb::Vec3d& place, std::size_t triangle) const
{
  const openvdb::Vec3d a = this->GetCorner(triangle, 0) - place,
                       b = this->GetCorner(triangle, 1) - place,
                       c = this->GetCorner(triangle, 2) - place;
  const double la = a.length(), lb = b.length(), lc = c.length();
  return 2.0 *
    std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

double WindingNumber::Evaluate(const openvdb::Vec3d& place) const
{
  double angle = 0.0;
  for (std::size_t i = 0; i < this->Boxes.size();)
  {
    const Box& box = this->Boxes[i];
    const openvdb::Vec3d away = box.Centre - place;
    const double distance = away.length();
    if (distance > FarInRadii * box.Radius)
    {
      angle += box.Area.dot(away) / (distance * distance * distance);
      i = box.Next;
      continue;
    }
    const bool isLeaf = box.Last - box.First <= TrianglesOfLeaf;
    for (std::size_t n = box.First; isLeaf && n < box.Last; ++n)
    {
      angle += this->SolidAngle(place, this->Order[n]);
    }
    ++i;
  }
  return angle / Sphere;
}

using openvdb::Coord;
using openvdb::Vec3d;
using Nodes = std::vector<Coord>;

// Winding number above which a point is inside: 0.5 plus the error of dipoles. Without this margin,
// points near a large sheet could count as inside.
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

// Magnitudes of the winding numbers at all nodes near the mesh and near the caps of its holes.
class Caps
{
public:
  Caps(const MeshTriangles& mesh, double voxelSize);

  // Returns 1 outside and -1 inside, at every node.
  openvdb::FloatTree FindSigns() const;
  // Adds the caps as triangles. A cap ends about a voxel from the mesh.
  void AddTo(MeshTriangles& mesh) const;

private:
  using Reader = openvdb::tree::ValueAccessor<const openvdb::FloatTree>;

  void Evaluate(const Nodes& nodes);
  Nodes Grow(const Nodes& nodes);

  // Returns true if a cap separates two neighbour nodes. The mesh itself separates only nodes that
  // are both within a voxel of the mesh.
  static bool IsCut(const Coord& a, const Coord& b, const Reader& windings, const Reader& distances)
  {
    float x, y;
    return windings.probeValue(a, x) && windings.probeValue(b, y) && (x > Half) != (y > Half) &&
      std::max(distances.getValue(a), distances.getValue(b)) > 1.f;
  }

  const double VoxelSize;
  const WindingNumber Winding;
  const openvdb::FloatGrid::Ptr Distance;
  openvdb::FloatTree Windings; // active where computed
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

// Returns the unvisited nodes near the caps: up to two steps along each axis from a node of `nodes`
// that is next to a cap.
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

// Adds caps as surface nets. Each cell that a cap crosses has a point, the mean of the crossings of
// the cell's edges. Each crossed edge has a quadrangle around it.
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
