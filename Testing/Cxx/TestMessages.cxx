// What cannot be done: one error that says why, empty outputs, and a filter that works again when
// the cause is gone.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

using namespace activesurface;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkPolyData> MakeTwoPoints()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(0.2, 0.0, 0.0);
  data->SetPoints(points);
  return data;
}

// An update says one error with these words, besides the executive's, and leaves nothing behind.
void Refuses(
  Check& check, vtkActiveImplicitSurface* filter, const std::string& words, double time = 0.2)
{
  Messages messages(filter);
  filter->UpdateTimeStep(time);
  check.Equal(Messages::Count(messages.Errors, words), 1, "errors with \"" + words + "\"");
  check.Equal(Messages::Count(messages.Errors, "vtkActiveImplicitSurface.cxx"), 1, "own errors");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
  check.Equal(filter->GetPotential()->GetNumberOfPoints(), 0, "nodes");
  filter->RemoveAllObservers();
  filter->GetExecutive()->RemoveAllObservers();
}

void Works(Check& check, vtkActiveImplicitSurface* filter, const std::string& sentence)
{
  Messages messages(filter);
  filter->UpdateTimeStep(0.2);
  check.Equal(Messages::Count(messages.Errors, ""), 0, "errors, " + sentence);
  check.Less(0, filter->GetOutput()->GetNumberOfPolys(), "triangles, " + sentence);
  filter->RemoveAllObservers();
  filter->GetExecutive()->RemoveAllObservers();
}

}

void NoTargetIsAnError(Check& check)
{
  vtkNew<vtkActiveImplicitSurface> filter;
  Refuses(check, filter, "There is no target; set TargetFunction, or connect particles");
}

void TwoTargetsAreAnError(Check& check)
{
  auto filter = MakeShrinkingBall();
  Works(check, filter, "with one target");
  filter->SetInputData(MakeTwoPoints());
  Refuses(check, filter, "There are two targets, TargetFunction and the input");
  filter->RemoveAllInputs();
  Works(check, filter, "with one target again");
}

void UnknownBoundsAreAnError(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  Refuses(check, filter, "set ModelBounds to a box around the shape");
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  Works(check, filter, "with bounds");
}

void NumbersThatCannotBeAreErrors(Check& check)
{
  using Filter = vtkActiveImplicitSurface*;
  const std::vector<std::pair<std::string, std::function<void(Filter)>>> cases = {
    { "VoxelSize has to be", [](Filter f) { f->SetVoxelSize(NaN); } },
    { "ModelBounds has to be", [](Filter f) { f->SetModelBounds(0, NaN, 0, 1, 0, 1); } },
    { "on axis y it is 1, -2", [](Filter f) { f->SetModelBounds(0, 1, 1, -2, 0, 1); } },
    { "on axis z it is 3, 3", [](Filter f) { f->SetModelBounds(0, 1, 0, 1, 3, 3); } },
    { "TargetReach has to be", [](Filter f) { f->SetTargetReach(NaN); } },
    { "TargetIsoValue has to be", [](Filter f) { f->SetTargetIsoValue(NaN); } },
    { "Attraction has to be", [](Filter f) { f->SetAttraction(NaN); } },
    { "Tension has to be", [](Filter f) { f->SetTension(NaN); } },
    { "CFL has to be", [](Filter f) { f->SetCFL(0.0); } },
    { "CFL has to be", [](Filter f) { f->SetCFL(1.5); } },
    { "TimeScale has to be", [](Filter f) { f->SetTimeScale(-1.0); } },
    { "ParticleRadius has to be", [](Filter f) { f->SetParticleRadius(NaN); } },
    { "ParticleThreshold has to be", [](Filter f) { f->SetParticleThreshold(NaN); } },
    { "ParticleThreshold has to be", [](Filter f) { f->SetParticleThreshold(0.0); } },
    { "ParticleThreshold has to be", [](Filter f) { f->SetParticleThreshold(-0.5); } },
    { "check StartTime and TimeStepSize", [](Filter f) { f->SetTimeStepSize(0.0); } },
    { "check StartTime and TimeStepSize", [](Filter f) { f->SetTimeStepSize(-0.1); } },
    { "check StartTime and TimeStepSize", [](Filter f) { f->SetStartTime(NaN); } },
    { "check StartTime and TimeStepSize", [](Filter f) { f->SetStartTime(1e30); } },
  };
  for (const auto& [words, change] : cases)
  {
    auto filter = MakeShrinkingBall();
    change(filter);
    Refuses(check, filter, words);
  }
}

void TooManyVoxelsAreAnError(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetMaximumNumberOfActiveVoxels(1000);
  Refuses(check, filter, "MaximumNumberOfActiveVoxels");
  filter->SetMaximumNumberOfActiveVoxels(1000000);
  Works(check, filter, "with more");
  filter->SetVoxelSize(1e-3);
  Refuses(check, filter, "MaximumNumberOfActiveVoxels");
}

