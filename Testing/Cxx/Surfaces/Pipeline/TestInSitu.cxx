// A running simulation publishes its time steps one by one, or provides each time only once.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/PriorAccess.h"
#include "Support/ShapeSource.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestInSitu
{

const std::vector<double> AllSteps = { 0.5, 1.0, 2.0, 2.5, 4.0, 4.25 };

// Two balls that move apart, and a third that is born at time 2.
std::vector<Particle> Part(double time)
{
  std::vector<Particle> particles = { { 0.1 * time, 0.0, 0.0, 1 }, { -0.1 * time, 0.0, 0.0, 2 } };
  if (time >= 2.0)
  {
    particles.push_back({ 0.0, 0.2, 0.0, 3 });
  }
  return particles;
}

vtkSmartPointer<ParticleSource> MakeRunning(const std::vector<double>& steps)
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(Part);
  source->SetSteps(steps);
  return source;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeWatcher(ParticleSource* source)
{
  auto filter = MakeSkinOver(source);
  filter->SetStartTime(AllSteps.front());
  filter->ComputeVelocityOn();
  filter->TangentialVelocityOff(); // at a first step it waits for the next one
  return filter;
}

std::string GetAllBytes(vtkActiveImplicitSurface* filter)
{
  return GetBytes(filter) + GetArrayBytes(filter);
}

// Skins at each step of a run over a finished simulation.
std::vector<std::string> RunAfterwards()
{
  auto source = MakeRunning(AllSteps);
  auto filter = MakeWatcher(source);
  std::vector<std::string> skins;
  for (const double time : AllSteps)
  {
    filter->UpdateTimeStep(time);
    skins.push_back(GetAllBytes(filter));
  }
  return skins;
}

TEST(TestInSitu, GrowingStepsGiveTheSameSkins)
{
  const std::vector<std::string> expected = RunAfterwards();
  auto source = MakeRunning({ AllSteps.front() });
  auto filter = MakeWatcher(source);
  for (std::size_t i = 0; i < AllSteps.size(); ++i)
  {
    source->SetSteps({ AllSteps.begin(), AllSteps.begin() + i + 1 });
    filter->UpdateTimeStep(AllSteps[i]);
    EXPECT_TRUE(GetAllBytes(filter) == expected[i]) << "at " << AllSteps[i];
  }
  // Each step is requested again when the next one has appeared, to check that the series is
  // unchanged.
  EXPECT_EQ(source->GetExecutions(), std::string("0.5 0.5 1 1 2 2 2.5 2.5 4 4 4.25 "))
    << "times asked for";
  EXPECT_EQ(filter->GetHistory()->GetNumberOfRows(), vtkIdType(AllSteps.size())) << "rows";
  EXPECT_EQ(filter->GetHistory()->GetValueByName(0, "Time").ToDouble(), 0.5) << "first of them";
}

// An input with a single step is static, so its target does not transport the skin. From the second
// step on the target has to.
TEST(TestInSitu, ParticlesOfGrowingStepsCarryTheSkin)
{
  const auto prepare = [](ParticleSource* source)
  {
    auto filter = MakeWatcher(source);
    filter->SetParticleModelToAnisotropic();
    filter->SetParticleSpacing(0.1);
    filter->SetTimeIntegrationToAutomatic();
    filter->CreatePartsOn();
    return filter;
  };
  auto finished = MakeRunning(AllSteps);
  auto afterwards = prepare(finished);
  auto source = MakeRunning({ AllSteps.front() });
  auto filter = prepare(source);
  for (std::size_t i = 0; i < AllSteps.size(); ++i)
  {
    source->SetSteps({ AllSteps.begin(), AllSteps.begin() + i + 1 });
    filter->UpdateTimeStep(AllSteps[i]);
    afterwards->UpdateTimeStep(AllSteps[i]);
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), vtkIdType(0)) << "at " << AllSteps[i];
    EXPECT_TRUE(GetBytes(filter) == GetBytes(afterwards)) << "at " << AllSteps[i];
  }
}

