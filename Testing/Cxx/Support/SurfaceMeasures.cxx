#include "Support/SurfaceMeasures.h"

#include "NarrowBandGrid.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace activesurface
{
namespace
{
constexpr double DegreesPerRadian = 57.29577951308232;

Point ReadPoint(const std::vector<float>& values, std::size_t i)
{
  return { values[3 * i], values[3 * i + 1], values[3 * i + 2] };
}

double Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Point Minus(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Length(const Point& a)
{
  return std::sqrt(Dot(a, a));
}

// Six times the volume between a triangle and the origin.
double GetSixVolumes(const Mesh& mesh, std::size_t triangle)
{
  return Dot(mesh.GetPoint(mesh.Corners[3 * triangle]), mesh.GetAreaVector(triangle));
}

using HalfEdge = std::pair<std::int64_t, std::int64_t>;

std::vector<HalfEdge> SortHalfEdges(const Mesh& mesh)
{
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.Corners.size());
  for (std::size_t i = 0; i < mesh.Corners.size(); ++i)
  {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    edges.emplace_back(mesh.Corners[i], mesh.Corners[next]);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::size_t CountBadEdges(const Mesh& mesh)
{
  const std::vector<HalfEdge> edges = SortHalfEdges(mesh);
  std::size_t bad = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const HalfEdge opposite(edges[i].second, edges[i].first);
    const bool repeated = i > 0 && edges[i] == edges[i - 1];
    bad += repeated || !std::binary_search(edges.begin(), edges.end(), opposite);
  }
  return bad;
}

// For each vertex, the other two corners of each of its triangles, in the orientation of the
// triangle.
std::vector<std::vector<HalfEdge>> GetFans(const Mesh& mesh)
{
  std::vector<std::vector<HalfEdge>> fans(mesh.GetNumberOfPoints());
  for (std::size_t i = 0; i < mesh.Corners.size(); i += 3)
  {
    for (int k = 0; k < 3; ++k)
    {
      fans.at(mesh.Corners[i + k])
        .emplace_back(mesh.Corners[i + (k + 1) % 3], mesh.Corners[i + (k + 2) % 3]);
    }
  }
  return fans;
}

bool IsOneClosedFan(const std::vector<HalfEdge>& fan)
{
  const std::map<std::int64_t, std::int64_t> next(fan.begin(), fan.end());
  std::size_t length = 0;
  std::int64_t other = fan.front().first;
  do
  {
    const auto found = next.find(other);
    if (found == next.end())
    {
      return false;
    }
    other = found->second;
    ++length;
  } while (other != fan.front().first && length <= fan.size());
  return length == fan.size();
}

// For each vertex, a vertex that represents its connected part of the mesh.
std::vector<std::int64_t> FindParts(const Mesh& mesh)
{
  std::vector<std::int64_t> parent(mesh.GetNumberOfPoints());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](std::int64_t vertex)
  {
    while (parent[vertex] != vertex)
    {
      vertex = parent[vertex] = parent[parent[vertex]];
    }
    return vertex;
  };
  for (std::size_t i = 0; i < mesh.Corners.size(); i += 3)
  {
    parent[find(mesh.Corners[i])] = find(mesh.Corners[i + 1]);
    parent[find(mesh.Corners[i + 1])] = find(mesh.Corners[i + 2]);
  }
  for (std::size_t vertex = 0; vertex < parent.size(); ++vertex)
  {
    parent[vertex] = find(static_cast<std::int64_t>(vertex));
  }
  return parent;
}

Range GetRange(const std::vector<double>& values)
{
  Range range;
  if (!values.empty())
  {
    const auto [minimum, maximum] = std::minmax_element(values.begin(), values.end());
    range.Minimum = *minimum;
    range.Maximum = *maximum;
    range.Mean = std::accumulate(values.begin(), values.end(), 0.0) / values.size();
  }
  return range;
}

Point GetNodeGradient(
  const openvdb::FloatGrid::ConstAccessor& potential, const openvdb::Coord& node)
{
  Point gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    openvdb::Coord before = node;
    openvdb::Coord after = node;
    before[axis] -= 1;
    after[axis] += 1;
    gradient[axis] = 0.5 * (double(potential.getValue(after)) - potential.getValue(before));
  }
  return gradient;
}

// Norm of the gradient at the linear crossing of an edge, interpolated between the edge's nodes.
double GetCrossingSlope(const openvdb::FloatGrid::ConstAccessor& potential,
  const openvdb::Coord& lower, const openvdb::Coord& upper)
{
  const double value = potential.getValue(lower);
  const double fraction = value / (value - potential.getValue(upper));
  const Point first = GetNodeGradient(potential, lower);
  const Point second = GetNodeGradient(potential, upper);
  Point gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    gradient[axis] = (1.0 - fraction) * first[axis] + fraction * second[axis];
  }
  return Length(gradient);
}
}

Point Mesh::GetPoint(std::size_t vertex) const
{
  return ReadPoint(this->Points, vertex);
}

Point Mesh::GetNormal(std::size_t vertex) const
{
  return ReadPoint(this->Normals, vertex);
}

