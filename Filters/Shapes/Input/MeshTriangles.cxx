#include "Input/MeshTriangles.h"

#include "Input/EachCell.h"
#include "Input/PolygonCutter.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <unordered_map>

namespace activesurface
{

namespace
{

using Point = MeshTriangles::Point;
using Polygon = std::vector<vtkIdType>;
using Edge = std::array<vtkIdType, 2>;

struct HashOfPoint
{
  std::size_t operator()(const Point& point) const
  {
    std::uint64_t key = 0;
    for (const double coordinate : point)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      key = (key ^ (key >> 29) ^ bits) * 0x9e3779b97f4a7c15ull;
    }
    return static_cast<std::size_t>(key ^ (key >> 32));
  }
};

// Squares of coordinates must be finite.
bool IsUsable(const Point& point)
{
  constexpr double largest = 1e100;
  return std::all_of(point.begin(), point.end(), [](double c) { return std::fabs(c) <= largest; });
}

// Returns false if the point does not exist or is not usable.
bool FindPoint(vtkPolyData* mesh, vtkIdType id, Point& point)
{
  const bool exists = id >= 0 && id < mesh->GetNumberOfPoints();
  if (exists)
  {
    mesh->GetPoint(id, point.data());
  }
  return exists && IsUsable(point);
}

class Reader
{
public:
  explicit Reader(vtkPolyData* mesh);

  void AddPolygon(vtkIdList* ids);
  void AddStrip(vtkIdList* ids);
  void CountEdges();

  MeshTriangles Result;

private:
  bool Accept(vtkIdList* ids);
  vtkIdType Merge(vtkIdType id);
  void Cut();
  void AddTriangle(std::size_t a, std::size_t b, std::size_t c);
  void AddEdges();

  vtkPolyData* Mesh;
  std::unordered_map<Point, vtkIdType, HashOfPoint> Known;
  Polygon Corners; // of the polygon being read
  Polygon Origins; // of the corners, as points of the mesh
  std::vector<Edge> Edges;
  std::vector<Point> Places; // of the corners
  PolygonCutter Cutter;
};

Reader::Reader(vtkPolyData* mesh)
  : Mesh(mesh)
{
  this->Known.reserve(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
}

// Returns the index of the merged point at the coordinates of point `id`, or -1 if that point is
// not usable.
vtkIdType Reader::Merge(vtkIdType id)
{
  Point point;
  if (!FindPoint(this->Mesh, id, point))
  {
    return -1;
  }
  for (double& coordinate : point)
  {
    coordinate += 0.0; // -0 and 0 are equal
  }
  const auto next = static_cast<vtkIdType>(this->Result.Points.size());
  const auto found = this->Known.emplace(point, next);
  if (found.second)
  {
    this->Result.Points.push_back(point);
  }
  return found.first->second;
}

// Reads a polygon's corners without consecutive repetitions. Returns false if the polygon is
// omitted.
bool Reader::Accept(vtkIdList* ids)
{
  this->Corners.clear();
  this->Origins.clear();
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    const vtkIdType corner = this->Merge(ids->GetId(i));
    if (corner < 0)
    {
      ++this->Result.Defects.BrokenPolygons;
      return false;
    }
    if (this->Corners.empty() || this->Corners.back() != corner)
    {
      this->Corners.push_back(corner);
      this->Origins.push_back(ids->GetId(i));
    }
  }
  while (this->Corners.size() > 1 && this->Corners.back() == this->Corners.front())
  {
    this->Corners.pop_back();
    this->Origins.pop_back();
  }
  return this->Corners.size() > 2;
}

void Reader::AddPolygon(vtkIdList* ids)
{
  const std::size_t broken = this->Result.Defects.BrokenPolygons;
  if (this->Accept(ids))
  {
    this->AddEdges();
    this->Cut();
  }
  else if (this->Result.Defects.BrokenPolygons == broken)
  {
    ++this->Result.Defects.FlatPolygons;
  }
}

// Every second triangle of a strip lists its points in reverse order. Flat triangles of strips are
// no defects: they turn or join strips.
void Reader::AddStrip(vtkIdList* ids)
{
  vtkNew<vtkIdList> triangle;
  triangle->SetNumberOfIds(3);
  for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
  {
    const vtkIdType reversed = i % 2;
    triangle->SetId(reversed, ids->GetId(i - 2));
    triangle->SetId(1 - reversed, ids->GetId(i - 1));
    triangle->SetId(2, ids->GetId(i));
    if (this->Accept(triangle))
    {
      this->AddEdges();
      this->Cut();
    }
  }
}

void Reader::AddEdges()
{
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    const auto ends = std::minmax(this->Corners[i], this->Corners[(i + 1) % this->Corners.size()]);
    this->Edges.push_back({ ends.first, ends.second });
  }
}

