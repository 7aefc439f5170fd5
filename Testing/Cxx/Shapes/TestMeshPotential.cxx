// Distances of vtkGridPotential to a mesh.

#include "Shapes/MeshShapes.h"
#include "Support/MessageCapture.h"

#include "Input/MeshTriangles.h"

#include "vtkReverseSense.h"
#include "vtkStripper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestMeshPotential
{

namespace
{
double LengthOf(const Point& x)
{
  return Distance(x, { 0.0, 0.0, 0.0 });
}
}

// The mesh lies up to r/8 (dtheta^2 + dphi^2) within the sphere. At a distance rho from the centre,
// the Laplacian of the distance is 2 / rho. Trilinear interpolation is then off by h^2 / 4 rho, and
// its gradient by about 2 h / rho.
TEST(TestMeshPotential, SphereHasItsDistance)
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
    EXPECT_EQ(std::string(potential->GetDefects()), "") << "defects";
    for (const Point& x : PointsIn(1.2, 20000, 1))
    {
      const double rho = LengthOf(x), value = ValueAt(potential, x), distance = rho - Radius;
      const Point gradient = GradientAt(potential, x);
      if (std::fabs(distance) < reach - 0.1 * h)
      {
        EXPECT_NEAR(value, distance, flat + h * h / (4.0 * (rho - h)) + 1e-6 * h) << "distance";
        const Point normal = { x[0] / rho, x[1] / rho, x[2] / rho };
        EXPECT_LT(Distance(gradient, normal), 2.0 * h / (rho - h) + 0.05) << "gradient";
      }
      else if (std::fabs(distance) > reach + 0.1 * h)
      {
        EXPECT_NEAR(value, std::copysign(reach, distance), 1e-3 * h) << "beyond Reach";
        EXPECT_TRUE((gradient == Point{ 0.0, 0.0, 0.0 })) << "no gradient";
      }
    }
  }
}

// The gradient is that of the interpolation, not of the distance. F is linear along each axis
// within a voxel, so differences are exact up to rounding, 1e-16 / 1e-6.
TEST(TestMeshPotential, GradientIsThatOfTheValue)
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
    if (std::fabs(value) > 0.3) // Reach is 0.346
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
      EXPECT_NEAR(gradient[axis], rise / (high[axis] - low[axis]), 1e-8) << "gradient";
    }
  }
}

TEST(TestMeshPotential, EqualPointsAreOne)
{
  const auto sphere = MakeSphere(Radius, 30);
  const auto soup = MakeSoup(sphere);
  vtkNew<vtkGridPotential> potential;
  const MessageCapture messages(potential);
  potential->SetInput(soup);
  EXPECT_EQ(std::string(potential->GetDefects()), "") << "defects";
  EXPECT_EQ(messages.Warnings.size(), 0u) << "warnings";
  const auto points = PointsIn(1.0, 5000, 3);
  EXPECT_TRUE(AreSameBytes(SampleAll(potential, points), ValuesOf(sphere, points))) << "same bytes";
  vtkNew<vtkStripper> strips;
  strips->SetInputData(sphere);
  strips->Update();
  EXPECT_GT(strips->GetOutput()->GetNumberOfStrips(), 0) << "strips";
  potential->SetInput(strips->GetOutput());
  EXPECT_EQ(std::string(potential->GetDefects()), "") << "defects of strips";
  EXPECT_NEAR(ValueAt(potential, { 0.7, 0.0, 0.0 }), -0.1, 0.02) << "inside of strips";
}

// A fan from some corners would cover the notch of the L. Flat faces are exact up to the single
// precision of samples, up to 2 / h = 40 voxels: 1e-6.
TEST(TestMeshPotential, PolygonsMayBeConcave)
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
    EXPECT_EQ(std::string(potential->GetDefects()), "") << "defects";
    EXPECT_NEAR(ValueAt(potential, { 1.5, 1.4, 0.5 }), 0.4, 1e-6) << "in the notch";
    EXPECT_NEAR(ValueAt(potential, { 0.4, 1.5, 0.5 }), -0.4, 1e-6) << "in an arm";
    EXPECT_NEAR(ValueAt(potential, { 1.5, 0.2, 0.5 }), -0.2, 1e-6) << "in the other";
  }
}