// The second of them comes late in the motion.
void GrowingBeyondTheMaximumIsAnError(Check& check)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> large;
  large->SetRadius(0.9);
  filter->SetTargetFunction(large);
  filter->SetModelBounds(-0.65, 0.65, -0.65, 0.65, -0.65, 0.65);
  filter->SetMaximumNumberOfActiveVoxels(10000); // a ball of radius .6 has 7200, of .9 16000
  Works(check, filter, "at first");
  Refuses(check, filter, "MaximumNumberOfActiveVoxels", 1.0);
  filter->SetMaximumNumberOfActiveVoxels(60000);
  const std::string bytes = GetBytesAt(filter, 1.0);
  check.Less(0.7, GetSkinBounds(filter)[1], "radius when it may");
  auto direct = MakeShrinkingBall();
  direct->SetTargetFunction(large);
  direct->SetModelBounds(-0.65, 0.65, -0.65, 0.65, -0.65, 0.65);
  check.True(bytes == GetBytesAt(direct, 1.0), "the same bytes as without an error");
}

void OtherCellsAreNoTarget(Check& check)
{
  vtkNew<vtkPolyData> both;
  both->DeepCopy(MakeTwoPoints());
  both->GetPoints()->InsertNextPoint(0.0, 0.2, 0.0);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  both->SetLines(lines);
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell({ 0, 1, 2 });
  both->SetPolys(polygons);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(both);
  Refuses(check, filter, "A vtkPolyData with both polygons and lines cannot be a target");

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(both->GetPoints());
  const vtkIdType corners[] = { 0, 1, 2 };
  grid->InsertNextCell(VTK_TRIANGLE, 3, corners);
  filter->SetInputData(grid);
  Refuses(check, filter, "A vtkUnstructuredGrid with other cells than vertices cannot be a target");
}

void ImagesWithoutFittingValuesAreNoTarget(Check& check)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 4, 4);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(image);
  Refuses(check, filter, "The image of input port 0 has no active point scalars");
  image->AllocateScalars(VTK_FLOAT, 3);
  Refuses(check, filter, "cannot give an image's values: it has to hold one number for each point");
}

void CompositeDataAreNoTarget(Check& check)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeTwoPoints());
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputConnection(producer->GetOutputPort());
  Messages messages(filter);
  filter->Update();
  check.Equal(Messages::Count(messages.Errors, "The input is a composite data set"), 1, "errors");
}

void OtherDataAreRefusedByThePipeline(Check& check)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputDataObject(table);
  Messages messages(filter);
  filter->Update();
  check.Less(0, Messages::Count(messages.Errors, "is of type vtkTable"), "errors");
}

void ArraysThatCannotBeAreErrors(Check& check)
{
  constexpr int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkSmartPointer<vtkPolyData> data = MakeTwoPoints();
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  names->SetNumberOfValues(2);
  data->GetPointData()->AddArray(names);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("velocity");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(2);
  data->GetPointData()->AddArray(vectors);
  vtkNew<vtkDoubleArray> halves;
  halves->SetName("half");
  halves->InsertNextValue(0.5);
  halves->InsertNextValue(1.0);
  data->GetPointData()->AddArray(halves);

  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(data);
  filter->SetParticleRadius(0.3);
  filter->SetInputArrayToProcess(0, 0, 0, points, "mass");
  Refuses(check, filter, "no point array as chosen by SetInputArrayToProcess(0");
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "half");
  Refuses(check, filter, "no point array as chosen by SetInputArrayToProcess(0");
  filter->SetInputArrayToProcess(0, 0, 0, points, "name");
  Refuses(check, filter, "\"name\" cannot give the particles' radii");
  filter->SetInputArrayToProcess(0, 0, 0, points, "velocity");
  Refuses(check, filter, "\"velocity\" cannot give the particles' radii");
  filter->SetInputArrayToProcess(0, 0, 0, points, "half");
  Works(check, filter, "with radii");
  filter->SetInputArrayToProcess(1, 0, 0, points, "half");
  Refuses(check, filter, "\"half\" cannot give the particles' ids: they have to be integers");
  filter->SetInputArrayToProcess(1, 0, 0, points, "");
  filter->SetInputArrayToProcess(2, 0, 0, points, "velocity");
  Refuses(check, filter, "\"velocity\" cannot give the particles' strengths");
}

void OneParticleHasNoSpacing(Check& check)
{
  vtkSmartPointer<vtkPolyData> data = MakeTwoPoints();
  data->GetPoints()->SetPoint(1, 0.0, 0.0, 0.0);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(data);
  Refuses(check, filter, "The particles' radius cannot be estimated");
  filter->SetParticleRadius(0.5);
  Works(check, filter, "with a radius");
}

void StepsOfTheInputHaveToAscend(Check& check)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  const std::string words = "The time steps of the input have to be finite and ascending, but ";
  source->SetSteps({ 0.0, 1.0, 0.5 });
  Refuses(check, MakeSkinOver(source), words + "number 2 is 0.5, after 1; check what is upstream");
  source->SetSteps({ NaN, 1.0 });
  Refuses(check, MakeSkinOver(source), words + "number 0 is nan; check what is upstream");
}

