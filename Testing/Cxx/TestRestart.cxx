// What starts the motion anew, and what does not.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"

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

void WhatShapesTheMotionRestartsIt(Check& check)
{
  using Filter = vtkActiveImplicitSurface*;
  check.True(!Restarts([](Filter) {}), "nothing does not");
  check.True(Restarts([](Filter f) { f->SetAttraction(1.5); }), "Attraction");
  check.True(Restarts([](Filter f) { f->SetTension(0.001); }), "Tension");
  check.True(Restarts([](Filter f) { f->SetCFL(0.5); }), "CFL");
  check.True(Restarts([](Filter f) { f->SetTimeScale(1.5); }), "TimeScale");
  check.True(Restarts([](Filter f) { f->SetVoxelSize(0.05); }), "VoxelSize");
  check.True(Restarts([](Filter f) { f->SetModelBounds(-2, 1, -1, 1, -1, 1); }), "ModelBounds");
  check.True(Restarts([](Filter f) { f->SetTargetIsoValue(0.01); }), "TargetIsoValue");
  check.True(Restarts([](Filter f) { f->SetTargetReach(0.1); }), "TargetReach");
  check.True(Restarts([](Filter f) { f->NormalizeTargetOff(); }), "NormalizeTarget");
  check.True(Restarts([](Filter f) { GetTarget(f)->SetRadius(0.45); }), "the target's MTime");
  check.True(
    Restarts([](Filter f) { f->GetInitialFunction()->Modified(); }), "the initial shape's");

  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.3);
  filter->SetInitialFunction(nullptr);
  filter->UpdateTimeStep(0.4);
  check.Near(GetSkinBounds(filter)[1], 0.4, 0.1 * 0.0625, "InitialFunction: on the target");
}

void WhatDoesNotShapeTheMotionDoesNotRestartIt(Check& check)
{
  using Filter = vtkActiveImplicitSurface*;
  check.True(!Restarts([](Filter f) { f->ComputeNormalsOff(); }), "ComputeNormals");
  check.True(!Restarts([](Filter f) { f->OutputPotentialOn(); }), "OutputPotential");
  check.True(!Restarts([](Filter f) { f->SetNumberOfThreads(1); }), "NumberOfThreads");
  check.True(!Restarts([](Filter f) { f->SetMaximumNumberOfActiveVoxels(1000000); }),
    "MaximumNumberOfActiveVoxels");
  check.True(!Restarts([](Filter f) { f->Modified(); }), "its own MTime");
  check.True(!Restarts(
               [](Filter f)
               {
                 f->SetAttraction(2.0);
                 f->SetAttraction(1.0);
               }),
    "a change taken back");
}

void ThreadsDoNotChangeTheBytes(Check& check)
{
  auto one = MakeSkinOver(MakeMovingBall());
  one->SetNumberOfThreads(1);
  auto all = MakeSkinOver(MakeMovingBall());
  auto three = MakeSkinOver(MakeMovingBall());
  three->SetNumberOfThreads(3);
  const std::string bytes = GetBytesAt(one, 2.5);
  check.True(GetBytesAt(all, 2.5) == bytes, "all");
  check.True(GetBytesAt(three, 2.5) == bytes, "3");
}

void ChangesUpstreamRestart(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  source->SetCloud([](double time) { return MovingBall(-time); });
  filter->UpdateTimeStep(3.0);
  check.Equal(source->GetExecutions(), "0 1 2 0 1 2 3 ", "times asked for");
  auto direct = MakeMovingBall();
  direct->SetCloud([](double time) { return MovingBall(-time); });
  check.True(GetBytes(filter) == GetBytesAt(MakeSkinOver(direct), 3.0), "the same bytes");
}

void InputsThatModifyThemselvesDoNotRestart(Check& check)
{
  auto source = MakeMovingBall();
  source->SetRestless(true);
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  filter->UpdateTimeStep(3.0);
  check.Equal(source->GetExecutions(), "0 1 2 3 ", "times asked for");
}

// Another consumer of the input takes it to another time; the steps that are held stay valid.
void OtherConsumersOfTheInputDoNotMatter(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(1.0);
  source->UpdateTimeStep(4.0);
  const std::string bytes = GetBytesAt(filter, 2.0);
  check.True(bytes == GetBytesAt(MakeSkinOver(MakeMovingBall()), 2.0), "the same bytes");
}

void StaticDataThatChangeRestart(Check& check)
{
  auto source = MakeMovingBall();
  source->SetSteps({});
  source->Update();
  vtkNew<vtkPolyData> particles;
  particles->DeepCopy(source->GetOutput());
  auto filter = MakeSkinOver(source);
  filter->SetInputData(particles);
  filter->UpdateTimeStep(0.5);
  check.Near(GetSkinBounds(filter)[0] + GetSkinBounds(filter)[1], 0.0, 1e-6, "twice the centre");
  filter->ResetCounters();
  filter->UpdateTimeStep(0.6);
  const auto oneStep = filter->GetTargetEvaluations();

  particles->GetPoints()->SetPoint(0, 0.25, 0.0, 0.0);
  particles->GetPoints()->Modified();
  particles->Modified();
  filter->ResetCounters();
  filter->UpdateTimeStep(0.6);
  check.Less(4 * oneStep, filter->GetTargetEvaluations(), "evaluations from the start again");
  check.Near(GetSkinBounds(filter)[0] + GetSkinBounds(filter)[1], 0.5, 0.01, "moved");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "WhatShapesTheMotionRestartsIt", WhatShapesTheMotionRestartsIt },
      { "WhatDoesNotShapeTheMotionDoesNotRestartIt", WhatDoesNotShapeTheMotionDoesNotRestartIt },
      { "ThreadsDoNotChangeTheBytes", ThreadsDoNotChangeTheBytes },
      { "ChangesUpstreamRestart", ChangesUpstreamRestart },
      { "InputsThatModifyThemselvesDoNotRestart", InputsThatModifyThemselvesDoNotRestart },
      { "OtherConsumersOfTheInputDoNotMatter", OtherConsumersOfTheInputDoNotMatter },
      { "StaticDataThatChangeRestart", StaticDataThatChangeRestart } });
}