TEST(TestInSitu, GrowingStepsKeepThePast)
{
  auto finished = MakeRunning(AllSteps);
  auto afterwards = MakeWatcher(finished);
  afterwards->UpdateTimeStep(1.5);
  const std::string expected = GetAllBytes(afterwards);
  auto source = MakeRunning({ 0.5, 1.0, 2.0 });
  auto filter = MakeWatcher(source);
  filter->SetCheckpointInterval(1);
  filter->UpdateTimeStep(2.0);
  source->SetSteps(AllSteps);
  filter->ResetCounters();
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(filter->GetSubsteps(), vtkIdType(0)) << "substeps because of new steps";
  filter->UpdateTimeStep(1.5);
  EXPECT_TRUE(GetAllBytes(filter) == expected) << "between two old steps";
}

// A list that changes elsewhere than at its end is a different input.
TEST(TestInSitu, OtherStepsStartAnew)
{
  auto source = MakeRunning({ 0.5, 1.0, 2.0 });
  auto filter = MakeWatcher(source);
  filter->UpdateTimeStep(2.0);
  filter->ResetCounters();
  source->SetSteps({ 0.5, 1.5, 2.0, 2.5 });
  filter->UpdateTimeStep(2.0);
  auto fresh = MakeWatcher(MakeRunning({ 0.5, 1.5, 2.0, 2.5 }));
  fresh->UpdateTimeStep(2.0);
  EXPECT_GT(double(filter->GetSubsteps()), 0.0) << "substeps of the new start";
  EXPECT_TRUE(GetAllBytes(filter) == GetAllBytes(fresh)) << "the same as a new filter";
}

// An input with a single step is static, so the filter advances the skin by its own time steps. If
// the skin has advanced, the next step of the input restarts the motion.
TEST(TestInSitu, AStillInputThatBeginsToMoveStartsAnewIfTheSkinHasMoved)
{
  auto source = MakeRunning({ 0.5 });
  auto filter = MakeWatcher(source);
  filter->UpdateTimeStep(0.9);
  source->SetSteps({ 0.5, 1.0 });
  filter->UpdateTimeStep(1.0);
  EXPECT_TRUE(GetAllBytes(filter) == RunAfterwards()[1]) << "the skin of a finished simulation";
}

// A ball that moves by 0.1 per frame.
vtkSmartPointer<vtkImageData> MakeFrame(int i)
{
  return MakeBallImage(0.5, 0.1 * i - 0.2);
}

std::vector<std::string> PushImages(const std::function<vtkDataObject*(int)>& frame)
{
  auto filter = MakeSkin();
  std::vector<std::string> skins;
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(filter->Advance(frame(i), 0.2)) << "frame " << i;
    skins.push_back(GetAllBytes(filter));
  }
  return skins;
}

// The simulation overwrites the values of one image, which is the frame itself or a block of the
// frame.
TEST(TestInSitu, AnImageMayBeWrittenOver)
{
  vtkSmartPointer<vtkImageData> newest;
  const auto expected = PushImages([&](int i) { return newest = MakeFrame(i); });
  EXPECT_FALSE(expected[3] == expected[1]) << "the skin moves";
  auto image = MakeFrame(0);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, image);
  for (vtkDataObject* frame :
    { static_cast<vtkDataObject*>(image), static_cast<vtkDataObject*>(blocks) })
  {
    const auto overwrite = [&](int i)
    {
      vtkDataArray* values = image->GetPointData()->GetScalars();
      const auto others = MakeFrame(i);
      values->InsertTuples(0, values->GetNumberOfTuples(), 0, others->GetPointData()->GetScalars());
      return frame;
    };
    EXPECT_TRUE(PushImages(overwrite) == expected) << frame->GetClassName();
  }
}

