// Frames pushed by a simulation: the skins equal those of the finished series, and invalid frames
// are refused.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMolecule.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestAdvance
{

const std::vector<double> AllTimes = { 0.5, 1.0, 2.0, 2.5, 4.0, 4.25 };

// Two balls that move apart. Ball 3 is born at time 2, and ball 1 is gone from time 4 on.
std::vector<Particle> Part(double time)
{
  std::vector<Particle> particles = { { -0.1 * time, 0.0, 0.0, 2 } };
  if (time < 4.0)
  {
    particles.push_back({ 0.1 * time, 0.0, 0.0, 1 });
  }
  if (time >= 2.0)
  {
    particles.push_back({ 0.0, 0.2, 0.0, 3 });
  }
  return particles;
}

void Write(const std::vector<Particle>& particles, vtkPolyData* frame)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> ids;
  ids->SetName("id");
  for (const Particle& particle : particles)
  {
    points->InsertNextPoint(particle.X, particle.Y, particle.Z);
    ids->InsertNextValue(particle.Id);
  }
  frame->SetPoints(points);
  frame->GetPointData()->AddArray(ids);
}

vtkSmartPointer<vtkPolyData> MakeFrame(double time)
{
  auto frame = vtkSmartPointer<vtkPolyData>::New();
  Write(Part(time), frame);
  return frame;
}

using Filter = vtkSmartPointer<vtkActiveImplicitSurface>;

Filter Prepare(Filter filter)
{
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetStartTime(AllTimes.front());
  return filter;
}

Filter MakePlain()
{
  auto filter = Prepare(MakeSkin());
  filter->ComputeVelocityOn();
  filter->TangentialVelocityOff(); // at a first step it waits for the next one
  return filter;
}

Filter MakeCarried()
{
  auto filter = Prepare(MakeSkin());
  filter->SetParticleModelToAnisotropic();
  filter->SetParticleSpacing(0.1);
  filter->SetTimeIntegrationToAutomatic();
  filter->CreatePartsOn();
  return filter;
}

std::string GetAllBytes(vtkActiveImplicitSurface* filter)
{
  return GetBytes(filter) + GetArrayBytes(filter);
}

std::vector<std::string> RunAfterwards(Filter filter)
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(Part);
  source->SetSteps(AllTimes);
  filter->SetInputConnection(source->GetOutputPort());
  std::vector<std::string> skins;
  for (const double time : AllTimes)
  {
    filter->UpdateTimeStep(time);
    skins.push_back(GetAllBytes(filter));
  }
  return skins;
}

bool Push(vtkActiveImplicitSurface* filter, std::size_t i)
{
  const double dt = i > 0 ? AllTimes[i] - AllTimes[i - 1] : 1.0;
  return filter->Advance(MakeFrame(AllTimes[i]), dt);
}

double GetTime(vtkActiveImplicitSurface* filter)
{
  return filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
}

// Pushes the remaining frames and checks their skins.
void GoesOn(vtkActiveImplicitSurface* filter, std::size_t first,
  const std::vector<std::string>& expected, const std::string& sentence)
{
  for (std::size_t i = first; i < AllTimes.size(); ++i)
  {
    EXPECT_TRUE(Push(filter, i)) << "at " << AllTimes[i] << ", " << sentence;
    EXPECT_TRUE(GetAllBytes(filter) == expected[i]) << "at " << AllTimes[i] << ", " << sentence;
    EXPECT_EQ(GetTime(filter), AllTimes[i]) << sentence;
  }
}

// Checks that `push` causes one error with these words, leaves the skin of the last frame, and does
// not affect later frames.
void Refuses(const std::function<void(vtkActiveImplicitSurface*)>& push, const std::string& words)
{
  const std::vector<std::string> expected = RunAfterwards(MakePlain());
  auto filter = MakePlain();
  Push(filter, 0);
  Push(filter, 1);
  MessageCapture messages(filter);
  push(filter);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, words), 1) << "errors with \"" << words << "\"";
  EXPECT_TRUE(GetAllBytes(filter) == expected[1]) << "the last good skin, after " << words;
  EXPECT_EQ(filter->GetHistory()->GetNumberOfRows(), 2) << "rows, after " << words;
  GoesOn(filter, 2, expected, "after " + words);
}

TEST(TestAdvance, GivesTheSkinsOfTheFinishedSeries)
{
  for (const auto make : { MakePlain, MakeCarried })
  {
    auto filter = make();
    MessageCapture messages(filter);
    GoesOn(filter, 0, RunAfterwards(make()), "pushed");
    EXPECT_EQ(filter->GetHistory()->GetNumberOfRows(), vtkIdType(AllTimes.size())) << "rows";
    EXPECT_EQ(filter->GetHistory()->GetValueByName(5, "Time").ToDouble(), 4.25) << "of the last";
    EXPECT_EQ(messages.CountAll(), 0u) << "messages";
  }
}

