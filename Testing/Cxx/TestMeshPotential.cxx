// vtkGridPotential of a mesh: its distances.

#include "Check.h"
#include "MeshShapes.h"

#include "vtkReverseSense.h"
#include "vtkStripper.h"

#include <algorithm>
#include <cmath>

namespace
{
double LengthOf(const Point& x)
{
  return Distance(x, { 0.0, 0.0, 0.0 });
}
}

// The mesh lies up to r/8 (dtheta^2 + dphi^2) within the sphere. At the distance rho from the
// centre the second derivatives of the distance sum up to 2 / rho, so that trilinear interpolation
// is off by h^2 / 4 rho, and its gradient by about 2 h / rho. Samples are floats, up to 16 voxels:
// 1e-6 h.
void SphereHasItsDistance(Check& check)
{
  const double h = 2.0 * Radius / 64.0, reach = 2.0 * Radius * std::sqrt(3.0) / 8.0;
  const int n = 200;
  const double flat = Radius / 8.0 * 5.0 * std::pow(vtkMath::Pi() / n, 2);
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(MakeSphere(Radius, n));
  reverse->Update();
  const auto sphere = MakeSphere(Radius, n);
  for (vtkPolyData* mesh : { sphere.Get(), reverse->GetOutput() })
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(mesh);
    check.Equal(std::string(potential->GetDefects()), "", "defects");
    for (const Point& x : PointsIn(1.2, 20000, 1))
    {
      const double rho = LengthOf(x), value = ValueAt(potential, x), distance = rho - Radius;
      const Point gradient = GradientAt(potential, x);
      if (std::fabs(distance) < reach - 0.1 * h)
      {
        check.Near(value, distance, flat + h * h / (4.0 * (rho - h)) + 1e-6 * h, "distance");
        const Point normal = { x[0] / rho, x[1] / rho, x[2] / rho };
        check.Less(Distance(gradient, normal), 2.0 * h / (rho - h) + 0.05, "gradient");
      }
      else if (std::fabs(distance) > reach + 0.1 * h)
      {
        check.Near(value, std::copysign(reach, distance), 1e-3 * h, "beyond Reach");
        check.True(gradient == Point{ 0.0, 0.0, 0.0 }, "no gradient");
      }
    }
  }
}

// The gradient of the interpolation, not of the distance: differences within a voxel are exact but
// for rounding, 1e-16 / 1e-6, as F is linear along each axis there.
void GradientIsThatOfTheValue(Check& check)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeSphere(Radius, 20));
  potential->SetVoxelSize(0.05);
  const double step = 1e-6;
  for (Point x : PointsIn(0.9, 2000, 2))
  {
    for (double& c : x)
    {
      const double place = std::floor(c / 0.05);
      c = 0.05 * (place + std::min(std::max(c / 0.05 - place, 0.01), 0.99));
    }
    const double value = ValueAt(potential, x);
    if (std::fabs(value) > 0.3) // Reach is .346
    {
      continue;
    }
    const Point gradient = GradientAt(potential, x);
    for (int axis = 0; axis < 3; ++axis)
    {
      Point low = x, high = x;
      low[axis] -= step;
      high[axis] += step;
      const double rise = ValueAt(potential, high) - ValueAt(potential, low);
      check.Near(gradient[axis], rise / (high[axis] - low[axis]), 1e-8, "gradient");
    }
  }
}

void EqualPointsAreOne(Check& check)
{
  const auto sphere = MakeSphere(Radius, 30);
  const auto soup = MakeSoup(sphere);
  vtkNew<vtkGridPotential> potential;
  const Listener listener(potential);
  potential->SetInput(soup);
  check.Equal(std::string(potential->GetDefects()), "", "defects");
  check.Equal(listener.Warnings, 0, "warnings");
  const auto points = PointsIn(1.0, 5000, 3);
  check.True(AreSameBytes(SampleAll(potential, points), ValuesOf(sphere, points)), "same bytes");
  vtkNew<vtkStripper> strips;
  strips->SetInputData(sphere);
  strips->Update();
  check.Less(0, strips->GetOutput()->GetNumberOfStrips(), "strips");
  potential->SetInput(strips->GetOutput());
  check.Equal(std::string(potential->GetDefects()), "", "defects of strips");
  check.Near(ValueAt(potential, { 0.7, 0.0, 0.0 }), -0.1, 0.02, "inside of strips");
}

