// What a vtkActiveVDBWriter puts into files, and what it refuses.

#include "Check.h"
#include "GridFiles.h"
#include "PipelineTools.h"
#include "SmallDisk.h"

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

#include <cmath>
#include <cstring>

using namespace activesurface;

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

void TheFileTellsWhatItIs(Check& check)
{
  const std::string file = EmptyFolder("vdb_tells") + "ball.vdb";
  auto ball = MakeShrinkingBall();
  ball->SetTension(0.0625);
  ball->UpdateTimeStep(0.3);
  auto writer = MakeWriter(ball, file);
  writer->SetUnits("m");
  check.Equal(writer->Write(), 1, "written");
  check.Equal(writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError), "code");
  const auto grid = Load(file, "surface");
  check.Near(grid->metaValue<double>("time"), 0.3, 1e-15, "time");
  check.Equal(grid->metaValue<openvdb::Int32>("frame"), 3, "frame");
  check.Equal(grid->metaValue<std::string>("units"), std::string("m"), "units");
  check.Equal(grid->metaValue<double>("motion_Tension"), 0.0625, "a property");
  check.True(grid->getCreator().find("Active Implicit Surfaces") == 0, "creator");
  check.True(grid->getGridClass() == openvdb::GRID_LEVEL_SET, "class");
  check.Equal(grid->voxelSize()[0], 0.0625, "voxel size");
}

void StateGoesOnToTheSameBytes(Check& check)
{
  const std::string file = EmptyFolder("vdb_state") + "state.vdb";
  auto whole = MakeSkinOver(MakeMovingBall());
  whole->UpdateTimeStep(2.0);
  auto writer = MakeWriter(whole, file);
  writer->WriteStateOn();
  writer->HalfFloatOn();
  check.Equal(writer->Write(), 1, "written");
  auto next = MakeSkinOver(MakeMovingBall());
  check.True(next->LoadState(file.c_str()), "loaded");
  next->ResetCounters();
  const std::string bytes = GetBytesAt(next, 4.0);
  check.True(bytes == GetBytesAt(whole, 4.0), "the same bytes");
  auto fromStart = MakeSkinOver(MakeMovingBall());
  fromStart->UpdateTimeStep(4.0);
  check.Less(next->GetSubsteps(), fromStart->GetSubsteps(), "substeps");
}

void BetweenStepsThereIsNoState(Check& check)
{
  const std::string folder = EmptyFolder("vdb_between");
  auto filter = MakeSkinOver(MakeMovingBall());
  filter->UpdateTimeStep(1.5);
  auto writer = MakeWriter(filter, folder + "a.vdb");
  check.Equal(writer->Write(), 1, "without state");
  check.Equal(Load(folder + "a.vdb", "surface")->metaValue<double>("time"), 1.5, "its time");
  writer->SetFileName((folder + "b.vdb").c_str());
  writer->WriteStateOn();
  const ErrorsOf errors(writer);
  check.Equal(writer->Write(), 0, "with state");
  check.True(errors.Has("between two steps"), errors.Last());
  check.Equal(CountFiles(folder), std::size_t(1), "files");
}

// The potential's port goes on to a later time; what the skin's carries is still the skin's.
void PortsAtTwoTimesCarryTheirOwnStates(Check& check)
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
  check.Equal(writer->Write(), 1, "written");
  writer->SetInputData(filter->GetPotential());
  writer->SetFileName((folder + "later.vdb").c_str());
  check.Equal(writer->Write(), 1, "written from the potential");
  const auto value = [&](const char* name)
  { return Load(folder + name, "surface")->tree().getValue(openvdb::Coord(8, 0, 0)); };
  check.Equal(value("after.vdb"), value("before.vdb"), "of the skin");
  check.Less(value("before.vdb") + 0.05, value("later.vdb"), "of the potential");
}