// The time 77 of the frame's own information is ignored.
TEST(TestAdvance, TakesOneObjectThatIsWrittenOver)
{
  const std::vector<std::string> expected = RunAfterwards(MakePlain());
  auto filter = MakePlain();
  vtkNew<vtkPolyData> frame;
  frame->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), 77.0);
  for (std::size_t i = 0; i < AllTimes.size(); ++i)
  {
    Write(Part(AllTimes[i]), frame);
    EXPECT_TRUE(filter->Advance(frame, i > 0 ? AllTimes[i] - AllTimes[i - 1] : 1.0));
    EXPECT_TRUE(GetAllBytes(filter) == expected[i]) << "at " << AllTimes[i];
    EXPECT_EQ(GetTime(filter), AllTimes[i]) << "time of the skin";
  }
}

// Consumers may request any time, but only the newest skin is available.
TEST(TestAdvance, OtherUpdatesAreForTheNewestFrame)
{
  auto filter = MakePlain();
  Push(filter, 0);
  Push(filter, 1);
  const std::string skin = GetAllBytes(filter);
  MessageCapture messages(filter);
  filter->ResetCounters();
  filter->Update();
  EXPECT_TRUE(GetAllBytes(filter) == skin) << "without a time";
  filter->UpdateTimeStep(0.5);
  EXPECT_TRUE(GetAllBytes(filter) == skin) << "of the first time";
  filter->UpdateTimeStep(9.0);
  EXPECT_TRUE(GetAllBytes(filter) == skin) << "of a later time";
  filter->Update(1);
  EXPECT_EQ(filter->GetPotential()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 1.0)
    << "time of the potential";
  EXPECT_EQ(filter->GetSubsteps(), 0) << "substeps";
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

TEST(TestAdvance, WhatIsNoFrameIsRefused)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double dt : { 0.0, -1.0, infinity, nan })
  {
    Refuses([dt](vtkActiveImplicitSurface* filter)
      { EXPECT_FALSE(filter->Advance(MakeFrame(2.0), dt)); },
      "dt has to be a finite number > 0");
  }
  Refuses([](vtkActiveImplicitSurface* filter)
    { EXPECT_FALSE(filter->Advance(MakeFrame(2.0), 1e-20)); },
    "dt is 1e-20; added to the time 1 of the last frame, it gives no later finite time");
  Refuses([](vtkActiveImplicitSurface* filter) { EXPECT_FALSE(filter->Advance(nullptr, 1.0)); },
    "There is no frame to advance to");
  vtkNew<vtkMolecule> molecule;
  Refuses([&](vtkActiveImplicitSurface* filter) { EXPECT_FALSE(filter->Advance(molecule, 1.0)); },
    "A vtkMolecule cannot be a frame");
}

TEST(TestAdvance, AFrameThatCannotBeReadIsAsIfItHadNotBeen)
{
  vtkSmartPointer<vtkPolyData> frame = MakeFrame(2.0);
  frame->GetPointData()->RemoveArray("id");
  const auto push = [&](vtkActiveImplicitSurface* filter)
  { EXPECT_FALSE(filter->Advance(frame, 1.0)); };
  Refuses(push, "The input of port 0 has no point array as chosen");

  const vtkIdType triangle[] = { 0, 1, 2 };
  vtkNew<vtkIntArray> ids;
  ids->SetName("id");
  ids->SetNumberOfValues(3);
  frame->GetPointData()->AddArray(ids);
  frame->AllocateExact(1, 3);
  frame->InsertNextCell(VTK_TRIANGLE, 3, triangle);
  Refuses(push, "all time steps of the input have to be of one kind");
}

TEST(TestAdvance, ParticlesThatAreNotFiniteAreLeftOut)
{
  const std::vector<std::string> expected = RunAfterwards(MakePlain());
  auto filter = MakePlain();
  MessageCapture messages(filter);
  Push(filter, 0);
  vtkSmartPointer<vtkPolyData> frame = MakeFrame(1.0);
  frame->GetPoints()->InsertNextPoint(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  vtkIntArray::SafeDownCast(frame->GetPointData()->GetArray("id"))->InsertNextValue(9);
  EXPECT_TRUE(filter->Advance(frame, 0.5));
  EXPECT_TRUE(GetAllBytes(filter) == expected[1]) << "the skin without it";
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "1 particle is left out"), 1) << "warnings";
}

TEST(TestAdvance, ThereIsNoTimeInEquilibrium)
{
  auto filter = MakePlain();
  filter->SetEvolutionMode(vtkActiveImplicitSurface::EQUILIBRIUM);
  MessageCapture messages(filter);
  EXPECT_FALSE(Push(filter, 0));
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "no time to advance in"), 1) << "errors";
}

TEST(TestAdvance, AFirstFrameThatIsRefusedIsNotTheFirst)
{
  auto filter = MakePlain();
  MessageCapture messages(filter);
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 4, 4);
  EXPECT_FALSE(filter->Advance(image, 1.0));
  EXPECT_EQ(messages.Errors.size(), 1u) << "errors";
  GoesOn(filter, 0, RunAfterwards(MakePlain()), "after an image without values");
}

