// Changes that restart the motion, and changes that do not.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestRestart
{

namespace
{

// Returns true if the change restarts the motion: the next step then repeats all steps before.
bool Restarts(const std::function<void(vtkActiveImplicitSurface*)>& change)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.3);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.4);
  const auto oneStep = filter->GetTargetEvaluations();
  change(filter);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.5);
  return filter->GetTargetEvaluations() > 2 * oneStep;
}

vtkSphere* GetTarget(vtkActiveImplicitSurface* filter)
{
  return vtkSphere::SafeDownCast(filter->GetTargetFunction());
}

}

TEST(TestRestart, WhatShapesTheMotionRestartsIt)
{
  using Filter = vtkActiveImplicitSurface*;
  EXPECT_FALSE(Restarts([](Filter) {})) << "nothing does not";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetAttraction(1.5); })) << "Attraction";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetTension(0.001); })) << "Tension";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetCFL(0.5); })) << "CFL";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetTimeScale(1.5); })) << "TimeScale";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetVoxelSize(0.05); })) << "VoxelSize";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetModelBounds(-2, 1, -1, 1, -1, 1); })) << "ModelBounds";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetTargetIsoValue(0.01); })) << "TargetIsoValue";
  EXPECT_TRUE(Restarts([](Filter f) { f->SetTargetReach(0.1); })) << "TargetReach";
  EXPECT_TRUE(Restarts([](Filter f) { f->NormalizeTargetOff(); })) << "NormalizeTarget";
  EXPECT_TRUE(Restarts([](Filter f) { GetTarget(f)->SetRadius(0.45); })) << "the target's MTime";
  EXPECT_TRUE(Restarts([](Filter f) { f->GetInitialFunction()->Modified(); }))
    << "the initial shape's";

  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.3);
  filter->SetInitialFunction(nullptr);
  filter->UpdateTimeStep(0.4);
  EXPECT_NEAR(GetSkinBounds(filter)[1], 0.4, 0.1 * 0.0625) << "InitialFunction: on the target";
}

TEST(TestRestart, WhatDoesNotShapeTheMotionDoesNotRestartIt)
{
  using Filter = vtkActiveImplicitSurface*;
  EXPECT_FALSE(Restarts([](Filter f) { f->ComputeNormalsOff(); })) << "ComputeNormals";
  EXPECT_FALSE(Restarts([](Filter f) { f->OutputPotentialOn(); })) << "OutputPotential";
  EXPECT_FALSE(Restarts([](Filter f) { f->SetNumberOfThreads(1); })) << "NumberOfThreads";
  EXPECT_FALSE(Restarts([](Filter f) { f->SetMaximumNumberOfActiveVoxels(1000000); }))
    << "MaximumNumberOfActiveVoxels";
  EXPECT_FALSE(Restarts([](Filter f) { f->Modified(); })) << "its own MTime";
  EXPECT_FALSE(Restarts(
    [](Filter f)
    {
      f->SetAttraction(2.0);
      f->SetAttraction(-1.0);
    }))
    << "a change taken back";
}

TEST(TestRestart, ThreadsDoNotChangeTheBytes)
{
  auto one = MakeSkinOver(MakeMovingBall());
  one->SetNumberOfThreads(1);
  auto all = MakeSkinOver(MakeMovingBall());
  auto three = MakeSkinOver(MakeMovingBall());
  three->SetNumberOfThreads(3);
  const std::string bytes = GetBytesAt(one, 2.5);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(all, 2.5), bytes)) << "all";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(three, 2.5), bytes)) << "3";
}

TEST(TestRestart, ChangesUpstreamRestart)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  source->SetCloud([](double time) { return MovingBall(-time); });
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 0 1 2 3 ") << "times asked for";
  auto direct = MakeMovingBall();
  direct->SetCloud([](double time) { return MovingBall(-time); });
  EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(MakeSkinOver(direct), 3.0)))
    << "the same bytes";
}

