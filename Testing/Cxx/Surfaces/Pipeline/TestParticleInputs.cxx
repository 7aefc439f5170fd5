// Particles in tables and in blocks give the same skins as one vtkPolyData with these particles.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestParticleInputs
{

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
using Names = std::array<const char*, 3>;

// All coordinates are exact in single precision, which the points of MakeCloud have.
std::vector<Particle> Drops(double time = 0.0)
{
  return { { -0.25 - 0.125 * time, 0.0, 0.125, 4 }, { 0.25 + 0.125 * time, 0.0, 0.0, 7 },
    { 0.0, 0.25, 0.125 * time, 9 } };
}

template <class Array = vtkDoubleArray>
vtkSmartPointer<Array> MakeColumn(const char* name, const std::vector<double>& values)
{
  auto column = vtkSmartPointer<Array>::New();
  column->SetName(name);
  for (const double value : values)
  {
    column->InsertNextValue(static_cast<typename Array::ValueType>(value));
  }
  return column;
}

vtkSmartPointer<vtkPolyData> MakeCloud(const std::vector<Particle>& particles)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  auto ids = MakeColumn<vtkIntArray>("id", {});
  auto heat = MakeColumn("heat", {});
  for (const Particle& particle : particles)
  {
    points->InsertNextPoint(particle.X, particle.Y, particle.Z);
    ids->InsertNextValue(particle.Id);
    heat->InsertNextValue(0.5 * particle.Id);
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(ids);
  cloud->GetPointData()->AddArray(heat);
  return cloud;
}

template <class Array = vtkDoubleArray>
vtkSmartPointer<vtkTable> MakeTable(const std::vector<Particle>& particles, const Names& names)
{
  std::array<std::vector<double>, 5> values;
  for (const Particle& particle : particles)
  {
    const double row[] = { particle.X, particle.Y, particle.Z, double(particle.Id),
      0.5 * particle.Id };
    for (int i = 0; i < 5; ++i)
    {
      values[i].push_back(row[i]);
    }
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(MakeColumn<vtkIntArray>("id", values[3]));
  for (const int i : { 2, 0, 1 })
  {
    table->AddColumn(MakeColumn<Array>(names[i], values[i]));
  }
  table->AddColumn(MakeColumn("heat", values[4]));
  return table;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOf(vtkDataObject* data)
{
  auto filter = MakeSkin();
  filter->SetInputDataObject(data);
  filter->PassTargetArraysOn();
  return filter;
}

std::string GetAllBytes(vtkActiveImplicitSurface* filter)
{
  filter->UpdateTimeStep(0.2);
  return GetBytes(filter) + GetArrayBytes(filter);
}

void IsLikeTheCloud(vtkDataObject* data, const std::string& name)
{
  auto cloud = MakeSkinOf(MakeCloud(Drops()));
  auto filter = MakeSkinOf(data);
  MessageCapture messages(filter);
  EXPECT_TRUE(AreSameSkins(GetAllBytes(filter), GetAllBytes(cloud))) << name;
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(),
    cloud->GetOutput()->GetPointData()->GetNumberOfArrays())
    << "arrays, " << name;
  EXPECT_EQ(messages.CountAll(), 0u) << "messages, " << name;
}

void Refuses(vtkDataObject* data, const std::string& words)
{
  auto filter = MakeSkinOf(data);
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_EQ(MessageCapture::Count(messages.Errors, words), 1) << "errors with \"" << words << "\"";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points, " << words;
}

std::vector<vtkSmartPointer<vtkDataObject>> Split()
{
  const std::vector<Particle> drops = Drops();
  return { MakeCloud({ drops[0] }), MakeCloud({ drops[1], drops[2] }) };
}

}

TEST(TestParticleInputs, TablesAreParticles)
{
  const Names usual = { "x", "y", "z" };
  IsLikeTheCloud(MakeTable(Drops(), usual), "x y z");
  IsLikeTheCloud(MakeTable<vtkFloatArray>(Drops(), usual), "x y z of single precision");
  IsLikeTheCloud(MakeTable(Drops(), { "X", "Y", "Z" }), "X Y Z");
  IsLikeTheCloud(MakeTable(Drops(), { "Points:0", "Points:1", "Points:2" }), "Points:0");
  IsLikeTheCloud(MakeTable(Drops(), { "points_0", "points_1", "points_2" }), "points_0");
  IsLikeTheCloud(MakeTable(Drops(), { "Pos.X", "Pos.Y", "Pos.Z" }), "Pos.X");
  IsLikeTheCloud(
    MakeTable(Drops(), { "position x (m)", "position y (m)", "position z (m)" }), "position x (m)");
}

TEST(TestParticleInputs, OneColumnOfThreeNumbersIsPositionsToo)
{
  auto table = MakeTable(Drops(), { "x", "y", "z" });
  vtkNew<vtkDoubleArray> places;
  places->SetName("Points");
  places->SetNumberOfComponents(3);
  for (const Particle& drop : Drops())
  {
    places->InsertNextTuple3(drop.X, drop.Y, drop.Z);
  }
  for (const char* name : { "x", "y", "z" })
  {
    table->RemoveColumnByName(name);
  }
  table->AddColumn(places);
  IsLikeTheCloud(table, "Points");
}

TEST(TestParticleInputs, ColumnsOfWholeNumbersAreExact)
{
  const std::vector<Particle> whole = { { 0, 0, 0, 1 }, { 1, 0, 0, 2 } };
  auto filter = MakeSkinOf(MakeTable<vtkIntArray>(whole, { "x", "y", "z" }));
  auto cloud = MakeSkinOf(MakeCloud(whole));
  EXPECT_TRUE(AreSameSkins(GetAllBytes(filter), GetAllBytes(cloud)));
}

TEST(TestParticleInputs, ColumnsAreArrays)
{
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_ROWS })
  {
    auto table = MakeTable(Drops(), { "x", "y", "z" });
    table->AddColumn(MakeColumn("r", { 0.3, 0.35, 0.4 }));
    auto filter = MakeSkinOf(table);
    filter->SetInputArrayToProcess(0, 0, 0, association, "r");
    vtkSmartPointer<vtkPolyData> cloud = MakeCloud(Drops());
    cloud->GetPointData()->AddArray(MakeColumn("r", { 0.3, 0.35, 0.4 }));
    auto other = MakeSkinOf(cloud);
    other->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "r");
    EXPECT_TRUE(AreSameSkins(GetAllBytes(filter), GetAllBytes(other)));
  }
}

