// Checkpoints reduce the cost of earlier times, and never change a result.

#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"
#include "Support/PipelineTools.h"
#include "Support/SmallDisk.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "Leaves/LeafTable.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestCheckpoints
{

// Two drops that meet and separate again, and a third one that does not move, in 31 steps.
vtkSmartPointer<ParticleSource> MakeDrops()
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  std::vector<double> steps;
  for (int i = 0; i <= 30; ++i)
  {
    steps.push_back(0.1 * i);
  }
  source->SetSteps(steps);
  source->SetCloud(
    [](double time) -> std::vector<Particle>
    {
      const double apart = 0.1 + 0.25 * std::fabs(time - 1.5);
      return { { -apart, 0.0, 0.02, 1 }, { apart, 0.03, 0.0, 2 }, { 0.0, 0.9, 0.0, 3 } };
    });
  return source;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOverDrops(ParticleSource* source)
{
  auto filter = MakeSkinOver(source);
  filter->SetVoxelSize(0.08);
  filter->SetKernelRadius(0.6);
  filter->SetModelBounds(-1.5, 1.5, -1.5, 1.5, -1.0, 1.0);
  filter->SetAttraction(20.0);
  filter->SetTension(0.01);
  filter->SetVolumeControlToPenalty();
  filter->OutputPotentialOn();
  return filter;
}

std::string TextOf(vtkTable* table)
{
  std::string text;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    for (vtkIdType column = 0; column < table->GetNumberOfColumns(); ++column)
    {
      text += table->GetValue(row, column).ToString() + " ";
    }
  }
  return text;
}

// Skin, history and potential at a time: all three ports.
std::string GetAllAt(vtkActiveImplicitSurface* filter, double time)
{
  const std::string skin = GetBytesAt(filter, time);
  vtkDataArray* distances = filter->GetPotential()->GetPointData()->GetScalars();
  const char* bytes = static_cast<const char*>(distances->GetVoidPointer(0));
  return skin + TextOf(filter->GetHistory()) +
    std::string(bytes, static_cast<std::size_t>(4 * distances->GetNumberOfValues()));
}

// Times in any order, a third of them between the steps. Raw numbers of the generator are the same
// on all platforms.
std::vector<double> DrawTimes(int count)
{
  std::mt19937 random(4);
  std::vector<double> times;
  for (int i = 0; i < count; ++i)
  {
    const double step = 0.1 * (random() % 30);
    times.push_back(random() % 3 ? step : step + 0.1 * (random() % 1000) / 1000.0);
  }
  return times;
}

// Result of a new filter that advances to this time directly.
std::string GetFresh(double time)
{
  auto source = MakeDrops();
  auto filter = MakeSkinOverDrops(source);
  filter->SetCheckpointInterval(0);
  return GetAllAt(filter, time);
}

TEST(TestCheckpoints, AnyOrderOfTimesGivesTheSameBytes)
{
  auto source = MakeDrops();
  std::vector<vtkSmartPointer<vtkActiveImplicitSurface>> filters;
  for (const int interval : { 10, 3, 1 })
  {
    filters.push_back(MakeSkinOverDrops(source));
    filters.back()->SetCheckpointInterval(interval);
  }
  filters[1]->SetNumberOfThreads(1);
  std::map<double, std::string> fresh;
  std::size_t wrong = 0;
  const std::vector<double> times = DrawTimes(200);
  for (const double time : times)
  {
    if (!fresh.count(time))
    {
      fresh[time] = GetFresh(time);
    }
    for (const auto& filter : filters)
    {
      wrong += GetAllAt(filter, time) != fresh[time];
    }
  }
  EXPECT_GT(fresh.size(), 50u) << "different times";
  EXPECT_EQ(wrong, 0u) << "skins or histories that differ from a fresh run's";
}

// The motion from a checkpoint to a step has at most nine steps, for an interval of ten.
TEST(TestCheckpoints, GoingBackCostsLessThanAnInterval)
{
  for (const int interval : { 10, 4 })
  {
    auto source = MakeDrops();
    auto filter = MakeSkinOverDrops(source);
    filter->SetCheckpointInterval(interval);
    GetBytesAt(filter, 3.0);
    filter->GetHistory();
    std::vector<int> substeps;
    for (vtkIdType row = 0; row < filter->GetHistory()->GetNumberOfRows(); ++row)
    {
      substeps.push_back(filter->GetHistory()->GetValueByName(row, "Substeps").ToInt());
    }
    for (const int step : { 29, 19, 13, 12, 7, 1, 0 })
    {
      int expected = 0;
      for (int i = step / interval * interval + 1; i <= step; ++i)
      {
        expected += substeps[i];
      }
      GetBytesAt(filter, 3.0);
      filter->ResetCounters();
      GetBytesAt(filter, 0.1 * step);
      EXPECT_EQ(filter->GetSubsteps(), vtkIdType(expected))
        << "substeps back to step " << step << ", interval " << interval;
    }
  }
}

