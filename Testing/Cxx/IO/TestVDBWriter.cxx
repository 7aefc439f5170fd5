// Contents of the files of vtkActiveVDBWriter, and inputs that it refuses.

#include "IO/GridFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"
#include "Support/PipelineTools.h"
#include "Support/SmallDisk.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkCubeSource.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

using namespace activesurface;

namespace TestVDBWriter
{

namespace
{

vtkSmartPointer<vtkActiveVDBWriter> MakeWriter(vtkAlgorithm* input, const std::string& file)
{
  auto writer = vtkSmartPointer<vtkActiveVDBWriter>::New();
  writer->SetInputConnection(input->GetOutputPort());
  writer->SetFileName(file.c_str());
  return writer;
}

}

TEST(TestVDBWriter, TheFileTellsWhatItIs)
{
  const std::string file = EmptyFolder("vdb_tells") + "ball.vdb";
  auto ball = MakeShrinkingBall();
  ball->SetTension(0.0625);
  ball->UpdateTimeStep(0.3);
  auto writer = MakeWriter(ball, file);
  writer->SetUnits("m");
  EXPECT_EQ(writer->Write(), 1) << "written";
  EXPECT_EQ(writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError)) << "code";
  const auto grid = Load(file, "surface");
  EXPECT_NEAR(grid->metaValue<double>("time"), 0.3, 1e-15) << "time";
  EXPECT_EQ(grid->metaValue<openvdb::Int32>("frame"), 3) << "frame";
  EXPECT_EQ(grid->metaValue<std::string>("units"), std::string("m")) << "units";
  EXPECT_EQ(grid->metaValue<double>("motion_Tension"), 0.0625) << "a property";
  EXPECT_TRUE(grid->getCreator().find("Active Implicit Surfaces") == 0) << "creator";
  EXPECT_TRUE(grid->getGridClass() == openvdb::GRID_LEVEL_SET) << "class";
  EXPECT_EQ(grid->voxelSize()[0], 0.0625) << "voxel size";
}

TEST(TestVDBWriter, StateGoesOnToTheSameBytes)
{
  const std::string file = EmptyFolder("vdb_state") + "state.vdb";
  auto whole = MakeSkinOver(MakeMovingBall());
  whole->UpdateTimeStep(2.0);
  auto writer = MakeWriter(whole, file);
  writer->WriteStateOn();
  writer->HalfFloatOn();
  EXPECT_EQ(writer->Write(), 1) << "written";
  auto next = MakeSkinOver(MakeMovingBall());
  EXPECT_TRUE(next->LoadState(file.c_str())) << "loaded";
  next->ResetCounters();
  const std::string bytes = GetBytesAt(next, 4.0);
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(whole, 4.0))) << "the same bytes";
  auto fromStart = MakeSkinOver(MakeMovingBall());
  fromStart->UpdateTimeStep(4.0);
  EXPECT_LT(next->GetSubsteps(), fromStart->GetSubsteps()) << "substeps";
}

TEST(TestVDBWriter, BetweenStepsThereIsNoState)
{
  const std::string folder = EmptyFolder("vdb_between");
  auto filter = MakeSkinOver(MakeMovingBall());
  filter->UpdateTimeStep(1.5);
  auto writer = MakeWriter(filter, folder + "a.vdb");
  EXPECT_EQ(writer->Write(), 1) << "without state";
  EXPECT_EQ(Load(folder + "a.vdb", "surface")->metaValue<double>("time"), 1.5) << "its time";
  writer->SetFileName((folder + "b.vdb").c_str());
  writer->WriteStateOn();
  const MessageCapture errors(writer);
  EXPECT_EQ(writer->Write(), 0) << "with state";
  EXPECT_TRUE(errors.Has("between two steps")) << errors.GetLastError();
  EXPECT_EQ(CountFiles(folder), 1u) << "files";
}

// The potential's port advances to a later time; the skin's port still carries the earlier state.
TEST(TestVDBWriter, PortsAtTwoTimesCarryTheirOwnStates)
{
  const std::string folder = EmptyFolder("vdb_ports");
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.1);
  MakeWriter(filter, folder + "before.vdb")->Write();
  vtkInformation* port = filter->GetOutputInformation(1);
  port->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 0.6);
  filter->Update(1);
  vtkNew<vtkActiveVDBWriter> writer;
  writer->SetInputData(filter->GetOutput());
  writer->SetFileName((folder + "after.vdb").c_str());
  EXPECT_EQ(writer->Write(), 1) << "written";
  writer->SetInputData(filter->GetPotential());
  writer->SetFileName((folder + "later.vdb").c_str());
  EXPECT_EQ(writer->Write(), 1) << "written from the potential";
  const auto value = [&](const char* name)
  { return Load(folder + name, "surface")->tree().getValue(openvdb::Coord(8, 0, 0)); };
  EXPECT_EQ(value("after.vdb"), value("before.vdb")) << "of the skin";
  EXPECT_LT(value("before.vdb") + 0.05, value("later.vdb")) << "of the potential";
}

