// Impossible requests give one error with a reason and empty outputs. The filter works again when
// the cause is removed.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkAMRBox.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkMolecule.h"
#include "vtkOverlappingAMR.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUniformGrid.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestMessages
{

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

// Checks that an update reports one error with these words, besides the executive's, and leaves no
// output.
void Refuses(vtkActiveImplicitSurface* filter, const std::string& words, double time = 0.2)
{
  MessageCapture messages(filter);
  filter->UpdateTimeStep(time);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, words), 1) << "errors with \"" << words << "\"";
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "vtkActiveImplicitSurface ("), 1)
    << "own errors";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  EXPECT_EQ(filter->GetPotential()->GetNumberOfPoints(), 0) << "nodes";
}

void Works(vtkActiveImplicitSurface* filter, const std::string& sentence)
{
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.2);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, ""), 0) << "errors, " << sentence;
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles, " << sentence;
}

}

TEST(TestMessages, NoTargetIsAnError)
{
  vtkNew<vtkActiveImplicitSurface> filter;
  Refuses(filter, "There is no target; set TargetFunction, or connect particles");
}

TEST(TestMessages, TwoTargetsAreAnError)
{
  auto filter = MakeShrinkingBall();
  Works(filter, "with one target");
  filter->SetInputData(MakeTwoPoints());
  Refuses(filter, "There are two targets, TargetFunction and the input");
  filter->RemoveAllInputs();
  Works(filter, "with one target again");
}

TEST(TestMessages, UnknownBoundsAreAnError)
{
  auto filter = MakeShrinkingBall();
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  Refuses(filter, "set ModelBounds to a box around the initial shape");
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  Works(filter, "with bounds");
}

TEST(TestMessages, NumbersThatCannotBeAreErrors)
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
    { "but is 1.5.", [](Filter f) { f->SetCFL(1.5); } },
    { "TimeScale has to be", [](Filter f) { f->SetTimeScale(-1.0); } },
    { "KernelRadius has to be", [](Filter f) { f->SetKernelRadius(NaN); } },
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
    Refuses(filter, words);
  }
}

TEST(TestMessages, TooManyVoxelsAreAnError)
{
  auto filter = MakeShrinkingBall();
  filter->SetMaximumNumberOfActiveVoxels(1000);
  Refuses(filter, "MaximumNumberOfActiveVoxels");
  filter->SetMaximumNumberOfActiveVoxels(1000000);
  Works(filter, "with more");
  filter->SetVoxelSize(1e-3);
  Refuses(filter, "MaximumNumberOfActiveVoxels");
}

TEST(TestMessages, GrowingBeyondTheMaximumIsAnError)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> large;
  large->SetRadius(0.9);
  filter->SetTargetFunction(large);
  filter->SetModelBounds(-0.65, 0.65, -0.65, 0.65, -0.65, 0.65);
  filter->SetMaximumNumberOfActiveVoxels(10000); // radius 0.6: 7200 voxels, 0.9: 16000
  Works(filter, "at first");
  Refuses(filter, "MaximumNumberOfActiveVoxels", 1.0);
  filter->SetMaximumNumberOfActiveVoxels(60000);
  const std::string bytes = GetBytesAt(filter, 1.0);
  EXPECT_GT(GetSkinBounds(filter)[1], 0.7) << "radius when it may";
  auto direct = MakeShrinkingBall();
  direct->SetTargetFunction(large);
  direct->SetModelBounds(-0.65, 0.65, -0.65, 0.65, -0.65, 0.65);
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(direct, 1.0))) << "the same bytes as without an error";
}

TEST(TestMessages, OtherCellsAreNoTarget)
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
  Refuses(filter, "A vtkPolyData with both polygons and lines cannot be an input");

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(both->GetPoints());
  const vtkIdType corners[] = { 0, 1, 2 };
  grid->InsertNextCell(VTK_TRIANGLE, 3, corners);
  filter->SetInputData(grid);
  Refuses(filter, "A vtkUnstructuredGrid with other cells than vertices cannot be an input");
}

TEST(TestMessages, ImagesWithoutFittingValuesAreNoTarget)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 4, 4);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(image);
  Refuses(filter, "The image of input port 0 has no active point scalars");
  image->AllocateScalars(VTK_FLOAT, 3);
  Refuses(filter, "cannot be used as the image's values, which need one number for each point");
}

TEST(TestMessages, LevelsAreNoTarget)
{
  vtkNew<vtkOverlappingAMR> levels;
  const int count[] = { 1 };
  const double zero[] = { 0.0, 0.0, 0.0 }, one[] = { 1.0, 1.0, 1.0 };
  const int low[] = { 0, 0, 0 }, high[] = { 3, 3, 3 };
  levels->Initialize(1, count);
  levels->SetGridDescription(VTK_XYZ_GRID);
  levels->SetOrigin(zero);
  levels->SetSpacing(0, one);
  levels->SetAMRBox(0, 0, vtkAMRBox(low, high));
  vtkNew<vtkUniformGrid> grid;
  grid->SetDimensions(5, 5, 5);
  levels->SetDataSet(0, 0, grid);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputDataObject(levels);
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_EQ(
    MessageCapture::Count(messages.Errors, "The input is a composite data set of levels"), 1)
    << "errors";
}

