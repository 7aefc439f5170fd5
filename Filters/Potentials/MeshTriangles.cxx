#include "MeshTriangles.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"

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

// Their squares must be finite.
bool IsUsable(const Point& point)
{
  constexpr double largest = 1e100;
  return std::all_of(point.begin(), point.end(), [](double c) { return std::fabs(c) <= largest; });
}

// False if it is of no use.
bool FindPoint(vtkPolyData* mesh, vtkIdType id, Point& point)
{
  const bool exists = id >= 0 && id < mesh->GetNumberOfPoints();
  if (exists)
  {
    mesh->GetPoint(id, point.data());
  }
  return exists && IsUsable(point);
}

Point Between(const Point& from, const Point& to)
{
  return { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
}

double Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double SquareBetween(const Point& a, const Point& b)
{
  return Dot(Between(a, b), Between(a, b));
}

Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

// > 0 if the triangles abc and acd look to one side.
double SideOf(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const Point middle = Between(a, c);
  return Dot(Cross(Between(a, b), middle), Cross(middle, Between(a, d)));
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
  bool Take(vtkIdList* ids);
  vtkIdType Merge(vtkIdType id);
  void Cut();
  void CutQuadrangle();
  bool CutByVTK();
  void AddTriangle(std::size_t a, std::size_t b, std::size_t c);
  void AddEdges();

  vtkPolyData* Mesh;
  std::unordered_map<Point, vtkIdType, HashOfPoint> Known;
  Polygon Corners; // of the polygon being read
  Polygon Origins; // of the corners, in the mesh
  std::vector<Edge> Edges;
  vtkNew<vtkPolygon> Cutter;
  vtkNew<vtkIdList> Pieces;
  vtkNew<vtkPoints> PiecePoints;
};

Reader::Reader(vtkPolyData* mesh)
  : Mesh(mesh)
{
  this->Known.reserve(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  this->Cutter->GetPoints()->SetDataTypeToDouble();
}

// The number of the point with these coordinates, or -1 if it is of no use.
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

// Its corners without repetitions; false if it is left out.
bool Reader::Take(vtkIdList* ids)
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
  if (this->Take(ids))
  {
    this->AddEdges();
    this->Cut();
  }
  else if (this->Result.Defects.BrokenPolygons == broken)
  {
    ++this->Result.Defects.FlatPolygons;
  }
}

// Flat triangles are usual in strips, to turn or to join them.
void Reader::AddStrip(vtkIdList* ids)
{
  vtkNew<vtkIdList> triangle;
  triangle->SetNumberOfIds(3);
  for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
  {
    for (vtkIdType corner = 0; corner < 3; ++corner)
    {
      triangle->SetId(corner, ids->GetId(i - 2 + corner));
    }
    if (this->Take(triangle))
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

// Polygons may be concave. What cannot be cut well becomes a fan: the mesh stays closed.
void Reader::Cut()
{
  const std::size_t count = this->Corners.size();
  if (count == 4)
  {
    this->CutQuadrangle();
  }
  else if (count == 3 || !this->CutByVTK())
  {
    for (std::size_t i = 2; i < count; ++i)
    {
      this->AddTriangle(0, i - 1, i);
    }
  }
}

// Releases of VTK choose other diagonals. Here it is the one whose triangles look to one side; of
// two, the shorter one; of two as long as each other, the second one.
void Reader::CutQuadrangle()
{
  const auto at = [this](std::size_t corner) -> const Point&
  { return this->Result.Points[this->Corners[corner]]; };
  const double first = SideOf(at(0), at(1), at(2), at(3)),
               second = SideOf(at(1), at(2), at(3), at(0));
  const bool isSecond = (first > 0.0) != (second > 0.0)
    ? second > 0.0
    : SquareBetween(at(1), at(3)) <= SquareBetween(at(0), at(2));
  const std::size_t start = isSecond ? 1 : 0;
  this->AddTriangle(0, 1, start + 2);
  this->AddTriangle(start, 2, 3);
}

// False if it cannot.
bool Reader::CutByVTK()
{
  const auto count = static_cast<vtkIdType>(this->Corners.size());
  vtkPoints* points = this->Cutter->GetPoints();
  points->SetNumberOfPoints(count);
  this->Cutter->GetPointIds()->SetNumberOfIds(count);
  const Point& origin = this->Result.Points[this->Corners[0]];
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Point& corner = this->Result.Points[this->Corners[i]];
    points->SetPoint(i, corner[0] - origin[0], corner[1] - origin[1], corner[2] - origin[2]);
    this->Cutter->GetPointIds()->SetId(i, i);
  }
  if (!this->Cutter->Triangulate(0, this->Pieces, this->PiecePoints) ||
    this->Pieces->GetNumberOfIds() != 3 * (count - 2))
  {
    return false;
  }
  for (vtkIdType i = 0; i < 3 * (count - 2); i += 3)
  {
    this->AddTriangle(
      this->Pieces->GetId(i), this->Pieces->GetId(i + 1), this->Pieces->GetId(i + 2));
  }
  return true;
}

// Of three corners of the polygon.
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

// Points of polygons that were left out count for nothing.
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

template <class Visit>
void ForEachCell(vtkCellArray* cells, Visit visit)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cells && cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    visit(ids.Get());
  }
}

void Tell(std::ostringstream& text, std::size_t count, const char* one, const char* many)
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
  Tell(
    text, this->OpenEdges, "open edge (of one polygon only)", "open edges (of one polygon only)");
  Tell(
    text, this->CrowdedEdges, "edge of more than two polygons", "edges of more than two polygons");
  Tell(text, this->BrokenPolygons, "polygon with a point that is not finite or does not exist",
    "polygons with a point that is not finite or does not exist");
  Tell(text, this->FlatPolygons, "polygon of fewer than three different points",
    "polygons of fewer than three different points");
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
