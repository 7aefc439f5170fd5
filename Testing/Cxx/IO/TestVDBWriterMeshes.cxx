// Meshes that are not skins, written by vtkActiveVDBWriter. They are triangulated and validated as
// in vtkGridPotential.

#include "IO/GridFiles.h"
#include "Shapes/MeshShapes.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"

#include "vtkCubeSource.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkStripper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestVDBWriterMeshes
{

namespace
{

constexpr double VoxelSize = 0.1;
constexpr double Band = 3.0 * VoxelSize;
constexpr double Offset = 0.37 * VoxelSize; // offset of bodies, so that no edge runs along nodes

// The file and vtkGridPotential both store distances in single precision: 6e-8 of 20 voxels.
constexpr double Rounding = 1e-5 * VoxelSize;

using Polygons = std::vector<std::vector<vtkIdType>>;

// Prism of height 2 over an L: a square of 2 x 2 without the corner beyond (1, 1). The outline of
// each cap begins at another corner for each `first`.
vtkSmartPointer<vtkPolyData> MakeL(const std::array<int, 3>& axes, int first)
{
  const double outline[6][2] = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
  std::vector<Point> points(12);
  Polygons polygons(2);
  for (int i = 0; i < 12; ++i)
  {
    const double place[3] = { outline[i % 6][0], outline[i % 6][1], i < 6 ? 0.0 : 2.0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      points[i][axes[axis]] = place[axis] + Offset;
    }
  }
  for (int i = 0; i < 6; ++i)
  {
    polygons[0].push_back((first + 5 - i) % 6);
    polygons[1].push_back(6 + (first + i) % 6);
    polygons.push_back({ i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i });
  }
  return MakeMesh(points, polygons);
}

int Write(vtkPolyData* mesh, const std::string& file, std::string* error = nullptr)
{
  vtkNew<vtkActiveVDBWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(file.c_str());
  writer->SetVoxelSize(VoxelSize);
  writer->WritePointArraysOn();
  const MessageCapture messages(writer);
  const int done = writer->Write();
  if (error)
  {
    *error = messages.GetLastError();
  }
  return done;
}

// Largest difference between a grid and vtkGridPotential at the active nodes. Values of the grid
// end at 3 voxels.
double FindDifference(const openvdb::FloatGrid& grid, vtkPolyData* mesh)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(mesh);
  potential->SetVoxelSize(VoxelSize);
  double worst = 0.0;
  for (auto node = grid.cbeginValueOn(); node; ++node)
  {
    const openvdb::Vec3d x = node.getCoord().asVec3d() * VoxelSize;
    const double expected = std::clamp(ValueAt(potential, { x[0], x[1], x[2] }), -Band, Band);
    worst = std::max(worst, std::fabs(*node - expected));
  }
  return worst;
}

}