Point Mesh::GetAreaVector(std::size_t triangle) const
{
  const Point first = this->GetPoint(this->Corners[3 * triangle]);
  const Point second = this->GetPoint(this->Corners[3 * triangle + 1]);
  const Point third = this->GetPoint(this->Corners[3 * triangle + 2]);
  return Cross(Minus(second, first), Minus(third, first));
}

Mesh Polygonise(const NarrowBand& band)
{
  const Skin skin(band);
  Mesh mesh;
  mesh.Points.resize(3 * skin.GetNumberOfPoints());
  mesh.Normals.resize(3 * skin.GetNumberOfPoints());
  mesh.Corners.resize(3 * skin.GetNumberOfTriangles());
  skin.Write(mesh.Points.data(), mesh.Normals.data(), mesh.Corners.data());
  return mesh;
}

double GetArea(const Mesh& mesh)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.GetNumberOfTriangles(); ++t)
  {
    area += 0.5 * Length(mesh.GetAreaVector(t));
  }
  return area;
}

double GetVolume(const Mesh& mesh)
{
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.GetNumberOfTriangles(); ++t)
  {
    volume += GetSixVolumes(mesh, t) / 6.0;
  }
  return volume;
}

MeshDefects FindDefects(const Mesh& mesh)
{
  MeshDefects defects;
  defects.Edges = CountBadEdges(mesh);
  for (const std::vector<HalfEdge>& fan : GetFans(mesh))
  {
    defects.Unused += fan.empty();
    defects.Vertices += !fan.empty() && !IsOneClosedFan(fan);
  }
  return defects;
}

Topology GetTopology(const Mesh& mesh)
{
  const std::vector<std::int64_t> parts = FindParts(mesh);
  std::map<std::int64_t, double> volumes;
  for (std::size_t t = 0; t < mesh.GetNumberOfTriangles(); ++t)
  {
    volumes[parts[mesh.Corners[3 * t]]] += GetSixVolumes(mesh, t);
  }
  Topology topology;
  for (const auto& [part, volume] : volumes)
  {
    ++(volume > 0.0 ? topology.Components : topology.Voids);
  }
  // A closed mesh of F triangles has 3 F / 2 edges.
  topology.EulerCharacteristic =
    static_cast<int>(mesh.GetNumberOfPoints()) - static_cast<int>(mesh.GetNumberOfTriangles() / 2);
  return topology;
}

Range GetRadii(const Mesh& mesh, const Point& centre)
{
  std::vector<double> radii;
  for (std::size_t vertex = 0; vertex < mesh.GetNumberOfPoints(); ++vertex)
  {
    radii.push_back(Length(Minus(mesh.GetPoint(vertex), centre)));
  }
  return GetRange(radii);
}

Range GetSlopes(const NarrowBand& band)
{
  const openvdb::FloatGrid::ConstPtr grid = GetPotential(band);
  const openvdb::FloatGrid::ConstAccessor potential = grid->getConstAccessor();
  std::vector<double> slopes;
  for (auto node = grid->cbeginValueOn(); node; ++node)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      openvdb::Coord upper = node.getCoord();
      upper[axis] += 1;
      if ((*node < 0.f) != (potential.getValue(upper) < 0.f))
      {
        slopes.push_back(GetCrossingSlope(potential, node.getCoord(), upper));
      }
    }
  }
  return GetRange(slopes);
}

Deviation GetDeviation(const Mesh& mesh, const Shape& shape, double voxelSize)
{
  std::vector<double> distances;
  std::vector<double> angles;
  for (std::size_t vertex = 0; vertex < mesh.GetNumberOfPoints(); ++vertex)
  {
    const Point point = mesh.GetPoint(vertex);
    const Point gradient = GetGradient(shape, point);
    const double slope = std::max(Length(gradient), 1e-12);
    distances.push_back(std::abs(shape.Value(point)) / slope / voxelSize);
    const Point normal = mesh.GetNormal(vertex);
    const Point cross = Cross(normal, gradient);
    angles.push_back(DegreesPerRadian * std::atan2(Length(cross), Dot(normal, gradient)));
  }
  const Range distance = GetRange(distances);
  const Range angle = GetRange(angles);
  return { distance.Mean, distance.Maximum, angle.Mean, angle.Maximum };
}

bool AreIdentical(const NarrowBand& first, const NarrowBand& second)
{
  const openvdb::FloatGrid::ConstPtr one = GetPotential(first);
  const openvdb::FloatGrid::ConstPtr other = GetPotential(second);
  auto leaf = one->tree().cbeginLeaf();
  auto otherLeaf = other->tree().cbeginLeaf();
  if (!leaf && !otherLeaf)
  {
    throw std::logic_error("Two empty bands are compared");
  }
  for (; leaf && otherLeaf; ++leaf, ++otherLeaf)
  {
    const std::size_t bytes = leaf->SIZE * sizeof(float);
    if (leaf->origin() != otherLeaf->origin() || leaf->valueMask() != otherLeaf->valueMask() ||
      std::memcmp(leaf->buffer().data(), otherLeaf->buffer().data(), bytes) != 0)
    {
      return false;
    }
  }
  return !leaf && !otherLeaf;
}
}