TEST(TestAdvance, AFrameThatIsRefusedLeavesAnotherInput)
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(Part);
  source->SetSteps(AllTimes);
  auto filter = MakePlain();
  filter->SetInputConnection(source->GetOutputPort());
  filter->UpdateTimeStep(AllTimes[1]);
  const std::string before = GetAllBytes(filter);
  MessageCapture messages(filter);
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 4, 4);
  EXPECT_FALSE(filter->Advance(image, 1.0));
  EXPECT_EQ(messages.Errors.size(), 1u) << "errors";
  EXPECT_EQ(filter->GetInputAlgorithm(), source.Get()) << "the input";
  EXPECT_TRUE(GetAllBytes(filter) == before) << "the skin";
  EXPECT_TRUE(filter->UpdateTimeStep(AllTimes[1]));
}

// After an error, an update or the next frame completes the interval.
TEST(TestAdvance, AMotionThatStopsGoesOn)
{
  const std::vector<std::string> expected = RunAfterwards(MakePlain());
  for (const bool withUpdate : { true, false })
  {
    auto filter = MakePlain();
    Push(filter, 0);
    Push(filter, 1);
    MessageCapture messages(filter);
    const vtkIdType most = filter->GetMaximumNumberOfActiveVoxels();
    filter->SetMaximumNumberOfActiveVoxels(100);
    EXPECT_FALSE(Push(filter, 2));
    EXPECT_EQ(MessageCapture::Count(messages.Errors, "MaximumNumberOfActiveVoxels"), 1) << "errors";
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
    filter->SetMaximumNumberOfActiveVoxels(most);
    if (withUpdate)
    {
      filter->Update();
      EXPECT_TRUE(GetAllBytes(filter) == expected[2]) << "the skin of the frame";
    }
    GoesOn(filter, 3, expected, withUpdate ? "after an update" : "with the next frame");
  }
}

// Earlier frames are unavailable.
TEST(TestAdvance, APropertyRestartsTheMotionAtTheNewestFrame)
{
  auto filter = MakePlain();
  Push(filter, 0);
  Push(filter, 1);
  filter->SetTension(0.001);
  MessageCapture messages(filter);
  filter->Update();
  auto fresh = MakePlain();
  fresh->SetTension(0.001);
  fresh->SetStartTime(AllTimes[1]);
  Push(fresh, 1);
  EXPECT_TRUE(GetAllBytes(filter) == GetAllBytes(fresh)) << "by an update";
  filter->SetTension(0.0);
  Push(filter, 2);
  fresh->SetTension(0.0);
  fresh->SetStartTime(AllTimes[2]);
  fresh->ResetTrajectory();
  Push(fresh, 2);
  EXPECT_TRUE(GetAllBytes(filter) == GetAllBytes(fresh)) << "with the next frame";
  EXPECT_EQ(filter->GetHistory()->GetNumberOfRows(), 1) << "rows";
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

TEST(TestAdvance, BeginsAnewAfterAResetOrAnotherInput)
{
  const std::vector<std::string> expected = RunAfterwards(MakePlain());
  auto filter = MakePlain();
  Push(filter, 0);
  Push(filter, 1);
  filter->ResetTrajectory();
  GoesOn(filter, 0, expected, "after a reset");
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(Part);
  source->SetSteps(AllTimes);
  filter->SetInputConnection(source->GetOutputPort());
  filter->UpdateTimeStep(AllTimes[2]);
  EXPECT_TRUE(GetAllBytes(filter) == expected[2]) << "over another input";
  GoesOn(filter, 0, expected, "after another input");
}

TEST(TestAdvance, ResetTrajectoryStartsAnySkinAnew)
{
  auto filter = MakeShrinkingBall();
  const std::string before = GetBytesAt(filter, 0.5);
  filter->ResetCounters();
  filter->ResetTrajectory();
  EXPECT_TRUE(GetBytesAt(filter, 0.5) == before) << "the same skin";
  EXPECT_GT(filter->GetSubsteps(), 0) << "substeps from the start";
}

TEST(TestAdvance, NothingOutlivesTheFilter)
{
  vtkWeakPointer<vtkObject> filter, source, executive, output;
  {
    const Filter own = MakePlain();
    ASSERT_TRUE(own->Advance(MakeFrame(0.5), 0.5)) << "a frame";
    ASSERT_TRUE(own->Advance(MakeFrame(1.0), 0.5)) << "the next one";
    filter = own.Get();
    source = own->GetInputAlgorithm(0, 0);
    executive = own->GetInputExecutive(0, 0);
    output = own->GetOutput();
  }
  EXPECT_FALSE(filter) << "the filter";
  EXPECT_FALSE(source) << "its source of frames";
  EXPECT_FALSE(executive) << "the executive of the source";
  EXPECT_FALSE(output) << "its output";
}
}
