// What an exact control tells of a target that it cannot follow, and that it tells it of no other.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkNew.h"
#include "vtkSphere.h"

using namespace activesurface;

namespace
{

constexpr const char* Words = "Does the target meet the initial shape?";

vtkSmartPointer<vtkSphere> MakeSphere(double x, double radius)
{
  auto sphere = vtkSmartPointer<vtkSphere>::New();
  sphere->SetCenter(x, 0.0, 0.0);
  sphere->SetRadius(radius);
  return sphere;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeHeld(vtkSphere* start, vtkSphere* target)
{
  auto filter = MakeShrinkingBall();
  filter->SetInitialFunction(start);
  filter->SetTargetFunction(target);
  filter->SetTargetReach(0.2);
  filter->SetAttraction(5.0);
  filter->SetVolumeControlToExact();
  return filter;
}

int CountWarnings(vtkActiveImplicitSurface* filter)
{
  Messages messages(filter);
  for (const double time : { 0.1, 0.2, 0.5, 1.0 })
  {
    filter->UpdateTimeStep(time);
  }
  return Messages::Count(messages.Warnings, Words);
}

}

void ATargetOutsideIsAWarning(Check& check)
{
  const auto start = MakeSphere(-0.5, 0.3), away = MakeSphere(0.6, 0.3);
  auto volume = MakeHeld(start, away);
  check.Equal(CountWarnings(volume), 1, "warnings in all, with the volume held");
  check.Less(GetSkinBounds(volume)[1], 0.0, "where the skin still is");
  auto area = MakeHeld(start, away);
  area->SetVolumeControlToNone();
  area->SetAreaControlToExact();
  check.Equal(CountWarnings(area), 1, "warnings in all, with the area held");
}

// What is met, or only just within reach at one side, is followed; a skin at rest rests.
void ATargetThatIsMetIsNoWarning(Check& check)
{
  const auto ball = MakeSphere(0.0, 0.4);
  check.Equal(CountWarnings(MakeHeld(ball, ball)), 0, "warnings, at rest on the target");
  check.Equal(CountWarnings(MakeHeld(ball, MakeSphere(0.0, 0.3))), 0, "inside, within reach");
  check.Equal(CountWarnings(MakeHeld(ball, MakeSphere(0.0, 0.7))), 0, "inside the target");
  check.Equal(CountWarnings(MakeHeld(ball, MakeSphere(0.2, 0.4))), 0, "on the way aside");
  check.Equal(
    CountWarnings(MakeHeld(MakeSphere(-0.4, 0.3), MakeSphere(0.3, 0.3))), 0, "nearly in touch");
}

void ATranslationIsNoWarning(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetVolumeControlToExact();
  Messages messages(filter);
  for (const double time : { 1.0, 2.0, 3.0, 4.0 })
  {
    filter->UpdateTimeStep(time);
  }
  check.Equal(Messages::Count(messages.Warnings, Words), 0, "warnings");
  check.Less(0.6, GetSkinBounds(filter)[0], "where the skin has got to, .8 at its middle");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "ATargetOutsideIsAWarning", ATargetOutsideIsAWarning },
      { "ATargetThatIsMetIsNoWarning", ATargetThatIsMetIsNoWarning },
      { "ATranslationIsNoWarning", ATranslationIsNoWarning } });
}
