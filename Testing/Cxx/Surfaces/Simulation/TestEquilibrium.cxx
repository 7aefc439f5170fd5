// EvolutionMode EQUILIBRIUM: one update advances the skin to its steady state, independent of time.

#include "Support/HistoryTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeFunction.h"

#include "vtkBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkImplicitSum.h"
#include "vtkInformation.h"
#include "vtkPerlinNoise.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace activesurface;

namespace TestEquilibrium
{

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double VoxelSize = VoxelSizeOf(40);
constexpr double Goal = 0.6;

// A ball of radius 0.5 that moves towards one of 0.6.
vtkSmartPointer<vtkActiveImplicitSurface> MakeSettlingBall(double tension = 0.005)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInitialFunction(MakeFunction(MakeBall(CentreA, 0.5)));
  filter->SetTargetFunction(MakeFunction(MakeBall(CentreA, Goal)));
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->SetVoxelSize(VoxelSize);
  filter->SetTension(tension);
  filter->SetEvolutionModeToEquilibrium();
  return filter;
}

std::string UpdatedBytes(vtkActiveImplicitSurface* filter)
{
  filter->Update();
  return GetBytes(filter);
}

void PublishesTimes(vtkActiveImplicitSurface* filter, bool expected, const std::string& name)
{
  filter->UpdateInformation();
  for (int port = 0; port < 3; ++port)
  {
    vtkInformation* out = filter->GetOutputInformation(port);
    const std::string of = ", port " + std::to_string(port) + ", " + name;
    EXPECT_EQ(out->Has(SDDP::TIME_STEPS()) != 0, expected) << "TIME_STEPS" << of;
    EXPECT_EQ(out->Has(SDDP::TIME_RANGE()) != 0, expected) << "TIME_RANGE" << of;
  }
}

void CarriesTimes(vtkActiveImplicitSurface* filter, bool expected, const std::string& name)
{
  filter->Update();
  filter->Update(1);
  for (int port = 0; port < 3; ++port)
  {
    vtkDataObject* data = filter->GetOutputDataObject(port);
    EXPECT_EQ(data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()) != 0, expected)
      << "DATA_TIME_STEP, port " << port << ", " << name;
  }
}

void CheckModes(vtkActiveImplicitSurface* filter, const std::string& name)
{
  for (const std::string turn : { "once", "again" })
  {
    filter->SetEvolutionModeToEquilibrium();
    PublishesTimes(filter, false, name + " at rest, " + turn);
    CarriesTimes(filter, false, name + " at rest, " + turn);
    filter->SetEvolutionModeToTransient();
    PublishesTimes(filter, true, name + " in time, " + turn);
    CarriesTimes(filter, true, name + " in time, " + turn);
  }
}

}

TEST(TestEquilibrium, NoTimesArePublished)
{
  CheckModes(MakeSettlingBall(), "of its own,");
  CheckModes(MakeSkinOver(MakeMovingBall()), "of the input,");
}

// r = (R + sqrt(R^2 - 8 b / a)) / 2, within 0.04 h: see SettledBallHasTheExactRadius of TestSettle.
TEST(TestEquilibrium, OneUpdateGivesTheExactRadius)
{
  for (const double tension : { 0.0, 0.005, 0.02 })
  {
    auto filter = MakeSettlingBall(tension);
    MessageCapture messages(filter);
    filter->Update();
    const double exact = 0.5 * (Goal + std::sqrt(Goal * Goal - 8.0 * tension));
    const double radius = GetRadii(GetMesh(filter->GetOutput()), CentreA).Mean;
    const std::string name = ", tension " + std::to_string(tension);
    EXPECT_NEAR((radius - exact) / VoxelSize, 0.0, 0.04) << "error of the radius [h]" << name;
    EXPECT_EQ(GetLastEvent(filter), "at rest") << "event" << name;
    EXPECT_EQ(CountRows(filter), 2) << "rows, the start and the rest" << name;
    EXPECT_EQ(GetNumber(filter, 1, "Substeps"), double(filter->GetSubsteps()))
      << "substeps" << name;
    EXPECT_GT(GetNumber(filter, 1, "Time"), 0.0) << "time that it took" << name;
    EXPECT_EQ(messages.CountAll(), 0u) << "messages" << name;
  }
}