// Triangulated as a fan, the caps would cover the notch or be inverted for most first corners.
TEST(TestVDBWriterMeshes, ConcavePolygonsAreCutWell)
{
  const std::string file = EmptyFolder("vdb_concave") + "l.vdb";
  std::array<int, 3> axes = { 0, 1, 2 };
  do
  {
    for (int first = 0; first < 6; ++first)
    {
      const auto mesh = MakeL(axes, first);
      EXPECT_EQ(Write(mesh, file), 1) << "written";
      const auto grid = Load(file, "surface");
      openvdb::Coord notch;
      notch[axes[0]] = notch[axes[1]] = 12;
      notch[axes[2]] = 10;
      EXPECT_NEAR(grid->tree().getValue(notch), 0.2 - Offset, Rounding) << "in the notch";
      notch[axes[0]] = notch[axes[1]] = 15;
      EXPECT_NEAR(grid->tree().getValue(notch), Band, Rounding) << "in the notch, beyond the band";
      EXPECT_LT(FindDifference(*grid, mesh), Rounding) << "difference from vtkGridPotential";
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

TEST(TestVDBWriterMeshes, PolygonsWithMissingPointsAreAnError)
{
  const std::string folder = EmptyFolder("vdb_missing");
  for (const vtkIdType missing : { 12, 1000000, -1 })
  {
    auto mesh = MakeL({ 0, 1, 2 }, 0);
    mesh->GetPolys()->InsertNextCell({ 0, 1, missing });
    std::string error;
    EXPECT_EQ(Write(mesh, folder + "l.vdb", &error), 0) << "not written";
    EXPECT_TRUE(error.find("1 polygon with a point that is missing, beyond 1e100 or not finite") !=
      std::string::npos)
      << error;
  }
  auto mesh = MakeL({ 0, 1, 2 }, 0);
  mesh->GetPoints()->SetPoint(11, 0.0, NaN, 0.0);
  std::string error;
  EXPECT_EQ(Write(mesh, folder + "l.vdb", &error), 0) << "not written";
  EXPECT_TRUE(error.find("3 polygons with a point that is missing, beyond 1e100 or not finite") !=
    std::string::npos)
    << error;
  EXPECT_EQ(CountFiles(folder), std::size_t(0)) << "files";
}

// A wall within the body ends at the body's surface.
TEST(TestVDBWriterMeshes, MeshesWithRimsAreAnError)
{
  const std::string folder = EmptyFolder("vdb_rims");
  auto mesh = MakeL({ 0, 1, 2 }, 0);
  mesh->GetPolys()->InsertNextCell({ 0, 3, 9, 6 });
  std::string error;
  EXPECT_EQ(Write(mesh, folder + "l.vdb", &error), 0) << "not written";
  // Two of the wall's edges are edges of the body too: three polygons share each. Each edge across
  // the caps belongs only to the wall.
  EXPECT_TRUE(error.find("so it has no inside: 4 edges belong") != std::string::npos) << error;
  EXPECT_EQ(CountFiles(folder), std::size_t(0)) << "files";
}

TEST(TestVDBWriterMeshes, BodiesMayTouchAlongAnEdge)
{
  const std::string file = EmptyFolder("vdb_touch") + "cubes.vdb";
  const auto mesh = Append(MakeCube(Offset - 1.0, Offset), MakeCube(Offset, Offset + 1.0));
  mesh->GetPointData()->Initialize();
  EXPECT_EQ(Write(mesh, file), 1) << "written";
  EXPECT_LT(FindDifference(*Load(file, "surface"), mesh), Rounding) << "difference";
}

// Strips reverse every other triangle.
TEST(TestVDBWriterMeshes, StripsAreReadAsTheirTriangles)
{
  const std::string folder = EmptyFolder("vdb_strips");
  const auto sphere = MakeSphere(1.0, 24);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(sphere);
  stripper->Update();
  vtkPolyData* strips = stripper->GetOutput();
  EXPECT_LT(0, strips->GetNumberOfStrips()) << "strips";
  EXPECT_EQ(strips->GetNumberOfPolys(), vtkIdType(0)) << "polygons";
  EXPECT_EQ(Write(sphere, folder + "triangles.vdb"), 1) << "triangles";
  EXPECT_EQ(Write(strips, folder + "strips.vdb"), 1) << "strips";
  const auto expected = Load(folder + "triangles.vdb", "surface");
  const auto grid = Load(folder + "strips.vdb", "surface");
  EXPECT_EQ(grid->activeVoxelCount(), expected->activeVoxelCount()) << "active voxels";
  double worst = 0.0;
  std::size_t differing = 0;
  for (auto node = expected->cbeginValueOn(); node; ++node)
  {
    const float value = grid->tree().getValue(node.getCoord());
    const double difference = std::fabs(double(value) - *node);
    worst = std::max(worst, difference);
    differing += difference > 0.1 * VoxelSize ? 1 : 0;
  }
  // At few nodes the distance that is found depends on the order of triangles (see MeshDistance.h).
  EXPECT_LT(worst, VoxelSize) << "difference";
  EXPECT_LT(differing, expected->activeVoxelCount() / 200) << "nodes that differ";
}

TEST(TestVDBWriterMeshes, FlatTrianglesChangeNothing)
{
  const std::string folder = EmptyFolder("vdb_flat");
  auto mesh = MakeL({ 0, 1, 2 }, 1);
  EXPECT_EQ(Write(mesh, folder + "without.vdb"), 1) << "without";
  for (const std::vector<vtkIdType>& flat : Polygons{ { 0, 0, 0 }, { 1, 2, 1 }, { 4, 5 }, {} })
  {
    mesh->GetPolys()->InsertNextCell(static_cast<vtkIdType>(flat.size()), flat.data());
  }
  EXPECT_EQ(Write(mesh, folder + "with.vdb"), 1) << "with flat triangles";
  const auto expected = Load(folder + "without.vdb", "surface");
  const auto grid = Load(folder + "with.vdb", "surface");
  EXPECT_TRUE(grid->tree().hasSameTopology(expected->tree())) << "the same nodes";
  for (auto node = expected->cbeginValueOn(); node; ++node)
  {
    EXPECT_EQ(grid->tree().getValue(node.getCoord()), *node) << "the same bits";
  }
}

// The faces of a vtkCubeSource have points of their own, with equal coordinates and different
// normals.
TEST(TestVDBWriterMeshes, FacesKeepTheArraysOfTheirOwnPoints)
{
  const std::string file = EmptyFolder("vdb_faces") + "cube.vdb";
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  cube->Update();
  cube->GetOutput()->GetPointData()->RemoveArray("TCoords"); // an array of two components
  EXPECT_EQ(Write(cube->GetOutput(), file), 1) << "written";
  const auto normals = Load<openvdb::Vec3fGrid>(file, "Normals");
  for (int side = 0; side < 6; ++side)
  {
    openvdb::Coord node(9, 4, -3);
    std::swap(node[0], node[side / 2]);
    node[side / 2] = side % 2 ? 9 : -9;
    openvdb::Vec3f expected(0.f);
    expected[side / 2] = side % 2 ? 1.f : -1.f;
    EXPECT_TRUE(normals->tree().getValue(node) == expected) << "normal of side " << side;
  }
}

TEST(TestVDBWriterMeshes, TwoGridsOfOneNameAreRefused)
{
  const std::string folder = EmptyFolder("vdb_names");
  const auto mesh = MakeL({ 0, 1, 2 }, 0);
  vtkNew<vtkFloatArray> array;
  array->SetNumberOfTuples(mesh->GetNumberOfPoints());
  array->Fill(1.0);
  array->SetName("surface");
  mesh->GetPointData()->AddArray(array);
  std::string error;
  EXPECT_EQ(Write(mesh, folder + "l.vdb", &error), 0) << "written";
  EXPECT_NE(error.find("two grids \"surface\""), std::string::npos) << error;
  EXPECT_EQ(CountFiles(folder), 0u) << "files";
  array->SetName("other");
  EXPECT_EQ(Write(mesh, folder + "l.vdb", &error), 1) << error;
}

}