TEST(TestParticleInputs, ThreeColumnsOfAVectorAreOne)
{
  auto table = MakeTable(Drops(), { "x", "y", "z" });
  table->AddColumn(MakeColumn("vel:0", { 1.0, 2.0, 3.0 }));
  table->AddColumn(MakeColumn("vel:1", { 0.0, 0.0, 0.0 }));
  table->AddColumn(MakeColumn("vel:2", { 4.0, 5.0, 6.0 }));
  table->AddColumn(MakeColumn("lux", { 1.0, 1.0, 1.0 }));
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  names->SetNumberOfValues(3);
  table->AddColumn(names);
  auto filter = MakeSkinOf(table);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.2);
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  ASSERT_NE(arrays->GetArray("vel"), nullptr);
  EXPECT_EQ(arrays->GetArray("vel")->GetNumberOfComponents(), 3);
  EXPECT_NE(arrays->GetArray("lux"), nullptr) << "which is no component x of \"lu\"";
  EXPECT_NE(arrays->GetAbstractArray("name"), nullptr);
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

TEST(TestParticleInputs, TablesWithoutPositionsAreErrors)
{
  Refuses(vtkNew<vtkTable>(), "The table has no positions: particles need columns x, y and z");
  auto table = MakeTable(Drops(), { "x", "y", "w" });
  Refuses(table, "its columns are: id, w, x, y, heat.");
  table->RemoveColumnByName("w");
  Refuses(table, "The table has no positions: particles need columns x, y and z");
  vtkNew<vtkStringArray> text;
  text->SetName("z");
  text->SetNumberOfValues(3);
  table->AddColumn(text);
  Refuses(
    table, "The column \"z\" of the table cannot be used for positions or vectors of particles");
  table->RemoveColumnByName("z");
  table->GetRowData()->AddArray(MakeColumn("z", { 0.0 }));
  Refuses(table, "which need a number in each row");
}

TEST(TestParticleInputs, NumbersThatAreNotFiniteAreLeftOut)
{
  auto table = MakeTable(Drops(), { "x", "y", "z" });
  table->InsertNextBlankRow();
  for (const char* name : { "x", "y", "z" })
  {
    table->SetValueByName(3, name, NaN);
  }
  auto filter = MakeSkinOf(table);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.2);
  EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(MakeSkinOf(MakeCloud(Drops())), 0.2)));
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "1 particle is left out"), 1) << "warnings";
}

// VTK's composite pipeline would otherwise execute the filter once for each block.
TEST(TestParticleInputs, BlocksAreParticlesInTheirOrder)
{
  const auto parts = Split();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  blocks->SetBlock(1, parts[0]);
  blocks->SetBlock(2, nullptr);
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, parts[1]);
  nested->SetBlock(1, vtkNew<vtkUnstructuredGrid>());
  blocks->SetBlock(3, nested);
  IsLikeTheCloud(blocks, "multi-block");

  vtkNew<vtkPartitionedDataSet> partitions;
  partitions->SetPartition(0, parts[0]);
  partitions->SetPartition(1, parts[1]);
  IsLikeTheCloud(partitions, "partitions");

  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(2);
  collection->SetPartition(0, 0, parts[0]);
  collection->SetPartition(1, 0, parts[1]);
  IsLikeTheCloud(collection, "collection");

  vtkNew<vtkMultiBlockDataSet> tables;
  tables->SetBlock(0, MakeTable({ Drops()[0] }, { "x", "y", "z" }));
  tables->SetBlock(1, parts[1]);
  IsLikeTheCloud(tables, "a table and a cloud");
}