TEST(TestMessages, OtherDataAreRefusedByThePipeline)
{
  vtkNew<vtkMolecule> molecule;
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputDataObject(molecule);
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_GT(MessageCapture::Count(messages.PipelineErrors, "is of type vtkMolecule"), 0)
    << "errors";
  filter->SetInputConnection(nullptr);
  filter->SetInputDataObject(1, vtkNew<vtkTable>());
  filter->Update();
  EXPECT_GT(MessageCapture::Count(messages.PipelineErrors, "is of type vtkTable"), 0) << "errors";
}

TEST(TestMessages, ArraysThatCannotBeAreErrors)
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
  filter->SetKernelRadius(0.3);
  filter->SetInputArrayToProcess(0, 0, 0, points, "mass");
  Refuses(filter, "no point array as chosen by SetInputArrayToProcess(0");
  Refuses(filter, "one of the input's point arrays");
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "half");
  Refuses(filter, "no point array as chosen by SetInputArrayToProcess(0");
  filter->SetInputArrayToProcess(0, 0, 0, points, "name");
  Refuses(filter, "\"name\" cannot be used as the particles' radii");
  filter->SetInputArrayToProcess(0, 0, 0, points, "velocity");
  Refuses(filter, "\"velocity\" cannot be used as the particles' radii");
  filter->SetInputArrayToProcess(0, 0, 0, points, "half");
  Works(filter, "with radii");
  filter->SetInputArrayToProcess(1, 0, 0, points, "half");
  Refuses(filter, "\"half\" cannot be used as the particles' ids, which have to be integers");
  filter->SetInputArrayToProcess(1, 0, 0, points, "");
  filter->SetInputArrayToProcess(2, 0, 0, points, "velocity");
  Refuses(filter, "\"velocity\" cannot be used as the particles' strengths");
}

TEST(TestMessages, OneParticleHasNoSpacing)
{
  vtkSmartPointer<vtkPolyData> data = MakeTwoPoints();
  data->GetPoints()->SetPoint(1, 0.0, 0.0, 0.0);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(data);
  Refuses(filter, "The points' spacing cannot be estimated");
  filter->SetKernelRadius(0.5);
  Works(filter, "with a radius");
}

TEST(TestMessages, StepsOfTheInputHaveToAscend)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  const std::string words = "The time steps of the input have to be finite and ascending, but ";
  source->SetSteps({ 0.0, 1.0, 0.5 });
  Refuses(MakeSkinOver(source),
    words + "step 2 (counted from 0) is 0.5, after 1; check the TIME_STEPS of the source");
  source->SetSteps({ NaN, 1.0 });
  Refuses(MakeSkinOver(source),
    words + "step 0 (counted from 0) is nan; check the TIME_STEPS of the source");
}

TEST(TestMessages, InputThatFailsIsAnError)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0 });
  source->SetFailingExecution(2);
  auto filter = MakeSkinOver(source);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(
    MessageCapture::Count(messages.Errors, "update of the input failed at the time step 2"), 1)
    << "errors";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  source->SetFailingExecution(-1);
  source->Modified();
  const std::string bytes = GetBytesAt(filter, 3.0);
  vtkNew<ParticleSource> sound;
  sound->SetCloud(MovingBall);
  sound->SetSteps({ 0.0, 1.0, 2.0, 3.0 });
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(MakeSkinOver(sound), 3.0)))
    << "the same bytes when it works again";
}

TEST(TestMessages, ErrorsAreToldAgain)
{
  auto filter = MakeShrinkingBall();
  filter->SetCFL(2.0);
  Refuses(filter, "CFL");
  Refuses(filter, "CFL");
  Refuses(filter, "CFL", 0.3);
}

TEST(TestMessages, NoParticlesAreAWarning)
{
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputData(nothing);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.5);
  filter->UpdateTimeStep(0.75);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "The target is empty"), 1) << "warnings";
  EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
  EXPECT_TRUE(filter->GetOutput()->GetPoints() != nullptr) << "the output is valid";
}

TEST(TestMessages, TargetsThatNeverMeetAreAWarning)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> away;
  away->SetRadius(0.1);
  away->SetCenter(0.8, 0.8, 0.8);
  filter->SetTargetFunction(away);
  filter->SetTimeStepSize(1.0);
  MessageCapture messages(filter);
  for (int step = 0; step <= 10; ++step)
  {
    filter->UpdateTimeStep(step);
  }
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "The skin has vanished"), 1) << "warnings";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  EXPECT_EQ(messages.Errors.size(), 0u) << "errors";
}

TEST(TestMessages, NoSurfaceWithinTheBoundsIsAWarning)
{
  auto filter = MakeShrinkingBall();
  filter->SetModelBounds(5.0, 6.0, 5.0, 6.0, 5.0, 6.0);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.4);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "no surface within the bounds"), 1)
    << "warnings";
  EXPECT_EQ(messages.Warnings.size(), 1u) << "warnings in all";
}

TEST(TestMessages, TargetThatIsNotFiniteIsAWarning)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> nowhere;
  nowhere->SetRadius(NaN);
  filter->SetTargetFunction(nowhere);
  MessageCapture messages(filter);
  for (int step = 0; step <= 4; ++step)
  {
    filter->UpdateTimeStep(0.1 * step);
  }
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "the target was not a finite number"), 1)
    << "warnings";
  EXPECT_EQ(messages.Warnings.size(), 1u) << "warnings in all";

  messages.Warnings.clear();
  filter->SetInitialFunction(nullptr);
  filter->UpdateTimeStep(0.0);
  EXPECT_EQ(MessageCapture::Count(
              messages.Warnings, "not a finite number at any sampled point within the bounds"),
    1)
    << "warnings of the start";
}

}