TEST(TestInSitu, TimeGoesOnAfterARestart)
{
  for (const int calls : { 0, 1, 2 })
  {
    auto filter = MakeSkin();
    filter->SetStartTime(3.0);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_TRUE(filter->Advance(MakeFrame(i), 0.5)) << "frame " << i;
    }
    filter->SetTension(0.001);
    for (int i = 0; i < calls; ++i)
    {
      filter->UpdateInformation();
    }
    EXPECT_TRUE(filter->Advance(MakeFrame(3), 0.5)) << "the next frame";
    vtkInformation* skin = filter->GetOutput()->GetInformation();
    EXPECT_EQ(skin->Get(vtkDataObject::DATA_TIME_STEP()), 4.5) << calls << " requests";
  }
}

// An emitter: the first frames are empty. The particle spacing, and with it the voxel size, is
// unknown until the first particles.
TEST(TestInSitu, ASkinBeginsWithTheFirstParticles)
{
  const auto cube = [](int i)
  {
    std::vector<Particle> particles;
    for (int k = 0; i > 0 && k < 64; ++k)
    {
      particles.push_back({ k % 4 + 0.25 * i, k / 4 % 4 * 1.0, k / 16 * 1.0, k });
    }
    return particles;
  };
  for (const int empty : { 1, 2, 3 })
  {
    auto given = vtkSmartPointer<vtkActiveImplicitSurface>::New();
    given->SetParticleSpacing(1.0);
    auto estimated = vtkSmartPointer<vtkActiveImplicitSurface>::New();
    MessageCapture messages(estimated);
    for (int i = 0; i < empty + 3; ++i)
    {
      auto source = vtkSmartPointer<ParticleSource>::New();
      source->SetCloud([&](double) { return cube(i - empty + 1); });
      source->Update();
      EXPECT_TRUE(given->Advance(source->GetOutput(), 0.2)) << "with a spacing";
      EXPECT_TRUE(estimated->Advance(source->GetOutput(), 0.2)) << "without one";
      EXPECT_EQ(given->GetOutput()->GetNumberOfPoints() > 0, i >= empty) << "frame " << i;
      EXPECT_TRUE(GetBytes(estimated) == GetBytes(given)) << "frame " << i << " of " << empty;
    }
    EXPECT_EQ(MessageCapture::Count(messages.Warnings, "follow from the first particles"), 1)
      << "notes";
  }
}

// VTK 9.4 and later: the source provides each time only once, so the filter must not request a time
// twice.
TEST(TestInSitu, NoPriorAccessIsObeyed)
{
  auto source = MakeRunning({});
  source->SetContinuous(true);
  if (!ForbidPriorAccess(source))
  {
    EXPECT_FALSE(IsPriorAccessKnown()) << "skipped: this VTK knows no NO_PRIOR_TEMPORAL_ACCESS";
    return;
  }
  const std::vector<std::string> expected = RunAfterwards();
  auto filter = MakeWatcher(source);
  filter->SetCheckpointInterval(2);
  MessageCapture messages(filter);
  for (std::size_t i = 0; i < AllSteps.size(); ++i)
  {
    filter->UpdateTimeStep(AllSteps[i]);
    EXPECT_TRUE(GetAllBytes(filter) == expected[i]) << "at " << AllSteps[i];
    if (i == 3)
    {
      filter->UpdateTimeStep(AllSteps[2]);
      EXPECT_TRUE(GetAllBytes(filter) == expected[2]) << "back to a checkpoint";
      filter->UpdateTimeStep(AllSteps[1]);
      EXPECT_EQ(MessageCapture::Count(messages.Errors, "provides each time step only once"), 1)
        << "errors";
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), vtkIdType(0)) << "points then";
    }
  }
  EXPECT_EQ(source->GetExecutions(), std::string("0.5 1 2 2.5 4 4.25 ")) << "times asked for";
  ForbidPriorAccess(source);
  filter->UpdateTimeStep(AllSteps[0]);
  EXPECT_TRUE(GetAllBytes(filter) == expected[0]) << "begun again";
}

}