TEST(TestParticleInputs, OnlyArraysOfAllBlocksArePassed)
{
  const auto parts = Split();
  auto second = vtkPolyData::SafeDownCast(parts[1]);
  second->GetPointData()->RemoveArray("heat");
  second->GetPointData()->RemoveArray("id");
  second->GetPointData()->AddArray(MakeColumn<vtkFloatArray>("id", { 7, 9 }));
  second->GetPointData()->AddArray(MakeColumn("r", { 0.3, 0.3 }));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, parts[0]);
  blocks->SetBlock(1, second);
  auto filter = MakeSkinOf(blocks);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.2);
  for (const char* name : { "heat", "id", "r" })
  {
    EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray(name), nullptr) << name;
  }
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "r");
  filter->UpdateTimeStep(0.2);
  EXPECT_EQ(
    MessageCapture::Count(messages.Errors, "The input of port 0 has no point array as chosen"), 1)
    << "errors of an array that one block lacks";
}

TEST(TestParticleInputs, OneBlockAloneMayBeOfAnyKind)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(1, MakeBallImage(0.4));
  auto filter = MakeSkinOf(blocks);
  filter->PassTargetArraysOff();
  filter->UpdateTimeStep(0.0);
  EXPECT_NEAR(GetRadii(filter).Largest, 0.4, 0.05 * 0.05) << "an image";
  blocks->SetBlock(1, MakeBallMesh(0.3));
  filter->UpdateTimeStep(0.0);
  EXPECT_NEAR(GetRadii(filter).Largest, 0.3, 0.05 * 0.05) << "a mesh";
  blocks->SetBlock(2, MakeCloud(Drops()));
  Refuses(blocks, "The block 2 of the input is no set of particles, but a vtkPolyData with other");
  blocks->SetBlock(1, MakeBallImage(0.3));
  Refuses(blocks, "The block 2 of the input is no set of particles, but a vtkImageData;");
  blocks->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "wall");
  Refuses(blocks, "The block 2, wall, of the input is no set of particles, but a vtkImageData;");
}

TEST(TestParticleInputs, WithoutRowsOrPointsThereAreNoParticles)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  const vtkSmartPointer<vtkTable> table = MakeTable({}, { "x", "y", "z" });
  for (vtkDataObject* data : std::initializer_list<vtkDataObject*>{ blocks, table })
  {
    auto filter = MakeSkinOf(data);
    MessageCapture messages(filter);
    filter->Update();
    EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  }
}

// The class may change from frame to frame.
TEST(TestParticleInputs, TablesAndBlocksArePushedToo)
{
  const auto prepare = []
  {
    auto filter = MakeSkin();
    filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
    return filter;
  };
  auto filter = prepare(), clouds = prepare();
  vtkNew<vtkMultiBlockDataSet> blocks;
  const std::vector<Particle> last = Drops(2.0);
  blocks->SetBlock(0, MakeCloud({ last[0] }));
  blocks->SetBlock(1, MakeCloud({ last[1], last[2] }));
  const std::vector<vtkSmartPointer<vtkDataObject>> frames = {
    MakeTable(Drops(), { "x", "y", "z" }), MakeTable(Drops(1.0), { "x", "y", "z" }), blocks.Get()
  };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_TRUE(filter->Advance(frames[i], 0.1)) << i;
    EXPECT_TRUE(clouds->Advance(MakeCloud(Drops(i)), 0.1)) << i;
    EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytes(clouds))) << "frame " << i;
  }
}

TEST(TestParticleInputs, ASkeletonPotentialReadsThemToo)
{
  vtkNew<vtkSkeletonPotential> expected;
  expected->SetInput(MakeCloud(Drops()));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, Split()[0]);
  blocks->SetBlock(1, Split()[1]);
  const vtkSmartPointer<vtkTable> table = MakeTable(Drops(), { "x", "y", "z" });
  for (vtkDataObject* data : std::initializer_list<vtkDataObject*>{ blocks, table })
  {
    vtkNew<vtkTrivialProducer> producer;
    producer->SetOutput(data);
    vtkNew<vtkSkeletonPotential> potential;
    potential->SetInputConnection(producer->GetOutputPort());
    EXPECT_EQ(potential->FunctionValue(0.1, 0.2, 0.0), expected->FunctionValue(0.1, 0.2, 0.0));
    EXPECT_LT(potential->FunctionValue(0.25, 0.0, 0.0), 0.0) << "inside";
  }
}

}
