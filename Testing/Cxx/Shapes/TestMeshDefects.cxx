// Defects of meshes, shells, and meshes that vtkGridPotential refuses.

#include "Shapes/MeshShapes.h"
#include "Support/MessageCapture.h"

#include "vtkStripper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestMeshDefects
{

// The shell's walls are spheres 0.2 inside and outside of the mesh. Distances are accurate to 0.01,
// except within two voxels of the mesh.
TEST(TestMeshDefects, OpenMeshesBecomeShells)
{
  const auto half = MakeSphere(Radius, 24, 90.0);
  vtkNew<vtkGridPotential> potential;
  const MessageCapture messages(potential);
  potential->SetInput(half);
  potential->SetVoxelSize(0.05);
  const std::string expected = "The mesh has defects: 24 open edges (of one polygon only).";
  EXPECT_EQ(std::string(potential->GetDefects()), expected) << "defects";
  EXPECT_EQ(messages.Warnings.size(), 1u) << "one warning";
  EXPECT_TRUE(messages.Has("24 open edges")) << "which names them";
  potential->SetMeshThickness(0.4);
  EXPECT_NEAR(ValueAt(potential, { 0.0, 0.0, 0.5 }), 0.1, 0.015) << "below the shell";
  EXPECT_NEAR(ValueAt(potential, { 0.0, 0.0, 0.65 }), -0.05, 0.015) << "in its lower half";
  EXPECT_NEAR(ValueAt(potential, { 0.0, 0.0, 0.95 }), -0.05, 0.015) << "in its upper half";
  EXPECT_NEAR(ValueAt(potential, { 0.0, 0.0, 1.1 }), 0.1, 0.015) << "above it";
  EXPECT_GT(ValueAt(potential, { 0.0, 0.0, -0.8 }), 0.2) << "where the other half would be";
  double bounds[6];
  EXPECT_TRUE(potential->GetGridBounds(bounds)) << "bounds";
  EXPECT_NEAR(bounds[5], 1.0, 1e-12) << "upper bound";
  EXPECT_NEAR(bounds[4], -0.2, 1e-12) << "lower bound";
  EXPECT_EQ(messages.Warnings.size(), 2u) << "one more warning, as it was read again";
  potential->SetWarnOfDefects(false);
  potential->Modified();
  potential->Build();
  EXPECT_EQ(messages.Warnings.size(), 2u) << "none when it is turned off";
  potential->SetInput(MakeSphere(Radius, 24));
  EXPECT_LT(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.1) << "a closed one stays a solid";
}

// Winding numbers need the orientation of each triangle, of which strips reverse every second one.
// Their error depends on the order of the triangles, and is below 0.01. At the hole, of radius
// 0.69, their slope is about 1 / (2 * 0.69), so the cap shifts by less than 0.014.
TEST(TestMeshDefects, AnOpenMeshOfStripsHasTheInsideOfItsPolygons)
{
  const auto bowl = MakeSphere(Radius, 24, 120.0);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(bowl);
  stripper->Update();
  EXPECT_GT(stripper->GetOutput()->GetNumberOfStrips(), 0) << "strips";
  vtkNew<vtkGridPotential> ofPolygons, ofStrips;
  ofPolygons->SetInput(bowl);
  ofStrips->SetInput(stripper->GetOutput());
  for (vtkGridPotential* potential : { ofPolygons.Get(), ofStrips.Get() })
  {
    potential->SetVoxelSize(0.05);
    potential->SetWarnOfDefects(false);
    EXPECT_LT(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.1) << "the centre is inside";
  }
  for (const Point& x : PointsIn(1.2, 2000, 4))
  {
    EXPECT_NEAR(ValueAt(ofStrips, x), ValueAt(ofPolygons, x), 0.014) << "distance";
  }
}

// Faces are flat, so distances are exact up to the single precision of samples.
TEST(TestMeshDefects, CubesThatShareAnEdgeAreASolid)
{
  vtkNew<vtkGridPotential> potential;
  const MessageCapture messages(potential);
  potential->SetInput(Append(MakeCube(-1.0, 0.0), MakeCube(0.0, 1.0)));
  potential->SetVoxelSize(0.05);
  EXPECT_EQ(
    std::string(potential->GetDefects()), "The mesh has defects: 1 edge of more than two polygons.")
    << "defects";
  EXPECT_EQ(messages.Warnings.size(), 1u) << "one warning";
  EXPECT_NEAR(ValueAt(potential, { -0.8, -0.5, 0.5 }), -0.2, 1e-6) << "in one cube";
  EXPECT_NEAR(ValueAt(potential, { 0.8, 0.5, 0.5 }), -0.2, 1e-6) << "in the other";
  EXPECT_NEAR(ValueAt(potential, { 0.8, -0.2, 0.5 }), 0.2, 1e-6) << "outside both";
  potential->SetMeshThickness(0.1);
  EXPECT_NEAR(ValueAt(potential, { -0.8, -0.5, 0.5 }), -0.2, 1e-6) << "closed: no shell";
}

// The lost point belongs to six triangles. They are ignored, and leave a hole with six edges.
TEST(TestMeshDefects, BrokenPolygonsAreLeftOut)
{
  for (const double bad : { NaN, Infinity, 1e200 })
  {
    auto sphere = MakeSphere(Radius, 12);
    sphere->GetPoints()->SetPoint(40, 0.0, bad, 0.0);
    vtkNew<vtkGridPotential> potential;
    const MessageCapture messages(potential);
    potential->SetInput(sphere);
    EXPECT_EQ(std::string(potential->GetDefects()),
      "The mesh has defects: 6 open edges (of one polygon only), 6 polygons with a point that is "
      "missing, beyond 1e100 or not finite (left out).")
      << "defects";
    EXPECT_EQ(messages.Warnings.size(), 1u) << "one warning";
    EXPECT_EQ(messages.Errors.size(), 0u) << "no error";
    EXPECT_TRUE(std::isfinite(ValueAt(potential, { 0.1, 0.2, 0.3 }))) << "a value";
    double bounds[6];
    EXPECT_TRUE(potential->GetGridBounds(bounds) && bounds[3] <= Radius) << "bounds";
  }
  const std::vector<Point> corners = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },
    { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 } };
  vtkNew<vtkGridPotential> potential;
  const MessageCapture messages(potential);
  potential->SetInput(MakeMesh(corners,
    { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 }, { 1, 2, 4 }, { 1, 2, 9 }, { -1, 2, 3 },
      { 0, 1 }, {} }));
  potential->SetMeshThickness(0.1);
  EXPECT_EQ(std::string(potential->GetDefects()),
    "The mesh has defects: 2 polygons with a point that is missing, beyond 1e100 or not "
    "finite (left out), 3 polygons of fewer than three different points (left out).")
    << "defects";
  EXPECT_LT(ValueAt(potential, { 0.2, 0.2, 0.2 }), -0.1) << "closed without them: a solid";
}