TEST(TestVDBWriter, DensityVelocityAndArraysAreThere)
{
  const std::string file = EmptyFolder("vdb_arrays") + "ball.vdb";
  auto ball = MakeShrinkingBall();
  ball->ComputeVelocityOn();
  ball->ComputeCurvatureOn();
  ball->UpdateTimeStep(0.1);
  auto writer = MakeWriter(ball, file);
  writer->WriteDensityOn();
  writer->WriteVelocityOn();
  writer->WritePointArraysOn();
  EXPECT_EQ(writer->Write(), 1) << "written";
  const auto surface = Load(file, "surface");
  const auto density = Load(file, "density");
  const auto velocity = Load<openvdb::Vec3SGrid>(file, "v");
  const auto curvature = Load(file, "MeanCurvature");
  EXPECT_TRUE(Load<openvdb::Vec3SGrid>(file, "Velocity") != nullptr) << "the array by its own name";
  EXPECT_EQ(density->tree().getValue(openvdb::Coord(0)), 1.f) << "density inside";
  EXPECT_TRUE(density->getGridClass() == openvdb::GRID_FOG_VOLUME) << "a fog";
  EXPECT_EQ(velocity->activeVoxelCount(), surface->activeVoxelCount())
    << "the velocity is near the surface";
  // The ball shrinks, so the velocity on the x axis is along -x.
  const openvdb::Vec3s v = velocity->tree().getValue(openvdb::Coord(9, 0, 0));
  EXPECT_LT(v[0], -0.05) << "velocity on the x axis";
  EXPECT_NEAR(v[1], 0.0, 0.05 * std::fabs(v[0])) << "across";
  const double radius = GetSkinBounds(ball)[1];
  EXPECT_NEAR(curvature->tree().getValue(openvdb::Coord(9, 0, 0)), 2.0 / radius, 0.1 / radius)
    << "curvature";
}

TEST(TestVDBWriter, HalfFloatsAreWithinTheirPrecision)
{
  const std::string folder = EmptyFolder("vdb_half");
  auto ball = MakeShrinkingBall();
  auto writer = MakeWriter(ball, folder + "whole.vdb");
  writer->Write();
  writer->HalfFloatOn();
  writer->SetFileName((folder + "half.vdb").c_str());
  writer->Write();
  const auto whole = Load(folder + "whole.vdb", "surface");
  const auto half = Load(folder + "half.vdb", "surface");
  double largest = 0.0;
  for (auto value = whole->cbeginValueOn(); value; ++value)
  {
    const double halved = half->tree().getValue(value.getCoord());
    largest = std::max(largest, std::fabs(halved - *value) / std::fabs(*value));
  }
  EXPECT_GT(largest, 0.0) << "they differ";
  EXPECT_LT(largest, 1.0 / 2048 + 1e-6) << "by the eleventh bit";
  EXPECT_LT(ReadFile(folder + "half.vdb").size(), ReadFile(folder + "whole.vdb").size()) << "size";
}

TEST(TestVDBWriter, AllCompressionsAreLossless)
{
  const std::string folder = EmptyFolder("vdb_compression");
  auto ball = MakeShrinkingBall();
  auto writer = MakeWriter(ball, "");
  writer->WriteStateOn();
  ball->UpdateTimeStep(0.1);
  openvdb::FloatGrid::Ptr grids[4];
  for (int i = 0; i < 4; ++i)
  {
    const std::string file = folder + std::to_string(i) + ".vdb";
    writer->SetFileName(file.c_str());
    writer->SetCompression(i);
    EXPECT_EQ(writer->Write(), 1) << "written";
    grids[i] = Load(file, "potential");
    int different = 0;
    for (auto value = grids[0]->cbeginValueAll(); value; ++value)
    {
      different += grids[i]->tree().getValue(value.getCoord()) != *value ? 1 : 0;
    }
    EXPECT_EQ(different, 0) << "values";
  }
}

TEST(TestVDBWriter, SeriesHaveAFileForEachStep)
{
  const std::string folder = EmptyFolder("vdb_series");
  auto writer = MakeWriter(MakeShrinkingBall(), folder + "ball.vdb");
  writer->WriteAllTimeStepsOn();
  EXPECT_EQ(writer->Write(), 1) << "written";
  EXPECT_EQ(CountFiles(folder), 11u) << "files";
  EXPECT_NEAR(Load(folder + "ball.0010.vdb", "surface")->metaValue<double>("time"), 1.0, 1e-15)
    << "the last time";
  writer->SetFileName((folder + "b##.x.vdb").c_str());
  EXPECT_EQ(writer->Write(), 1) << "written by another pattern";
  EXPECT_TRUE(std::filesystem::exists(folder + "b07.x.vdb")) << "the name";
}