// Releases of VTK cut quadrangles along different diagonals.
TEST(TestMeshPotential, QuadranglesAreCutAlongTheShorterDiagonalThatIsInside)
{
  using Corners = std::vector<Point>;
  const auto isCutAlong = [](const Corners& places, vtkIdType from, vtkIdType to)
  {
    const MeshTriangles cut = ReadTriangles(MakeMesh(places, { { 0, 1, 2, 3 } }));
    return cut.Origins.size() == 2 &&
      std::all_of(cut.Origins.begin(), cut.Origins.end(),
        [=](const MeshTriangles::Triangle& corners)
        {
          const auto has = [&corners](vtkIdType corner)
          { return std::find(corners.begin(), corners.end(), corner) != corners.end(); };
          return has(from) && has(to);
        });
  };
  const Corners long02 = { { 0, 0, 0 }, { 1, .1, 0 }, { 2, 2, 0 }, { .1, 1, 0 } };
  const Corners long13 = { { .1, 1, 0 }, { 0, 0, 0 }, { 1, .1, 0 }, { 2, 2, 0 } };
  const Corners bent = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, .8 }, { 0, 1, 0 } };
  const Corners square = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const Corners notchAt2 = { { 0, 0, 0 }, { 3, .2, 0 }, { 2.8, 0, 0 }, { 3, -.2, 0 } };
  const Corners notchAt1 = { { 3, -.2, 0 }, { 2.8, 0, 0 }, { 3, .2, 0 }, { 0, 0, 0 } };
  EXPECT_TRUE(isCutAlong(long02, 1, 3)) << "1 to 3 is shorter";
  EXPECT_TRUE(isCutAlong(long13, 0, 2)) << "0 to 2 is shorter";
  EXPECT_TRUE(isCutAlong(bent, 1, 3)) << "1 to 3 is shorter, out of the plane";
  EXPECT_TRUE(isCutAlong(square, 1, 3)) << "of two as long as each other, the second one";
  EXPECT_TRUE(isCutAlong(notchAt2, 0, 2)) << "1 to 3 is shorter, but outside";
  EXPECT_TRUE(isCutAlong(notchAt1, 1, 3)) << "0 to 2 is shorter, but outside";
}

TEST(TestMeshPotential, BodiesAreUnitedAndVoidsFilled)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(Append(MakeSphere(0.5, 40), MakeSphere(0.5, 40, 180.0, { 0.6, 0.0, 0.0 })));
  EXPECT_EQ(std::string(potential->GetDefects()), "") << "defects";
  EXPECT_LT(ValueAt(potential, { 0.3, 0.0, 0.0 }), -0.1) << "in both";
  // The point is 0.02 from the other ball's wall and 0.44 from the surface of the union; Reach is
  // 0.27.
  EXPECT_NEAR(ValueAt(potential, { 0.12, 0.0, 0.0 }), -0.27, 0.03) << "beside an inner wall";
  EXPECT_LT(ValueAt(potential, { -0.2, 0.0, 0.0 }), -0.1) << "in one";
  EXPECT_GT(ValueAt(potential, { 0.3, 0.6, 0.0 }), 0.1) << "in none";
  potential->SetInput(Append(MakeSphere(0.8, 40), MakeSphere(0.4, 40)));
  EXPECT_LT(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.1) << "in a void";
}

// OpenVDB's own transform would refuse voxels below 1e-5. Scaling by powers of two changes no bit.
TEST(TestMeshPotential, AnyUnitOfLengthWillDo)
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
      EXPECT_EQ(ValueAt(potential, x), unit * expected[4 * i]) << "value";
      EXPECT_EQ(GradientAt(potential, x)[1], expected[4 * i + 2]) << "gradient";
    }
  }
}

TEST(TestMeshPotential, ThreadsGiveTheSameBytes)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeSphere(Radius, 40));
  const auto points = PointsIn(1.0, 5000, 5);
  const auto expected = ValuesOf(MakeSphere(Radius, 40), points);
  for (const std::vector<double>& byThread : SampleByThreads(potential, points))
  {
    EXPECT_TRUE(AreSameBytes(byThread, expected)) << "several threads";
  }
}

TEST(TestMeshPotential, ChangesOfTheMeshAreSeen)
{
  auto sphere = MakeSphere(Radius, 20);
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(sphere);
  EXPECT_LT(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.0) << "at the start";
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    double x[3];
    sphere->GetPoint(i, x);
    sphere->GetPoints()->SetPoint(i, x[0] + 5.0, x[1], x[2]);
  }
  sphere->GetPoints()->Modified();
  EXPECT_GT(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.0) << "it has moved away";
  EXPECT_LT(ValueAt(potential, { 5.0, 0.0, 0.0 }), 0.0) << "to there";
  potential->SetReach(0.2);
  EXPECT_NEAR(ValueAt(potential, { 5.0, 0.0, 0.0 }), -0.2, 1e-15) << "Reach";
}

}