void DensityVelocityAndArraysAreThere(Check& check)
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
  check.Equal(writer->Write(), 1, "written");
  const auto surface = Load(file, "surface");
  const auto density = Load(file, "density");
  const auto velocity = Load<openvdb::Vec3SGrid>(file, "v");
  const auto curvature = Load(file, "MeanCurvature");
  check.True(Load<openvdb::Vec3SGrid>(file, "Velocity") != nullptr, "the array by its own name");
  check.Equal(density->tree().getValue(openvdb::Coord(0)), 1.f, "density inside");
  check.True(density->getGridClass() == openvdb::GRID_FOG_VOLUME, "a fog");
  check.Equal(
    velocity->activeVoxelCount(), surface->activeVoxelCount(), "the velocity is near the surface");
  // It shrinks: the velocity is along -x on the x axis, and that of the skin's speed.
  const openvdb::Vec3s v = velocity->tree().getValue(openvdb::Coord(9, 0, 0));
  check.Less(v[0], -0.05, "velocity on the x axis");
  check.Near(v[1], 0.0, 0.05 * std::fabs(v[0]), "across");
  const double radius = GetSkinBounds(ball)[1];
  // Of the skin's own curvatures, second order: 5 percent at 10 voxels of radius.
  check.Near(
    curvature->tree().getValue(openvdb::Coord(9, 0, 0)), 2.0 / radius, 0.1 / radius, "curvature");
}

void HalfFloatsAreWithinTheirPrecision(Check& check)
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
  check.Less(0.0, largest, "they differ");
  check.Less(largest, 1.0 / 2048 + 1e-6, "by the eleventh bit");
  check.Less(ReadFile(folder + "half.vdb").size(), ReadFile(folder + "whole.vdb").size(), "size");
}

void AllCompressionsAreLossless(Check& check)
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
    check.Equal(writer->Write(), 1, "written");
    grids[i] = Load(file, "potential");
    int different = 0;
    for (auto value = grids[0]->cbeginValueAll(); value; ++value)
    {
      different += grids[i]->tree().getValue(value.getCoord()) != *value ? 1 : 0;
    }
    check.Equal(different, 0, "values");
  }
}

void SeriesHaveAFileForEachStep(Check& check)
{
  const std::string folder = EmptyFolder("vdb_series");
  auto writer = MakeWriter(MakeShrinkingBall(), folder + "ball.vdb");
  writer->WriteAllTimeStepsOn();
  check.Equal(writer->Write(), 1, "written");
  check.Equal(CountFiles(folder), std::size_t(11), "files");
  check.Near(Load(folder + "ball.0010.vdb", "surface")->metaValue<double>("time"), 1.0, 1e-15,
    "the last time");
  writer->SetFileName((folder + "b##.x.vdb").c_str());
  check.Equal(writer->Write(), 1, "written by another pattern");
  check.True(std::filesystem::exists(folder + "b07.x.vdb"), "the name");
}

void AnInputThatFailsLeavesTheFilesBefore(Check& check)
{
  const std::string folder = EmptyFolder("vdb_failing");
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  const Messages quiet(filter);
  const ErrorsOf quietSource(source);
  source->SetFailingExecution(3);
  auto writer = MakeWriter(filter, folder + "a.vdb");
  writer->WriteAllTimeStepsOn();
  const ErrorsOf errors(writer);
  check.Equal(writer->Write(), 0, "fails");
  check.True(errors.Has("input has failed"), errors.Last());
  check.True(writer->GetErrorCode() != vtkErrorCode::NoError, "code");
  check.Less(0, CountFiles(folder), "files before");
  check.Less(CountFiles(folder), 5, "files after");
}