// An update precedes each request, and is aborted after a random number of progress events unless
// it ends earlier.
TEST(TestCheckpoints, AbortsLeaveNoTrace)
{
  auto filter = MakeSkinOverDrops(MakeDrops());
  filter->SetCheckpointInterval(10); // motions long enough to be aborted
  int left = 0;
  vtkNew<vtkCallbackCommand> watcher;
  watcher->SetClientData(&left);
  watcher->SetCallback(
    [](vtkObject* caller, unsigned long, void* count, void*)
    {
      if (--*static_cast<int*>(count) == 0)
      {
        static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn();
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  std::mt19937 random(7);
  const std::vector<double> times = DrawTimes(100);
  std::size_t stopped = 0, wrong = 0;
  for (int i = 0; i < 50; ++i)
  {
    left = 1 + static_cast<int>(random() % 40);
    filter->UpdateTimeStep(times[2 * i]);
    stopped += filter->GetOutput()->GetNumberOfPoints() == 0;
    left = 0;
    filter->AbortExecuteOff();
    wrong += GetAllAt(filter, times[2 * i + 1]) != GetFresh(times[2 * i + 1]);
  }
  EXPECT_GT(stopped, 15u) << "updates that were stopped";
  EXPECT_EQ(wrong, 0u) << "later skins that differ from a fresh run's";
}

TEST(TestCheckpoints, WithoutCheckpointsItStartsOver)
{
  auto source = MakeDrops();
  for (const bool byInterval : { false, true })
  {
    auto filter = MakeSkinOverDrops(source);
    byInterval ? filter->SetCheckpointInterval(0) : filter->SetCheckpointMemory(0);
    GetBytesAt(filter, 1.0);
    const vtkIdType way = filter->GetSubsteps();
    GetBytesAt(filter, 2.0);
    filter->ResetCounters();
    GetBytesAt(filter, 1.0);
    EXPECT_EQ(filter->GetSubsteps(), way) << "substeps of the motion from the start";
  }
}

TEST(TestCheckpoints, ChangingTheCheckpointsDoesNotRestart)
{
  auto source = MakeDrops();
  auto filter = MakeSkinOverDrops(source);
  GetBytesAt(filter, 1.0);
  filter->ResetCounters();
  filter->SetCheckpointInterval(5);
  filter->SetCheckpointMemory(100);
  GetBytesAt(filter, 1.0);
  EXPECT_EQ(filter->GetSubsteps(), vtkIdType(0)) << "substeps";
}

// The second filter stands for another program, which loads the file.
TEST(TestCheckpoints, SavedStateGoesOnToTheSameBytes)
{
  const std::string file = OutputName("state.vdb");
  auto source = MakeDrops();
  auto first = MakeSkinOverDrops(source);
  GetBytesAt(first, 1.25); // the saved state is that of the previous step
  EXPECT_TRUE(first->SaveState(file.c_str())) << "the state is saved";
  auto second = MakeSkinOverDrops(MakeDrops());
  EXPECT_TRUE(second->LoadState(file.c_str())) << "the state is loaded";
  const double times[] = { 2.0, 1.2, 1.57, 0.4, 3.0 };
  for (const double time : times)
  {
    EXPECT_TRUE(GetAllAt(second, time) == GetFresh(time)) << "as fresh at " << time;
  }
  auto third = MakeSkinOverDrops(MakeDrops());
  third->LoadState(file.c_str());
  third->ResetCounters();
  GetBytesAt(third, 1.2);
  EXPECT_EQ(third->GetSubsteps(), vtkIdType(0)) << "substeps to the time of the file";
}

TEST(TestCheckpoints, StatesThatDoNotFitAreRefused)
{
  const std::string file = OutputName("state_to_refuse.vdb");
  auto filter = MakeSkinOverDrops(MakeDrops());
  MessageCapture messages(filter);
  EXPECT_TRUE(!filter->SaveState(file.c_str())) << "there is no state before the first update";
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "no state of a time step to save"), 1)
    << "error";
  const std::string good = GetBytesAt(filter, 1.0);
  EXPECT_TRUE(filter->SaveState(file.c_str())) << "the state is saved";
  EXPECT_TRUE(!filter->SaveState("/no/such/folder/state.vdb")) << "a folder that is not there";
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "cannot be written to /no/such/folder"), 1)
    << "error";
  EXPECT_TRUE(!filter->LoadState("/no/such/file.vdb")) << "a file that is not there";
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "No state of a surface can be loaded"), 1)
    << "error";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), good)) << "the skin after refused files";

  auto other = MakeSkinOverDrops(MakeDrops());
  other->SetVoxelSize(0.1);
  MessageCapture complaints(other);
  other->LoadState(file.c_str());
  GetBytesAt(other, 1.0);
  EXPECT_EQ(MessageCapture::Count(complaints.Errors, "does not fit this surface"), 1)
    << "other voxels";
}