// Input with the same times and more, as from a running simulation, but with other data.
TEST(TestRestart, MoreTimesOfOtherDataRestart)
{
  const std::vector<ShapeSource::Shape> series = {
    [](double time) {
      return MakeCloud({ { 0.1 * time, 0.0, 0.0, 1, 0.0 } });
    },
    [](double time) { return MakeBallMesh(0.5, 0.05 * time); },
    [](double time) { return MakeBallImage(0.5, 0.05 * time); },
  };
  for (const ShapeSource::Shape& first : series)
  {
    const ShapeSource::Shape other = [&first](double time) { return first(time + 2.0); };
    auto source = MakeSource(first, { 0.0, 1.0, 2.0 });
    auto filter = MakeSkinOver(source);
    filter->UpdateTimeStep(2.0);
    source->SetShape(other, { 0.0, 1.0, 2.0, 3.0 });
    source->Executions.clear();
    filter->UpdateTimeStep(2.0);
    auto direct = MakeSkinOver(MakeSource(other, { 0.0, 1.0, 2.0, 3.0 }));
    EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(direct, 2.0))) << "the other series'";
    filter->UpdateTimeStep(3.0);
    EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(direct, 3.0))) << "and what follows";
  }
}

TEST(TestRestart, MoreTimesOfTheSameDataGoOn)
{
  const ShapeSource::Shape series = [](double time) {
    return MakeCloud({ { 0.1 * time, 0.0, 0.0, 1, 0.0 } });
  };
  auto source = MakeSource(series, { 0.0, 1.0, 2.0 });
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  source->SetShape(series, { 0.0, 1.0, 2.0, 3.0 });
  source->Executions.clear();
  filter->ResetCounters();
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(source->GetExecutions(), "2 3 ") << "one step is read again";
  auto direct = MakeSkinOver(MakeSource(series, { 0.0, 1.0, 2.0, 3.0 }));
  EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(direct, 3.0)));
}

TEST(TestRestart, InputsThatModifyThemselvesDoNotRestart)
{
  auto source = MakeMovingBall();
  source->SetRestless(true);
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 ") << "times asked for";
}

TEST(TestRestart, AnInitialShapeThatModifiesItselfDoesNotRestart)
{
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkCallbackCommand> modify;
  modify->SetCallback([](vtkObject* caller, unsigned long, void*, void*) { caller->Modified(); });
  ball->AddObserver(vtkCommand::EndEvent, modify);
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetInputConnection(1, ball->GetOutputPort());
  filter->UpdateTimeStep(2.0);
  filter->ResetCounters();
  filter->UpdateTimeStep(3.0);
  const auto oneStep = filter->GetTargetEvaluations();
  filter->ResetCounters();
  filter->UpdateTimeStep(4.0);
  EXPECT_LT(filter->GetTargetEvaluations(), 2 * oneStep) << "evaluations of another step";
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 4 ") << "times asked for";
}

// Another consumer of the input requests another time; the stored steps stay valid.
TEST(TestRestart, OtherConsumersOfTheInputDoNotMatter)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(1.0);
  source->UpdateTimeStep(4.0);
  const std::string bytes = GetBytesAt(filter, 2.0);
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(MakeSkinOver(MakeMovingBall()), 2.0)))
    << "the same bytes";
}

TEST(TestRestart, StaticDataThatChangeRestart)
{
  auto source = MakeMovingBall();
  source->SetSteps({});
  source->Update();
  vtkNew<vtkPolyData> particles;
  particles->DeepCopy(source->GetOutput());
  auto filter = MakeSkinOver(source);
  filter->SetInputData(particles);
  filter->UpdateTimeStep(0.5);
  EXPECT_NEAR(GetSkinBounds(filter)[0] + GetSkinBounds(filter)[1], 0.0, 1e-6) << "twice the centre";
  filter->ResetCounters();
  filter->UpdateTimeStep(0.6);
  const auto oneStep = filter->GetTargetEvaluations();

  particles->GetPoints()->SetPoint(0, 0.25, 0.0, 0.0);
  particles->GetPoints()->Modified();
  particles->Modified();
  filter->ResetCounters();
  filter->UpdateTimeStep(0.6);
  EXPECT_LT(4 * oneStep, filter->GetTargetEvaluations()) << "evaluations from the start again";
  EXPECT_NEAR(GetSkinBounds(filter)[0] + GetSkinBounds(filter)[1], 0.5, 0.01) << "moved";
}