TEST(TestVDBWriter, AnInputThatFailsLeavesTheFilesBefore)
{
  const std::string folder = EmptyFolder("vdb_failing");
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  const MessageCapture quiet(filter);
  const MessageCapture quietSource(source);
  source->SetFailingExecution(3);
  auto writer = MakeWriter(filter, folder + "a.vdb");
  writer->WriteAllTimeStepsOn();
  const MessageCapture errors(writer);
  EXPECT_EQ(writer->Write(), 0) << "fails";
  EXPECT_TRUE(errors.Has("update of the input failed")) << errors.GetLastError();
  EXPECT_TRUE(writer->GetErrorCode() != vtkErrorCode::NoError) << "code";
  EXPECT_GT(CountFiles(folder), 0u) << "files before";
  EXPECT_LT(CountFiles(folder), 5u) << "files after";
}

TEST(TestVDBWriter, WhatCannotBeWrittenIsAnErrorAndNoFile)
{
  const std::string folder = EmptyFolder("vdb_errors");
  auto ball = MakeShrinkingBall();
  const auto refuses = [&](const std::string& file, const std::string& words)
  {
    auto writer = MakeWriter(ball, file);
    const MessageCapture errors(writer);
    EXPECT_EQ(writer->Write(), 0) << file;
    EXPECT_TRUE(errors.Has(words)) << errors.GetLastError();
    EXPECT_TRUE(writer->GetErrorCode() != vtkErrorCode::NoError) << "code";
  };
  refuses("", "FileName is not set");
  refuses(folder + "none/a.vdb", "cannot be written");
  refuses(folder, "folder");
  refuses("/proc/a.vdb", "cannot be written");
  EXPECT_EQ(CountFiles(folder), 0u) << "files";
  MakeWriter(ball, folder + "a.vdb")->Write();
  const std::string before = ReadFile(folder + "a.vdb");
  EXPECT_GT(before.size(), 20000u) << "size";
  for (const rlim_t size : { 0, 1000, 20000 })
  {
    const SmallDisk disk(size);
    refuses(folder + "a.vdb", "space");
  }
  EXPECT_TRUE(ReadFile(folder + "a.vdb") == before) << "the file before is still there";
  EXPECT_EQ(CountFiles(folder), 1u) << "and no other";
}

TEST(TestVDBWriter, MeshesHaveToBeClosed)
{
  const std::string folder = EmptyFolder("vdb_mesh");
  vtkNew<vtkCubeSource> cube; // each face has points of its own
  auto writer = MakeWriter(cube, folder + "cube.vdb");
  writer->SetVoxelSize(0.05);
  EXPECT_EQ(writer->Write(), 1) << "a cube";
  const auto grid = Load(folder + "cube.vdb", "surface");
  EXPECT_NEAR(grid->tree().getValue(openvdb::Coord(8, 0, 0)), -0.1, 1e-6) << "inside";
  EXPECT_NEAR(grid->tree().getValue(openvdb::Coord(11, 0, 0)), 0.05, 1e-6) << "outside";
  vtkNew<vtkSphereSource> bowl;
  bowl->SetEndTheta(180.0);
  writer = MakeWriter(bowl, folder + "bowl.vdb");
  const MessageCapture errors(writer);
  EXPECT_EQ(writer->Write(), 0) << "half a sphere";
  EXPECT_TRUE(errors.Has("not closed")) << errors.GetLastError();
}

TEST(TestVDBWriter, ImagesComeBackBitByBit)
{
  const std::string file = EmptyFolder("vdb_image") + "image.vdb";
  vtkNew<vtkImageData> image;
  image->SetExtent(-3, 17, 2, 12, -20, -5);
  image->SetSpacing(0.5, 0.25, 2.0);
  image->SetOrigin(1.0, -2.0, 3.0);
  for (const int components : { 1, 3 })
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(components == 1 ? "a" : "b");
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      array->SetValue(i, std::sin(0.1f * i) + 2.f);
    }
    array->SetValue(0, std::nanf("")); // NaN survives
    image->GetPointData()->AddArray(array);
  }
  vtkNew<vtkActiveVDBWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->WritePointArraysOn();
  EXPECT_EQ(writer->Write(), 1) << "written";
  vtkNew<vtkActiveVDBReader> reader;
  reader->SetFileName(file.c_str());
  reader->AddGridName("a");
  reader->AddGridName("b");
  reader->Update();
  vtkImageData* back = reader->GetImageOutput();
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(back->GetExtent()[i], image->GetExtent()[i]) << "extent";
    EXPECT_EQ(back->GetBounds()[i], image->GetBounds()[i]) << "bounds";
  }
  for (const char* name : { "a", "b" })
  {
    auto was = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name));
    auto is = vtkFloatArray::SafeDownCast(back->GetPointData()->GetArray(name));
    EXPECT_TRUE(is && is->GetNumberOfValues() == was->GetNumberOfValues() &&
      std::memcmp(is->GetPointer(0), was->GetPointer(0), 4 * was->GetNumberOfValues()) == 0)
      << "the same bytes";
  }
}

}