// Noise with waves of half a voxel keeps a part of the skin moving.
TEST(TestEquilibrium, TheEventTellsWhatStillMoves)
{
  vtkNew<vtkSphere> ball;
  ball->SetRadius(Goal);
  vtkNew<vtkPerlinNoise> noise;
  noise->SetFrequency(2.0 / VoxelSize, 2.0 / VoxelSize, 2.0 / VoxelSize);
  noise->SetAmplitude(VoxelSize);
  vtkNew<vtkImplicitSum> target;
  target->AddFunction(ball);
  target->AddFunction(noise);
  auto filter = MakeSettlingBall();
  filter->SetTargetFunction(target);
  MessageCapture messages(filter);
  filter->Update();
  const std::string event = GetLastEvent(filter);
  EXPECT_EQ(event.rfind("at rest but for ", 0), 0u) << event;
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

TEST(TestEquilibrium, TooFewSubstepsAreAWarning)
{
  auto direct = MakeSettlingBall();
  const std::string bytes = UpdatedBytes(direct);
  for (const int substeps : { 0, 5 })
  {
    auto filter = MakeSettlingBall();
    filter->SetMaximumNumberOfSubsteps(substeps);
    MessageCapture messages(filter);
    filter->Update();
    const std::string words =
      "not reached a steady state after " + std::to_string(substeps) + " substeps";
    EXPECT_EQ(MessageCapture::Count(messages.Warnings, words), 1) << "warnings, " << words;
    EXPECT_EQ(MessageCapture::Count(messages.Warnings, "RestTolerance is 0.001"), 1)
      << "its tolerance";
    EXPECT_EQ(MessageCapture::Count(messages.Warnings, " % of "), 0) << "no window has ended";
    EXPECT_EQ(messages.CountAll(), 1u) << "messages";
    EXPECT_EQ(GetLastEvent(filter), "not at rest") << "event";
    EXPECT_EQ(GetNumber(filter, 1, "Substeps"), double(substeps)) << "substeps";
    EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles all the same";
    filter->SetMaximumNumberOfSubsteps(10000);
    EXPECT_TRUE(UpdatedBytes(filter) == bytes) << "the same bytes with more of them";
    EXPECT_EQ(GetLastEvent(filter), "at rest") << "event";
    EXPECT_EQ(messages.CountAll(), 1u) << "messages";
  }
}

TEST(TestEquilibrium, LargerToleranceComesSooner)
{
  auto fine = MakeSettlingBall();
  fine->Update();
  auto coarse = MakeSettlingBall();
  coarse->SetRestTolerance(0.1);
  coarse->Update();
  EXPECT_EQ(GetLastEvent(coarse), "at rest") << "event";
  EXPECT_LT(coarse->GetSubsteps(), fine->GetSubsteps()) << "substeps";
}

namespace
{

struct Stopper
{
  vtkIdType Substeps; // number of substeps until the abort

  static void Watch(vtkObject* caller, unsigned long, void* self, void*)
  {
    auto filter = static_cast<vtkActiveImplicitSurface*>(caller);
    filter->SetAbortExecute(filter->GetProgress() > 0.0 &&
      static_cast<Stopper*>(self)->Calls++ > static_cast<Stopper*>(self)->Substeps);
  }

  int Calls = 0;
};

}

// MaximumNumberOfSubsteps counts from the start, and includes the substeps before an abort.
TEST(TestEquilibrium, StoppedWayToRestGoesOn)
{
  for (const int maximum : { 10000, 150 })
  {
    auto direct = MakeSettlingBall();
    direct->SetMaximumNumberOfSubsteps(maximum);
    const std::string bytes = UpdatedBytes(direct);
    auto filter = MakeSettlingBall();
    filter->SetMaximumNumberOfSubsteps(maximum);
    Stopper stopper = { 60 };
    vtkNew<vtkCallbackCommand> watcher;
    watcher->SetClientData(&stopper);
    watcher->SetCallback(Stopper::Watch);
    const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, watcher);
    vtkIdType before = 0;
    for (const std::string turn : { "once", "twice" })
    {
      stopper.Calls = 0;
      filter->AbortExecuteOff();
      filter->Update();
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points when stopped " << turn;
      EXPECT_EQ(CountRows(filter), 0) << "rows when stopped " << turn;
      EXPECT_LT(before, filter->GetSubsteps()) << "substeps before, " << turn;
      EXPECT_LT(filter->GetSubsteps(), direct->GetSubsteps()) << "not all of them, " << turn;
      before = filter->GetSubsteps();
    }
    filter->RemoveObserver(tag);
    filter->AbortExecuteOff();
    EXPECT_TRUE(UpdatedBytes(filter) == bytes) << "the same bytes as without a stop";
    EXPECT_EQ(GetHistoryText(filter), GetHistoryText(direct)) << "and the same history";
    EXPECT_EQ(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps in all";
  }
}

TEST(TestEquilibrium, SecondUpdateCostsNothing)
{
  auto filter = MakeSettlingBall();
  int executions = 0;
  CountExecutions(filter, executions);
  const std::string bytes = UpdatedBytes(filter);
  const auto evaluations = filter->GetTargetEvaluations();
  filter->Update();
  filter->Update(2);
  EXPECT_EQ(executions, 1) << "executions";
  filter->Update(1);
  EXPECT_GT(filter->GetPotential()->GetNumberOfPoints(), 0) << "nodes of the image";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 3.0), bytes)) << "the same bytes at another time";
  filter->ComputeNormalsOff();
  filter->Update();
  EXPECT_EQ(filter->GetTargetEvaluations(), evaluations) << "evaluations of the target";
}