TEST(TestCheckpoints, DamagedFilesAreNoStates)
{
  const std::string file = OutputName("state_to_damage.vdb");
  auto filter = MakeSkinOverDrops(MakeDrops());
  GetBytesAt(filter, 0.5);
  filter->SaveState(file.c_str());
  std::ifstream in(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_GT(whole.size(), 1000u) << "bytes";
  MessageCapture messages(filter);
  std::size_t refused = 0;
  for (int i = 0; i < 20; ++i)
  {
    std::ofstream(file, std::ios::binary) << whole.substr(0, i * whole.size() / 20);
    refused += !filter->LoadState(file.c_str());
  }
  EXPECT_EQ(refused, 20u) << "files cut off that are refused";
  EXPECT_EQ(messages.Errors.size(), 20u) << "a sentence for each";
}

TEST(TestCheckpoints, AFullDiskLeavesTheStateBefore)
{
  const std::string folder = EmptyFolder("full_disk");
  const std::string file = folder + "state.vdb";
  auto filter = MakeSkinOverDrops(MakeDrops());
  const std::string good = GetBytesAt(filter, 0.5);
  EXPECT_TRUE(filter->SaveState(file.c_str())) << "the first state is saved";
  GetBytesAt(filter, 1.0);
  const std::string measured = OutputName("measured.vdb");
  EXPECT_TRUE(filter->SaveState(measured.c_str())) << "the second state could be saved";
  const auto whole = std::filesystem::file_size(measured);
  MessageCapture messages(filter);
  for (const auto size : { std::uintmax_t(0), whole / 2, whole - 100 })
  {
    const SmallDisk disk(size);
    EXPECT_TRUE(!filter->SaveState(file.c_str())) << "no space beyond " << size;
  }
  EXPECT_EQ(messages.Errors.size(), 3u) << "a sentence for each";
  EXPECT_EQ(CountFiles(folder), 1u) << "files";
  EXPECT_TRUE(filter->LoadState(file.c_str())) << "the state before can be loaded";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.5), good)) << "and is that of its time";
}

TEST(TestCheckpoints, PackedStateIsSmallAndGoesOnToTheSameBytes)
{
  for (const int n : { 40, 96 })
  {
    for (const bool paper : { false, true })
    {
      NarrowBand band(VoxelSizeOf(n));
      StartOn(band, MakeSixMetaballs());
      ShapeTarget target(MakeTorus({ 0.01, 0.02, 0.013 }, 0.5, 0.22));
      Motion motion;
      motion.Tension = 0.01;
      motion.Paper = paper;
      motion.VolumeControl = Control::Penalty;
      band.Advance(0.1, motion, target);
      const std::string bytes = band.Pack();
      const auto other = NarrowBand::Unpack(bytes);
      bool isSame = true;
      for (int again = 0; again < 8; ++again)
      {
        isSame = isSame && band.Pack() == bytes && other->Pack() == bytes;
      }
      EXPECT_TRUE(isSame) << "packed again, the same bytes";
      std::size_t leaves = 0;
      for (std::size_t i = 0; i < band.GetLeaves().Size(); ++i)
      {
        leaves += band.GetLeaves().SummaryOf(i).IsUsed ? 1 : 0;
      }
      constexpr std::size_t ofHead = 9 * 8, ofLeaf = 4 * 4 + 2 * 64;
      EXPECT_EQ(bytes.size(), ofHead + ofLeaf * leaves + 4 * band.GetNumberOfActiveNodes());
      EXPECT_TRUE(AreIdentical(band, *other)) << "the same potential";
      band.Advance(0.2, motion, target);
      other->Advance(0.2, motion, target);
      EXPECT_TRUE(AreIdentical(band, *other)) << "the same potential later";
    }
  }
}

TEST(TestCheckpoints, EmptySurfacePacks)
{
  const NarrowBand band(0.1);
  EXPECT_TRUE(NarrowBand::Unpack(band.Pack())->IsEmpty()) << "it is still empty";
  for (const std::string& damaged : { std::string(), std::string(30, 'x'), std::string(100, 'x') })
  {
    EXPECT_TRUE(Throws<std::exception>([&] { NarrowBand::Unpack(damaged); }, ""))
      << "damaged bytes";
  }
}

}