void Reader::Cut()
{
  this->Places.clear();
  for (const vtkIdType corner : this->Corners)
  {
    this->Places.push_back(this->Result.Points[corner]);
  }
  for (const PolygonCutter::Triangle& corners : this->Cutter.Cut(this->Places))
  {
    this->AddTriangle(corners[0], corners[1], corners[2]);
  }
}

// Adds a triangle of three corners of the polygon.
void Reader::AddTriangle(std::size_t a, std::size_t b, std::size_t c)
{
  this->Result.Triangles.push_back({ this->Corners[a], this->Corners[b], this->Corners[c] });
  this->Result.Origins.push_back({ this->Origins[a], this->Origins[b], this->Origins[c] });
}

void Reader::CountEdges()
{
  std::sort(this->Edges.begin(), this->Edges.end());
  for (std::size_t first = 0, next = 0; first < this->Edges.size(); first = next)
  {
    while (next < this->Edges.size() && this->Edges[next] == this->Edges[first])
    {
      ++next;
    }
    this->Result.Defects.OpenEdges += next - first == 1 ? 1 : 0;
    this->Result.Defects.CrowdedEdges += next - first > 2 ? 1 : 0;
    this->Result.Defects.OddEdges += (next - first) % 2;
  }
}

// Removes the points of omitted polygons.
void RemoveUnused(MeshTriangles& mesh)
{
  std::vector<vtkIdType> place(mesh.Points.size(), -1);
  std::vector<Point> used;
  for (MeshTriangles::Triangle& triangle : mesh.Triangles)
  {
    for (vtkIdType& corner : triangle)
    {
      if (place[corner] < 0)
      {
        place[corner] = static_cast<vtkIdType>(used.size());
        used.push_back(mesh.Points[corner]);
      }
      corner = place[corner];
    }
  }
  mesh.Points.swap(used);
}

constexpr double Huge = std::numeric_limits<double>::max();
constexpr std::array<double, 6> NoBounds = { Huge, -Huge, Huge, -Huge, Huge, -Huge };

void Extend(std::array<double, 6>& bounds, const std::vector<Point>& points)
{
  for (const Point& point : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = std::min(bounds[2 * axis], point[axis]);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], point[axis]);
    }
  }
}

void Append(std::ostringstream& text, std::size_t count, const char* one, const char* many)
{
  if (count > 0)
  {
    text << (text.str().empty() ? "" : ", ") << count << " " << (count == 1 ? one : many);
  }
}

}

std::string MeshDefects::Describe() const
{
  std::ostringstream text;
  Append(
    text, this->OpenEdges, "open edge (of one polygon only)", "open edges (of one polygon only)");
  Append(
    text, this->CrowdedEdges, "edge of more than two polygons", "edges of more than two polygons");
  Append(text, this->BrokenPolygons,
    "polygon with a point that is missing, beyond 1e100 or not finite (left out)",
    "polygons with a point that is missing, beyond 1e100 or not finite (left out)");
  Append(text, this->FlatPolygons, "polygon of fewer than three different points (left out)",
    "polygons of fewer than three different points (left out)");
  return text.str().empty() ? std::string() : "The mesh has defects: " + text.str() + ".";
}

std::array<double, 6> MeshTriangles::GetBounds() const
{
  std::array<double, 6> bounds = NoBounds;
  Extend(bounds, this->Points);
  return bounds;
}

MeshTriangles ReadTriangles(vtkPolyData* mesh)
{
  Reader reader(mesh);
  ForEachCell(mesh->GetPolys(), [&](vtkIdList* ids) { reader.AddPolygon(ids); });
  ForEachCell(mesh->GetStrips(), [&](vtkIdList* ids) { reader.AddStrip(ids); });
  reader.CountEdges();
  RemoveUnused(reader.Result);
  return std::move(reader.Result);
}

std::array<double, 6> FindBounds(vtkPolyData* mesh)
{
  std::array<double, 6> bounds = NoBounds;
  std::vector<Point> corners;
  const auto add = [&](vtkIdList* ids)
  {
    corners.resize(static_cast<std::size_t>(ids->GetNumberOfIds()));
    bool isUsable = true;
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      isUsable = isUsable && FindPoint(mesh, ids->GetId(i), corners[i]);
    }
    if (isUsable)
    {
      Extend(bounds, corners);
    }
  };
  ForEachCell(mesh->GetPolys(), add);
  ForEachCell(mesh->GetStrips(), add);
  return bounds;
}

}