// The particle is at x = 0.2 times the time: at 0.2 in the first step, at time 1.
TEST(TestEquilibrium, FirstStepOfTheInputIsTheTarget)
{
  auto source = MakeMovingBall();
  source->SetSteps({ 1.0, 2.0, 3.0, 4.0 });
  auto filter = MakeSkinOver(source);
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.8);
  filter->SetEvolutionModeToEquilibrium();
  for (const double time : { 1.0, 3.0 })
  {
    filter->UpdateTimeStep(time);
    const auto bounds = GetSkinBounds(filter);
    EXPECT_NEAR(0.5 * (bounds[0] + bounds[1]), 0.2, 0.05) << "centre, " << time;
    EXPECT_EQ(GetLastEvent(filter), "at rest") << "event";
  }
  EXPECT_EQ(source->GetExecutions(), "1 ") << "times asked for";
}

// The ball has the least area of all bodies of a given volume. The bound of the spread is that of
// HeldBallIsAtRest in TestSettle.
TEST(TestEquilibrium, HeldBoxBecomesABallOfItsVolume)
{
  auto filter = MakeSettlingBall(1.0);
  vtkNew<vtkBox> box;
  box->SetBounds(-0.4, 0.4, -0.4, 0.4, -0.4, 0.4);
  filter->SetInitialFunction(box);
  filter->SetAttraction(0.0);
  filter->SetVolumeControlToExact();
  filter->Update();
  EXPECT_EQ(GetLastEvent(filter), "at rest") << "event";
  const double volume = GetNumber(filter, 0, "Volume");
  EXPECT_NEAR(GetNumber(filter, 1, "Volume") / volume, 1.0, 1e-6) << "volume over that of the box";
  const double radius = std::cbrt(3.0 * volume / (4.0 * Pi));
  const Range radii = GetRadii(GetMesh(filter->GetOutput()), { 0.0, 0.0, 0.0 });
  EXPECT_LT(radii.GetSpread() / radius, 0.01) << "relative spread";
  EXPECT_NEAR(radii.Mean / radius, 1.0, 0.01) << "mean radius over that of the ball";
}

TEST(TestEquilibrium, SkinThatVanishesIsAtRest)
{
  auto filter = MakeSettlingBall(0.1); // 8 b / a = 0.8 > R^2
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  EXPECT_EQ(GetLastEvent(filter), "at rest") << "event";
  EXPECT_EQ(DescribeTopology(filter, 1), "0 0 0") << "bodies, voids, Euler number";
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "vanished"), 1) << "warnings of it";
  EXPECT_EQ(messages.CountAll(), 1u) << "messages";
}

}