namespace
{
void ExpectError(vtkGridPotential* potential, const std::string& words)
{
  const MessageCapture messages(potential);
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 1.0) << words << ": outside everywhere";
  EXPECT_TRUE((GradientAt(potential, { 0.0, 0.0, 0.0 }) == Point{ 0.0, 0.0, 0.0 }))
    << "no gradient";
  EXPECT_EQ(messages.Errors.size(), 1u) << words << ": one error";
  EXPECT_EQ(messages.Warnings.size(), 0u) << words << ": no warning besides";
  EXPECT_TRUE(messages.Has(words)) << potential->GetError();
}
}

TEST(TestMeshDefects, MeshesOfNoUseAreOneError)
{
  const auto expect = [](vtkPolyData* mesh, const std::string& words)
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(mesh);
    ExpectError(potential, words);
  };
  expect(vtkNew<vtkPolyData>(), "has no polygons");
  expect(MakeMesh({ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 } }, {}), "has no polygons");
  expect(MakeMesh({ { 0.0, 0.0, NaN }, { 1.0, 0.0, 0.0 } }, { { 0, 1, 1 } }), "no valid polygon");
  vtkNew<vtkPolyData> noPoints;
  noPoints->SetPolys(MakeMesh({}, { { 0, 1, 2 } })->GetPolys());
  expect(noPoints, "no valid polygon");
}

TEST(TestMeshDefects, LatticesTooLargeAreRefused)
{
  const auto expect = [](
                        const std::string& words, const std::function<void(vtkGridPotential*)>& set)
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(MakeSphere(Radius, 20));
    set(potential);
    ExpectError(potential, words);
  };
  const std::string tooMany = "MaximumNumberOfVoxels";
  expect(tooMany, [](vtkGridPotential* p) { p->SetVoxelSize(1e-4); });
  expect("10^9 voxels", [](vtkGridPotential* p) { p->SetVoxelSize(1e-12); });
  expect("10^9 voxels", [](vtkGridPotential* p) { p->SetVoxelSize(1e-320); });
  expect("VoxelSize must be", [](vtkGridPotential* p) { p->SetVoxelSize(NaN); });
  expect(tooMany, [](vtkGridPotential* p) { p->SetReach(1e6); });
  expect(tooMany, [](vtkGridPotential* p) { p->SetReach(Infinity); });
  expect("Reach must be", [](vtkGridPotential* p) { p->SetReach(NaN); });
  expect("MeshThickness must be", [](vtkGridPotential* p) { p->SetMeshThickness(NaN); });
  expect(tooMany, [](vtkGridPotential* p) { p->SetMaximumNumberOfVoxels(100000); });
  // A sliver without area, 1e8 voxels long.
  expect(tooMany,
    [](vtkGridPotential* p)
    {
      p->SetInput(
        MakeMesh({ { 0.0, 0.0, 0.0 }, { 1e8, 0.0, 0.0 }, { 1.0, 0.0, 0.0 } }, { { 0, 1, 2 } }));
      p->SetVoxelSize(1.0);
      p->SetReach(3.0);
    });
}

}