void InputThatFailsIsAnError(Check& check)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0 });
  source->SetFailingExecution(2);
  auto filter = MakeSkinOver(source);
  Messages messages(filter);
  filter->UpdateTimeStep(3.0);
  check.Equal(
    Messages::Count(messages.Errors, "input has failed to make its time step 2"), 1, "errors");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
  source->SetFailingExecution(-1);
  source->Modified();
  const std::string bytes = GetBytesAt(filter, 3.0);
  vtkNew<ParticleSource> sound;
  sound->SetCloud(MovingBall);
  sound->SetSteps({ 0.0, 1.0, 2.0, 3.0 });
  check.True(bytes == GetBytesAt(MakeSkinOver(sound), 3.0), "the same bytes when it works again");
}

void ErrorsAreToldAgain(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetCFL(2.0);
  Refuses(check, filter, "CFL");
  Refuses(check, filter, "CFL");
  Refuses(check, filter, "CFL", 0.3);
}

void NoParticlesAreAWarning(Check& check)
{
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(nothing);
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.5);
  filter->UpdateTimeStep(0.75);
  check.Equal(Messages::Count(messages.Warnings, "There are no particles"), 1, "warnings");
  check.Equal(messages.Errors.size(), std::size_t(0), "errors");
  check.True(filter->GetOutput()->GetPoints() != nullptr, "the output is valid");
}

void TargetsThatNeverMeetAreAWarning(Check& check)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> away;
  away->SetRadius(0.1);
  away->SetCenter(0.8, 0.8, 0.8);
  filter->SetTargetFunction(away);
  filter->SetTimeStepSize(1.0);
  Messages messages(filter);
  for (int step = 0; step <= 10; ++step)
  {
    filter->UpdateTimeStep(step);
  }
  check.Equal(Messages::Count(messages.Warnings, "The skin has vanished"), 1, "warnings");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
  check.Equal(messages.Errors.size(), std::size_t(0), "errors");
}

void NoSurfaceWithinTheBoundsIsAWarning(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetModelBounds(5.0, 6.0, 5.0, 6.0, 5.0, 6.0);
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.4);
  check.Equal(Messages::Count(messages.Warnings, "no surface within the bounds"), 1, "warnings");
  check.Equal(messages.Warnings.size(), std::size_t(1), "warnings in all");
}

// One message for all steps.
void TargetThatIsNotFiniteIsAWarning(Check& check)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> nowhere;
  nowhere->SetRadius(NaN);
  filter->SetTargetFunction(nowhere);
  Messages messages(filter);
  for (int step = 0; step <= 4; ++step)
  {
    filter->UpdateTimeStep(0.1 * step);
  }
  check.Equal(
    Messages::Count(messages.Warnings, "the target was not a finite number"), 1, "warnings");
  check.Equal(messages.Warnings.size(), std::size_t(1), "warnings in all");

  messages.Warnings.clear();
  filter->SetInitialFunction(nullptr);
  filter->UpdateTimeStep(0.0);
  check.Equal(Messages::Count(messages.Warnings, "not a finite number anywhere within the bounds"),
    1, "warnings of the start");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "NoTargetIsAnError", NoTargetIsAnError }, { "TwoTargetsAreAnError", TwoTargetsAreAnError },
      { "UnknownBoundsAreAnError", UnknownBoundsAreAnError },
      { "NumbersThatCannotBeAreErrors", NumbersThatCannotBeAreErrors },
      { "TooManyVoxelsAreAnError", TooManyVoxelsAreAnError },
      { "GrowingBeyondTheMaximumIsAnError", GrowingBeyondTheMaximumIsAnError },
      { "OtherCellsAreNoTarget", OtherCellsAreNoTarget },
      { "ImagesWithoutFittingValuesAreNoTarget", ImagesWithoutFittingValuesAreNoTarget },
      { "CompositeDataAreNoTarget", CompositeDataAreNoTarget },
      { "OtherDataAreRefusedByThePipeline", OtherDataAreRefusedByThePipeline },
      { "ArraysThatCannotBeAreErrors", ArraysThatCannotBeAreErrors },
      { "OneParticleHasNoSpacing", OneParticleHasNoSpacing },
      { "StepsOfTheInputHaveToAscend", StepsOfTheInputHaveToAscend },
      { "InputThatFailsIsAnError", InputThatFailsIsAnError },
      { "ErrorsAreToldAgain", ErrorsAreToldAgain },
      { "NoParticlesAreAWarning", NoParticlesAreAWarning },
      { "TargetsThatNeverMeetAreAWarning", TargetsThatNeverMeetAreAWarning },
      { "NoSurfaceWithinTheBoundsIsAWarning", NoSurfaceWithinTheBoundsIsAWarning },
      { "TargetThatIsNotFiniteIsAWarning", TargetThatIsNotFiniteIsAWarning } });
}
