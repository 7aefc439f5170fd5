// Converts the polygons and strips of a vtkPolyData to triangles on merged points, and reports
// defects. All code that needs the inside of a mesh uses this conversion.
//
// A mesh is closed if each edge belongs to an even number of its polygons, usually to two. Bodies
// may touch along an edge of four polygons. At an edge of one polygon there is a hole; at an edge
// of three polygons a wall ends.

#ifndef MeshTriangles_h
#define MeshTriangles_h

#include "vtkActiveShapesModule.h"

#include "vtkType.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkPolyData;

namespace activesurface
{

struct VTKACTIVESHAPES_EXPORT MeshDefects
{
  std::size_t OpenEdges = 0;      // edges of one polygon only
  std::size_t CrowdedEdges = 0;   // edges of more than two polygons
  std::size_t OddEdges = 0;       // edges of an odd number of polygons: one, three ...
  std::size_t BrokenPolygons = 0; // omitted: a point is not finite (or above 1e100) or missing
  std::size_t FlatPolygons = 0;   // omitted: fewer than three different points

  bool IsClosed() const { return this->OddEdges == 0; }

  // Returns a sentence, or an empty text without defects.
  std::string Describe() const;
};

struct VTKACTIVESHAPES_EXPORT MeshTriangles
{
  using Point = std::array<double, 3>;
  using Triangle = std::array<vtkIdType, 3>;

  std::vector<Point> Points; // distinct; only points of triangles
  std::vector<Triangle> Triangles;
  std::vector<Triangle> Origins; // corners of the triangles as points of the vtkPolyData
  MeshDefects Defects;

  // Bounding box of the points; x min > x max if there are none.
  std::array<double, 6> GetBounds() const;
};

// Merges points of equal coordinates, so that separate triangles with coincident corners form a
// closed mesh. Polygons may be concave (PolygonCutter.h). The result for quadrangles is the same
// with every release of VTK. Lines and vertices are ignored.
VTKACTIVESHAPES_EXPORT MeshTriangles ReadTriangles(vtkPolyData* mesh);

// Returns the bounding box of the polygons and strips without missing or unusable points, at a much
// lower cost than ReadTriangles. If there are none, x min > x max. vtkPolyData::GetCellsBounds
// fails if a polygon refers to a point that does not exist.
VTKACTIVESHAPES_EXPORT std::array<double, 6> FindBounds(vtkPolyData* mesh);

}

#endif
