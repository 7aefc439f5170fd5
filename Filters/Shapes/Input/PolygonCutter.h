// Triangulates polygons, which may be concave.

#ifndef PolygonCutter_h
#define PolygonCutter_h

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"

#include <array>
#include <cstddef>
#include <vector>

namespace activesurface
{

class PolygonCutter
{
public:
  using Point = std::array<double, 3>;
  using Triangle = std::array<std::size_t, 3>; // corners of the polygon, by their indices

  PolygonCutter();

  // Triangulates a polygon of at least three corners. The result is valid until the next call. A
  // polygon that VTK cannot triangulate is cut into a fan of triangles, so that a closed mesh stays
  // closed.
  const std::vector<Triangle>& Cut(const std::vector<Point>& corners);

private:
  void CutQuadrangle(const std::vector<Point>& corners);
  bool CutByVTK(const std::vector<Point>& corners);

  std::vector<Triangle> Triangles;
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkIdList> Pieces;
  vtkNew<vtkPoints> PiecePoints;
};

}

#endif
