// Shapes shared by the tests of vtkGridPotential on meshes: spheres, cubes, and meshes point by
// point.
#ifndef MeshShapes_h
#define MeshShapes_h

#include "Support/GridShapes.h"

#include "vtkAppendPolyData.h"
#include "vtkCubeSource.h"
#include "vtkIdList.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

namespace activesurface
{

constexpr double Radius = 0.8;

// `end`: angle from the pole to the rim [degrees]; 180 gives a closed sphere.
inline vtkSmartPointer<vtkPolyData> MakeSphere(
  double radius, int resolution, double end = 180.0, const Point& centre = { 0.0, 0.0, 0.0 })
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(centre[0], centre[1], centre[2]);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetEndPhi(end);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> MakeCube(double from, double to)
{
  vtkNew<vtkCubeSource> source;
  source->SetBounds(from, to, from, to, 0.0, 1.0);
  source->Update();
  return source->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> Append(vtkPolyData* first, vtkPolyData* second)
{
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(first);
  append->AddInputData(second);
  append->Update();
  return append->GetOutput();
}

// A copy of a mesh in which each polygon has points of its own.
inline vtkSmartPointer<vtkPolyData> MakeSoup(vtkPolyData* mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfPolys(); ++cell)
  {
    mesh->GetPolys()->GetCellAtId(cell, ids);
    polygons->InsertNextCell(static_cast<int>(ids->GetNumberOfIds()));
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      polygons->InsertCellPoint(points->InsertNextPoint(mesh->GetPoint(ids->GetId(i))));
    }
  }
  auto soup = vtkSmartPointer<vtkPolyData>::New();
  soup->SetPoints(points);
  soup->SetPolys(polygons);
  return soup;
}

inline vtkSmartPointer<vtkPolyData> MakeMesh(
  const std::vector<Point>& places, const std::vector<std::vector<vtkIdType>>& polygons)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& place : places)
  {
    points->InsertNextPoint(place.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& polygon : polygons)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
  }
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

inline std::vector<Point> PointsIn(double side, int count, unsigned seed)
{
  Random random(seed);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
  {
    points.push_back(random.In(-side, side));
  }
  return points;
}

inline std::vector<double> ValuesOf(vtkPolyData* mesh, const std::vector<Point>& points)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(mesh);
  return SampleAll(potential, points);
}

}

#endif
