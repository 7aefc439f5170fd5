// The polygons and strips of a vtkPolyData as triangles on merged points, and what is wrong with
// them: for all that needs to know the inside of a mesh.
//
// A mesh is closed if each edge belongs to an even number of its polygons, nearly always to two.
// Then a point beside it is inside or outside, by how often a way out crosses the mesh: bodies may
// touch along an edge, of four polygons. An edge of one polygon is the rim of a hole, and at one of
// three polygons a wall ends.

#ifndef MeshTriangles_h
#define MeshTriangles_h

#include "vtkActivePotentialsModule.h"

#include "vtkType.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkPolyData;

namespace activesurface
{

struct VTKACTIVEPOTENTIALS_EXPORT MeshDefects
{
  std::size_t OpenEdges = 0;      // of one polygon only
  std::size_t CrowdedEdges = 0;   // of more than two polygons
  std::size_t OddEdges = 0;       // of an odd number of polygons: those of one, and of three ...
  std::size_t BrokenPolygons = 0; // left out: a point is not finite, or does not exist
  std::size_t FlatPolygons = 0;   // left out: fewer than three different points

  bool IsClosed() const { return this->OddEdges == 0; }

  // A sentence, or nothing if there are none.
  std::string Describe() const;
};

struct VTKACTIVEPOTENTIALS_EXPORT MeshTriangles
{
  using Point = std::array<double, 3>;
  using Triangle = std::array<vtkIdType, 3>;

  std::vector<Point> Points; // different from each other; those of the triangles, no others
  std::vector<Triangle> Triangles;
  std::vector<Triangle> Origins; // of the triangles: their corners as points of the vtkPolyData
  MeshDefects Defects;

  // Box of the points; x min > x max if there are none.
  std::array<double, 6> GetBounds() const;
};

// Points of equal coordinates become one, so that a soup of triangles is closed where it seems to
// be. Concave polygons are cut well, quadrangles the same with any release of VTK. Lines and
// vertices are passed over.
VTKACTIVEPOTENTIALS_EXPORT MeshTriangles ReadTriangles(vtkPolyData* mesh);

// Box of the polygons and strips, without broken ones, at a small part of the cost;
// x min > x max if there are none. vtkPolyData's own does not survive a point that does not exist.
VTKACTIVEPOTENTIALS_EXPORT std::array<double, 6> FindBounds(vtkPolyData* mesh);

}

#endif