// The notch of an L is outside: its faces are cut as polygons, not as fans from any corner. Flat
// faces are exact but for the samples being floats, up to 2 / h = 40 voxels: 1e-6.
void PolygonsMayBeConcave(Check& check)
{
  std::vector<Point> places;
  for (const double z : { 0.0, 1.0 })
  {
    places.push_back({ 0.0, 2.0, z });
    places.push_back({ 0.0, 0.0, z });
    places.push_back({ 2.0, 0.0, z });
    places.push_back({ 2.0, 1.0, z });
    places.push_back({ 1.0, 1.0, z });
    places.push_back({ 1.0, 2.0, z });
  }
  for (vtkIdType first = 0; first < 6; ++first)
  {
    std::vector<std::vector<vtkIdType>> polygons(2);
    for (vtkIdType i = 0; i < 6; ++i)
    {
      polygons[0].push_back(5 - (first + i) % 6);
      polygons[1].push_back(6 + (first + i) % 6);
      polygons.push_back({ i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i });
    }
    vtkNew<vtkGridPotential> potential;
    potential->SetVoxelSize(0.05);
    potential->SetReach(1.0);
    potential->SetInput(MakeMesh(places, polygons));
    check.Equal(std::string(potential->GetDefects()), "", "defects");
    check.Near(ValueAt(potential, { 1.5, 1.4, 0.5 }), 0.4, 1e-6, "in the notch");
    check.Near(ValueAt(potential, { 0.4, 1.5, 0.5 }), -0.4, 1e-6, "in an arm");
    check.Near(ValueAt(potential, { 1.5, 0.2, 0.5 }), -0.2, 1e-6, "in the other");
  }
}

void BodiesAreUnitedAndVoidsFilled(Check& check)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(Append(MakeSphere(0.5, 40), MakeSphere(0.5, 40, 180.0, { 0.6, 0.0, 0.0 })));
  check.Equal(std::string(potential->GetDefects()), "", "defects");
  check.Less(ValueAt(potential, { 0.3, 0.0, 0.0 }), -0.1, "in both");
  // .02 from the other one's wall, .44 from the surface of the two; Reach is .27.
  check.Near(ValueAt(potential, { 0.12, 0.0, 0.0 }), -0.27, 0.03, "beside an inner wall");
  check.Less(ValueAt(potential, { -0.2, 0.0, 0.0 }), -0.1, "in one");
  check.Less(0.1, ValueAt(potential, { 0.3, 0.6, 0.0 }), "in none");
  potential->SetInput(Append(MakeSphere(0.8, 40), MakeSphere(0.4, 40)));
  check.Less(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.1, "in a void");
}

// OpenVDB's own transform would refuse voxels below 1e-5. Powers of two change no bit.
void AnyUnitOfLengthWillDo(Check& check)
{
  const auto sphere = MakeSphere(Radius, 30);
  const auto points = PointsIn(1.0, 2000, 4);
  const auto expected = ValuesOf(sphere, points);
  for (const int exponent : { -100, -20, 40 })
  {
    const double unit = std::ldexp(1.0, exponent);
    vtkNew<vtkPoints> scaled;
    scaled->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
    {
      const double* x = sphere->GetPoint(i);
      scaled->InsertNextPoint(unit * x[0], unit * x[1], unit * x[2]);
    }
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(scaled);
    mesh->SetPolys(sphere->GetPolys());
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(mesh);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Point x = { unit * points[i][0], unit * points[i][1], unit * points[i][2] };
      check.Equal(ValueAt(potential, x), unit * expected[4 * i], "value");
      check.Equal(GradientAt(potential, x)[1], expected[4 * i + 2], "gradient");
    }
  }
}

void ThreadsGiveTheSameBytes(Check& check)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeSphere(Radius, 40));
  const auto points = PointsIn(1.0, 5000, 5);
  const auto expected = ValuesOf(MakeSphere(Radius, 40), points);
  for (const std::vector<double>& byThread : SampleByThreads(potential, points))
  {
    check.True(AreSameBytes(byThread, expected), "several threads");
  }
}

void ChangesOfTheMeshAreSeen(Check& check)
{
  auto sphere = MakeSphere(Radius, 20);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(sphere);
  check.Less(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.0, "at the start");
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    double x[3];
    sphere->GetPoint(i, x);
    sphere->GetPoints()->SetPoint(i, x[0] + 5.0, x[1], x[2]);
  }
  sphere->GetPoints()->Modified();
  check.Less(0.0, ValueAt(potential, { 0.0, 0.0, 0.0 }), "it has moved away");
  check.Less(ValueAt(potential, { 5.0, 0.0, 0.0 }), 0.0, "to there");
  potential->SetReach(0.2);
  check.Near(ValueAt(potential, { 5.0, 0.0, 0.0 }), -0.2, 1e-15, "Reach");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    {
      { "SphereHasItsDistance", SphereHasItsDistance },
      { "GradientIsThatOfTheValue", GradientIsThatOfTheValue },
      { "EqualPointsAreOne", EqualPointsAreOne },
      { "PolygonsMayBeConcave", PolygonsMayBeConcave },
      { "BodiesAreUnitedAndVoidsFilled", BodiesAreUnitedAndVoidsFilled },
      { "AnyUnitOfLengthWillDo", AnyUnitOfLengthWillDo },
      { "ThreadsGiveTheSameBytes", ThreadsGiveTheSameBytes },
      { "ChangesOfTheMeshAreSeen", ChangesOfTheMeshAreSeen },
    });
}
