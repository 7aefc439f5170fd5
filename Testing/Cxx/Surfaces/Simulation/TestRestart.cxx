// What starts the motion anew, and what does not.

#include "Support/PipelineTools.h"

#include "vtkCallbackCommand.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

using namespace activesurface;

namespace
{

// Whether the change makes the motion start anew: then the next step has to come after the first.
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
      f->SetAttraction(1.0);
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

// Another consumer of the input takes it to another time; the steps that are held stay valid.
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
