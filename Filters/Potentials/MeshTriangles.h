// The polygons and strips of a vtkPolyData as triangles on merged points, and what is wrong with
// them.

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
  std::size_t BrokenPolygons = 0; // left out: a point is not finite, or does not exist
  std::size_t FlatPolygons = 0;   // left out: fewer than three different points

  bool IsClosed() const { return this->OpenEdges == 0 && this->CrowdedEdges == 0; }

  // A sentence, or nothing if there are none.
  std::string Describe() const;
};

struct VTKACTIVEPOTENTIALS_EXPORT MeshTriangles
{
  using Point = std::array<double, 3>;
  using Triangle = std::array<vtkIdType, 3>;

  std::vector<Point> Points; // different from each other; those of the triangles, no others
  std::vector<Triangle> Triangles;
  MeshDefects Defects;

  // Box of the points; x min > x max if there are none.
  std::array<double, 6> GetBounds() const;
};

// Points of equal coordinates become one, so that a soup of triangles is closed where it seems to
// be. Lines and vertices are passed over.
VTKACTIVEPOTENTIALS_EXPORT MeshTriangles ReadTriangles(vtkPolyData* mesh);

}

#endif