void WhatCannotBeWrittenIsAnErrorAndNoFile(Check& check)
{
  const std::string folder = EmptyFolder("vdb_errors");
  auto ball = MakeShrinkingBall();
  const auto refuses = [&](const std::string& file, const std::string& words)
  {
    auto writer = MakeWriter(ball, file);
    const ErrorsOf errors(writer);
    check.Equal(writer->Write(), 0, file);
    check.True(errors.Has(words), errors.Last());
    check.True(writer->GetErrorCode() != vtkErrorCode::NoError, "code");
  };
  refuses("", "no FileName");
  refuses(folder + "none/a.vdb", "cannot be written");
  refuses(folder, "folder");
  refuses("/proc/a.vdb", "cannot be written");
  check.Equal(CountFiles(folder), std::size_t(0), "files");
  MakeWriter(ball, folder + "a.vdb")->Write();
  const std::string before = ReadFile(folder + "a.vdb");
  check.Less(20000, before.size(), "size");
  for (const rlim_t size : { 0, 1000, 20000 })
  {
    const SmallDisk disk(size);
    refuses(folder + "a.vdb", "room");
  }
  check.True(ReadFile(folder + "a.vdb") == before, "the file before is still there");
  check.Equal(CountFiles(folder), std::size_t(1), "and no other");
}

void MeshesHaveToBeClosed(Check& check)
{
  const std::string folder = EmptyFolder("vdb_mesh");
  vtkNew<vtkCubeSource> cube; // whose faces have points of their own
  auto writer = MakeWriter(cube, folder + "cube.vdb");
  writer->SetVoxelSize(0.05);
  check.Equal(writer->Write(), 1, "a cube");
  const auto grid = Load(folder + "cube.vdb", "surface");
  check.Near(grid->tree().getValue(openvdb::Coord(8, 0, 0)), -0.1, 1e-6, "inside");
  check.Near(grid->tree().getValue(openvdb::Coord(11, 0, 0)), 0.05, 1e-6, "outside");
  vtkNew<vtkSphereSource> bowl;
  bowl->SetEndTheta(180.0);
  writer = MakeWriter(bowl, folder + "bowl.vdb");
  const ErrorsOf errors(writer);
  check.Equal(writer->Write(), 0, "half a sphere");
  check.True(errors.Has("not closed"), errors.Last());
}

void ImagesComeBackBitByBit(Check& check)
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
    array->SetValue(0, std::nanf("")); // survives
    image->GetPointData()->AddArray(array);
  }
  vtkNew<vtkActiveVDBWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->WritePointArraysOn();
  check.Equal(writer->Write(), 1, "written");
  vtkNew<vtkActiveVDBReader> reader;
  reader->SetFileName(file.c_str());
  reader->AddGridName("a");
  reader->AddGridName("b");
  reader->Update();
  vtkImageData* back = reader->GetImageOutput();
  for (int i = 0; i < 6; ++i)
  {
    check.Equal(back->GetExtent()[i], image->GetExtent()[i], "extent");
    check.Equal(back->GetBounds()[i], image->GetBounds()[i], "bounds");
  }
  for (const char* name : { "a", "b" })
  {
    auto was = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name));
    auto is = vtkFloatArray::SafeDownCast(back->GetPointData()->GetArray(name));
    check.True(is && is->GetNumberOfValues() == was->GetNumberOfValues() &&
        std::memcmp(is->GetPointer(0), was->GetPointer(0), 4 * was->GetNumberOfValues()) == 0,
      "the same bytes");
  }
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "TheFileTellsWhatItIs", TheFileTellsWhatItIs },
      { "StateGoesOnToTheSameBytes", StateGoesOnToTheSameBytes },
      { "BetweenStepsThereIsNoState", BetweenStepsThereIsNoState },
      { "PortsAtTwoTimesCarryTheirOwnStates", PortsAtTwoTimesCarryTheirOwnStates },
      { "DensityVelocityAndArraysAreThere", DensityVelocityAndArraysAreThere },
      { "HalfFloatsAreWithinTheirPrecision", HalfFloatsAreWithinTheirPrecision },
      { "AllCompressionsAreLossless", AllCompressionsAreLossless },
      { "SeriesHaveAFileForEachStep", SeriesHaveAFileForEachStep },
      { "AnInputThatFailsLeavesTheFilesBefore", AnInputThatFailsLeavesTheFilesBefore },
      { "WhatCannotBeWrittenIsAnErrorAndNoFile", WhatCannotBeWrittenIsAnErrorAndNoFile },
      { "MeshesHaveToBeClosed", MeshesHaveToBeClosed },
      { "ImagesComeBackBitByBit", ImagesComeBackBitByBit } });
}