namespace
{

vtkSmartPointer<vtkPolyData> MakePoint(double x)
{
  auto frame = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x, 0.0, 0.0);
  frame->SetPoints(points);
  return frame;
}

constexpr const char* Replaced = "Replacing or changing the input does not advance time";

}

// A user's first loop: new data and a later time in each iteration.
TEST(TestRestart, DataThatAreReplacedFromTimeToTimeAreOneWarning)
{
  auto filter = MakeSkinOver(MakePoint(0.0));
  MessageCapture messages(filter);
  for (int step = 0; step < 4; ++step)
  {
    filter->SetInputData(MakePoint(0.1 * step));
    filter->UpdateTimeStep(0.1 * step);
  }
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, Replaced), 1) << "warnings";
  EXPECT_EQ(messages.CountAll(), 1u) << "messages";
  filter->SetTension(0.001);
  filter->UpdateTimeStep(0.0);
  filter->SetInputData(MakePoint(0.0));
  filter->UpdateTimeStep(0.1);
  EXPECT_EQ(messages.CountAll(), 1u) << "messages, once for each filter";
}

TEST(TestRestart, OneObjectThatIsWrittenOverIsThatWarningToo)
{
  vtkSmartPointer<vtkPolyData> frame = MakePoint(0.0);
  auto filter = MakeSkinOver(frame);
  MessageCapture messages(filter);
  for (int step = 0; step < 3; ++step)
  {
    frame->GetPoints()->SetPoint(0, 0.1 * step, 0.0, 0.0);
    frame->GetPoints()->Modified();
    filter->UpdateTimeStep(0.1 * step);
  }
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, Replaced), 1) << "warnings";
}

// No warning is due if data are replaced at the same or an earlier time, if another property has
// changed too, or if the input has time steps.
TEST(TestRestart, OtherRestartsAreNoWarning)
{
  auto filter = MakeSkinOver(MakePoint(0.0));
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.3);
  filter->SetInputData(MakePoint(0.1));
  filter->UpdateTimeStep(0.3);
  filter->SetInputData(MakePoint(0.2));
  filter->UpdateTimeStep(0.1);
  filter->UpdateTimeStep(0.2);
  filter->SetTension(0.001);
  filter->UpdateTimeStep(0.3);
  filter->SetInputData(MakePoint(0.1));
  filter->SetTension(0.002);
  filter->UpdateTimeStep(0.4);
  filter->UpdateTimeStep(7.0); // the time of the last step
  filter->SetInputData(MakePoint(0.0));
  filter->UpdateTimeStep(8.0);
  filter->SetInputConnection(MakeMovingBall()->GetOutputPort());
  filter->UpdateTimeStep(1.0);
  filter->SetInputConnection(MakeMovingBall()->GetOutputPort());
  filter->UpdateTimeStep(2.0);
  filter->SetInputData(MakePoint(0.0));
  filter->UpdateTimeStep(3.0);
  filter->Advance(MakePoint(0.0), 1.0);
  filter->Advance(MakePoint(0.1), 1.0);
  filter->SetEvolutionMode(vtkActiveImplicitSurface::EQUILIBRIUM);
  filter->Update();
  filter->SetInputData(MakePoint(0.1));
  filter->UpdateTimeStep(9.0);
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

// No warning is due either for a motion that has never begun.
TEST(TestRestart, AnErrorThatIsMendedIsNoWarning)
{
  auto filter = MakeSkinOver(MakePoint(0.0));
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mass");
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  vtkSmartPointer<vtkPolyData> better = MakePoint(0.0);
  vtkNew<vtkDoubleArray> mass;
  mass->SetName("mass");
  mass->InsertNextValue(0.3);
  better->GetPointData()->AddArray(mass);
  filter->SetInputData(better);
  filter->UpdateTimeStep(0.1);
  EXPECT_EQ(messages.Warnings.size(), 0u) << "warnings";
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
}

}
