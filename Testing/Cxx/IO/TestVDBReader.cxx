// vtkActiveVDBReader reads files of other programs: here of OpenVDB itself.

#include "IO/GridFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"
#include "Support/PipelineTools.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>
#include <openvdb/math/Transform.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointGroup.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestVDBReader
{

namespace
{

vtkSmartPointer<vtkActiveVDBReader> MakeReader(const std::string& file, const char* grid = "")
{
  auto reader = vtkSmartPointer<vtkActiveVDBReader>::New();
  reader->SetFileName(file.c_str());
  reader->SetGridName(grid);
  return reader;
}

// A grid with this value at a voxel and in a tile of 8^3 voxels.
template <class Grid>
typename Grid::Ptr MakeGrid(const char* name, const typename Grid::ValueType& value)
{
  auto grid = Grid::create();
  grid->setName(name);
  grid->tree().setValue(openvdb::Coord(-3, 4, 5), value);
  grid->tree().addTile(1, openvdb::Coord(8, 0, 0), value, true);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  return grid;
}

double At(vtkImageData* image, int x, int y, int z, int component = 0)
{
  return image->GetScalarComponentAsDouble(x, y, z, component);
}

template <class Grid>
void CheckType(
  const char* type, const typename Grid::ValueType& value, int vtkType, bool half = false)
{
  const std::string file = OutputName("vdb_type.vdb");
  auto grid = MakeGrid<Grid>("a", value);
  grid->setSaveFloatAsHalf(half);
  Save(file, { grid });
  auto reader = MakeReader(file);
  reader->Update();
  vtkImageData* image = reader->GetImageOutput();
  EXPECT_EQ(std::string(reader->GetGridType(0)), std::string(type)) << "type";
  EXPECT_EQ(reader->GetGridIsHalfFloat(0), half) << "half";
  vtkDataArray* array = image->GetPointData()->GetArray("a");
  EXPECT_TRUE(array != nullptr) << "an array of " << type;
  if (!array)
  {
    return;
  }
  EXPECT_EQ(array->GetDataType(), vtkType) << "VTK's type";
  const int extent[6] = { -3, 15, 0, 7, 0, 7 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(image->GetExtent()[i], extent[i]) << "extent";
  }
  const double number = array->GetComponent(image->FindPoint(-1.5, 2.0, 2.5), 0);
  EXPECT_GT(number, 0.0) << "the voxel";
  EXPECT_EQ(array->GetComponent(image->FindPoint(7.5, 3.5, 3.5), 0), number) << "the tile";
  EXPECT_EQ(array->GetComponent(image->FindPoint(0.0, 0.0, 0.0), 0), 0.0) << "the background";
  EXPECT_EQ(static_cast<int>(reader->GetGridActiveVoxels(0)), 513) << "active voxels";
}

}

TEST(TestVDBReader, AllTypesOfNumbersAreRead)
{
  using namespace openvdb;
  CheckType<FloatGrid>("float", 1.5f, VTK_FLOAT);
  CheckType<FloatGrid>("float", 1.5f, VTK_FLOAT, true);
  CheckType<DoubleGrid>("double", 0.1, VTK_DOUBLE);
  CheckType<Int32Grid>("int32", 7, VTK_INT);
  CheckType<Int64Grid>("int64", Int64(1) << 40, VTK_TYPE_INT64);
  CheckType<BoolGrid>("bool", true, VTK_UNSIGNED_CHAR);
  CheckType<MaskGrid>("mask", true, VTK_UNSIGNED_CHAR);
  CheckType<Vec3SGrid>("vec3s", Vec3s(1.f, 2.f, 3.f), VTK_FLOAT);
  CheckType<Vec3DGrid>("vec3d", Vec3d(1.0, 2.0, 3.0), VTK_DOUBLE);
  CheckType<Vec3IGrid>("vec3i", Vec3i(1, 2, 3), VTK_INT);
}

TEST(TestVDBReader, TheBestGridIsTheDefault)
{
  using namespace openvdb;
  const std::string file = EmptyFolder("vdb_best") + "several.vdb";
  auto other = MakeGrid<FloatGrid>("other", 1.f);
  auto fog = MakeGrid<FloatGrid>("fog", 2.f);
  fog->setGridClass(GRID_FOG_VOLUME);
  auto ball = tools::createLevelSetSphere<FloatGrid>(1.f, Vec3f(0.f), 0.25f);
  ball->setName("ball");
  ball->insertMeta("who", StringMetadata("me"));
  auto again = ball->copy(); // shares the tree
  again->setName("again");
  again->setTransform(math::Transform::createLinearTransform(0.125));
  Save(file, { other, fog, ball, again });
  auto reader = MakeReader(file);
  reader->Update();
  EXPECT_EQ(reader->GetNumberOfGrids(), 4) << "grids";
  EXPECT_TRUE(reader->GetImageOutput()->GetPointData()->GetArray("ball") != nullptr)
    << "the level set";
  EXPECT_EQ(std::string(reader->GetGridClass(2)), std::string("level set")) << "class";
  EXPECT_EQ(std::string(reader->GetGridClass(1)), std::string("fog volume")) << "class";
  EXPECT_EQ(std::string(reader->GetGridClass(0)), std::string("unknown")) << "class";
  EXPECT_EQ(reader->GetGridMetadata(2, "who"), std::string("me")) << "metadata";
  EXPECT_TRUE(reader->GetGridIsInstance(3)) << "an instance";
  EXPECT_EQ(reader->GetGridActiveVoxels(3), reader->GetGridActiveVoxels(2)) << "of as many voxels";
  reader->SetGridName("again");
  reader->Update();
  EXPECT_NEAR(At(reader->GetImageOutput(), 0, 0, 4), 0.0, 1e-6) << "the instance's surface";
  EXPECT_EQ(reader->GetImageOutput()->GetSpacing()[0], 0.125) << "in its own place";
  const MessageCapture errors(reader);
  reader->SetGridName("none");
  reader->Update();
  EXPECT_TRUE(errors.Has("other (float), fog (float), ball (float)")) << errors.GetLastError();
  EXPECT_EQ(static_cast<int>(reader->GetImageOutput()->GetNumberOfPoints()), 0) << "points left";
}

TEST(TestVDBReader, RegionsAndLevelsAreTheSameValues)
{
  const std::string file = EmptyFolder("vdb_region") + "ball.vdb";
  auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
    2.f, openvdb::Vec3f(0.1f, 0.2f, 0.3f), 0.0625f);
  Save(file, { ball });
  const auto reader = MakeReader(file);
  const auto compare = [&](int factor, const std::string& name)
  {
    reader->SetDownsamplingFactor(factor);
    reader->Update();
    vtkImageData* image = reader->GetImageOutput();
    const int* e = image->GetExtent();
    int different = 0;
    for (int z = e[4]; z <= e[5]; z += 3)
    {
      for (int y = e[2]; y <= e[3]; ++y)
      {
        for (int x = e[0]; x <= e[1]; ++x)
        {
          const openvdb::Coord place(x * factor, y * factor, z * factor);
          different += At(image, x, y, z) != ball->tree().getValue(place) ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(different, 0) << name;
    EXPECT_GT(image->GetNumberOfPoints(), 100) << name << ", points";
    EXPECT_EQ(image->GetSpacing()[0], 0.0625 * factor) << name << ", spacing";
  };
  compare(1, "all");
  compare(4, "a coarser level");
  reader->SetIndexRegion(-40, -20, -10, 30, 5, 35);
  reader->SetRegionToIndex();
  compare(1, "a region");
  EXPECT_EQ(reader->GetImageOutput()->GetExtent()[0], -40) << "its extent";
  compare(3, "a region, coarser");
  reader->SetWorldRegion(-1.0, 0.5, 0.0, 1.0, 1.0, 2.25);
  reader->SetRegionToWorld();
  compare(1, "a region in space");
  EXPECT_EQ(reader->GetImageOutput()->GetBounds()[5], 2.25) << "its bounds";
}

TEST(TestVDBReader, RotationsAreDirections)
{
  const std::string file = EmptyFolder("vdb_rotated") + "a.vdb";
  auto grid = MakeGrid<openvdb::FloatGrid>("a", 1.f);
  auto transform = openvdb::math::Transform::createLinearTransform(0.5);
  transform->postScale(openvdb::Vec3d(1.0, 2.0, 3.0));
  transform->postRotate(0.3, openvdb::math::Z_AXIS);
  transform->postTranslate(openvdb::Vec3d(1.0, 2.0, 3.0));
  grid->setTransform(transform);
  Save(file, { grid });
  auto reader = MakeReader(file);
  reader->Update();
  double x[3];
  const int node[3] = { -3, 4, 5 };
  reader->GetImageOutput()->TransformIndexToPhysicalPoint(node, x);
  const openvdb::Vec3d there = transform->indexToWorld(openvdb::Vec3d(-3.0, 4.0, 5.0));
  for (int d = 0; d < 3; ++d)
  {
    EXPECT_NEAR(x[d], there[d], 1e-12) << "place";
  }
  transform->postShear(0.5, openvdb::math::X_AXIS, openvdb::math::Y_AXIS);
  Save(file, { grid });
  reader->Modified();
  const MessageCapture errors(reader);
  reader->Update();
  EXPECT_TRUE(errors.Has("sheared")) << errors.GetLastError();
}

TEST(TestVDBReader, SeriesAreTimeSteps)
{
  const std::string folder = EmptyFolder("vdb_times");
  vtkNew<vtkActiveVDBReader> reader;
  for (const double time : { 1.5, 2.0, 4.0 })
  {
    const std::string file = folder + std::to_string(time) + ".vdb";
    auto grid = MakeGrid<openvdb::FloatGrid>("a", static_cast<float>(time));
    grid->insertMeta("time", openvdb::DoubleMetadata(time));
    grid->tree().setValue(openvdb::Coord(0, 0, 20), static_cast<float>(10.0 * time));
    Save(file, { grid });
    reader->AddFileName(file.c_str());
  }
  for (const auto& [time, value] :
    { std::pair{ 1.5, 1.5 }, { 4.0, 4.0 }, { 3.9, 2.0 }, { 0.0, 1.5 } })
  {
    reader->UpdateTimeStep(time);
    EXPECT_EQ(At(reader->GetImageOutput(), -3, 4, 5), value) << "at " << time;
  }
}

TEST(TestVDBReader, PointsComeWithTheirAttributes)
{
  using namespace openvdb;
  using namespace openvdb::points;
  initialize();
  std::vector<Vec3s> positions;
  std::vector<int> ids;
  std::vector<Vec3s> velocities;
  for (int i = 0; i < 1000; ++i)
  {
    positions.emplace_back(std::sin(0.1f * i), std::cos(0.13f * i), 0.001f * i);
    ids.push_back(i);
    velocities.emplace_back(1.f * i, 2.f * i, 3.f * i);
  }
  const auto transform = math::Transform::createLinearTransform(0.25);
  const PointAttributeVector<Vec3s> places(positions);
  const auto index = tools::createPointIndexGrid<tools::PointIndexGrid>(places, *transform);
  auto grid = createPointDataGrid<NullCodec, PointDataGrid>(*index, places, *transform);
  appendAttribute<int>(grid->tree(), "id");
  populateAttribute(grid->tree(), index->tree(), "id", PointAttributeVector<int>(ids));
  appendAttribute<Vec3s>(grid->tree(), "v");
  populateAttribute(grid->tree(), index->tree(), "v", PointAttributeVector<Vec3s>(velocities));
  appendGroup(grid->tree(), "chosen");
  setGroup(grid->tree(), "chosen", true);
  grid->setName("points");
  const std::string file = EmptyFolder("vdb_points") + "points.vdb";
  Save(file, { grid });

  auto reader = MakeReader(file);
  reader->Update();
  vtkPolyData* data = reader->GetPolyDataOutput();
  EXPECT_TRUE(data != nullptr) << "poly data";
  EXPECT_EQ(std::string(reader->GetGridType(0)), std::string("points")) << "type";
  EXPECT_EQ(static_cast<int>(data->GetNumberOfPoints()), 1000) << "points";
  EXPECT_EQ(static_cast<int>(data->GetNumberOfVerts()), 1000) << "vertices";
  vtkDataArray* id = data->GetPointData()->GetArray("id");
  vtkDataArray* velocity = data->GetPointData()->GetArray("v");
  EXPECT_TRUE(id && velocity && data->GetPointData()->GetArray("chosen")) << "arrays";
  double miss = 0.0, sum = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const int number = static_cast<int>(id->GetComponent(i, 0));
    sum += data->GetPointData()->GetArray("chosen")->GetComponent(i, 0);
    for (int d = 0; d < 3; ++d)
    {
      miss = std::max(miss, std::fabs(data->GetPoint(i)[d] - positions[number][d]));
      miss = std::max(miss, std::fabs(velocity->GetComponent(i, d) - velocities[number][d]));
    }
  }
  EXPECT_LT(miss, 1e-6) << "each where its id was, to single precision";
  EXPECT_EQ(sum, 1000.0) << "in the group";
  reader->SetMaximumNumberOfPoints(999);
  const MessageCapture errors(reader);
  reader->Update();
  EXPECT_TRUE(errors.Has("1000 points")) << errors.GetLastError();
  EXPECT_EQ(static_cast<int>(reader->GetPolyDataOutput()->GetNumberOfPoints()), 0) << "points left";
}

TEST(TestVDBReader, AbsurdBoxesAreRefused)
{
  const std::string file = EmptyFolder("vdb_absurd") + "a.vdb";
  auto grid = MakeGrid<openvdb::FloatGrid>("a", 1.f);
  grid->tree().setValue(openvdb::Coord(1 << 29), 2.f);
  grid->tree().setValue(openvdb::Coord(-(1 << 29)), 2.f);
  Save(file, { grid });
  auto reader = MakeReader(file);
  const MessageCapture errors(reader);
  reader->Update();
  EXPECT_TRUE(errors.Has("MaximumNumberOfPoints")) << errors.GetLastError();
  reader->SetRegionToIndex();
  reader->SetIndexRegion(-4, 4, 4, 4, 5, 5);
  reader->Update();
  EXPECT_EQ(At(reader->GetImageOutput(), -3, 4, 5), 1.0) << "a region of it";
  reader->SetIndexRegion(-4, 2000000000, 4, 4, 5, 5);
  reader->Update();
  EXPECT_TRUE(errors.Has("beyond +-2^30")) << errors.GetLastError();
  reader->SetRegionToWorld();
  reader->SetWorldRegion(0.0, std::nan(""), 0.0, 1.0, 0.0, 1.0);
  reader->Update();
  EXPECT_TRUE(errors.Has("WorldRegion")) << errors.GetLastError();
}

// The sparse level set and the dense image give the same function.
TEST(TestVDBReader, LevelSetsStaySparse)
{
  const std::string file = EmptyFolder("vdb_sparse") + "ball.vdb";
  Save(file,
    { openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      1.f, openvdb::Vec3f(0.1f, 0.f, 0.f), 0.0625f) });
  auto sparse = MakeReader(file);
  sparse->OutputDenseOff();
  sparse->Update();
  auto dense = MakeReader(file);
  dense->Update();
  EXPECT_EQ(sparse->GetImageOutput()->GetPointData()->GetNumberOfArrays(), 0) << "arrays";
  vtkNew<vtkGridPotential> one, two;
  one->SetInput(sparse->GetImageOutput());
  two->SetInput(dense->GetImageOutput());
  double miss = 0.0;
  for (int i = 0; i < 1000; ++i)
  {
    double x[3] = { std::sin(0.7 * i), std::cos(1.1 * i), std::sin(1.3 * i + 1.0) };
    double g[3], h[3];
    one->EvaluateGradient(x, g);
    two->EvaluateGradient(x, h);
    miss = std::max(miss, std::fabs(one->EvaluateFunction(x) - two->EvaluateFunction(x)));
    miss = std::max(miss, std::fabs(g[0] - h[0]));
  }
  EXPECT_LT(miss, 1e-6) << "miss";
  double far[3] = { 1e300, 0.0, 0.0 };
  EXPECT_NEAR(one->EvaluateFunction(far), 0.1875, 1e-7) << "far away";
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputConnection(0, sparse->GetOutputPort());
  filter->SetInputConnection(1, sparse->GetOutputPort());
  filter->SetVoxelSize(0.0625);
  filter->Update();
  EXPECT_NEAR(GetSkinBounds(filter)[1], 1.1, 0.01) << "the skin starts on it";
}

TEST(TestVDBReader, WhatIsNoFileIsAnError)
{
  const std::string folder = EmptyFolder("vdb_no_file");
  std::ofstream(folder + "empty.vdb");
  std::ofstream(folder + "other.vdb") << "this is a text, not a .vdb file at all";
  auto good = MakeGrid<openvdb::FloatGrid>("a", 1.f);
  Save(folder + "good.vdb", { good });
  auto reader = MakeReader(folder + "good.vdb");
  const MessageCapture errors(reader);
  for (const auto& [name, words] : { std::pair{ "none.vdb", "no such file" },
         { "empty.vdb", "empty" }, { "other.vdb", "no .vdb" }, { "", "folder" } })
  {
    reader->SetFileName((folder + "good.vdb").c_str());
    reader->Update();
    EXPECT_GT(reader->GetImageOutput()->GetNumberOfPoints(), 0) << "points of the good file";
    reader->SetFileName((folder + name).c_str());
    reader->Update();
    EXPECT_TRUE(errors.Has(words)) << errors.GetLastError();
    EXPECT_TRUE(reader->GetErrorCode() != vtkErrorCode::NoError) << "code";
    EXPECT_EQ(static_cast<int>(reader->GetImageOutput()->GetNumberOfPoints()), 0) << "points left";
  }
  reader->ClearFileNames();
  reader->Update();
  EXPECT_TRUE(errors.Has("FileName is not set")) << errors.GetLastError();
}

}
