// The shape that the skin starts with, from input port 1.

#include "Check.h"
#include "PipelineTools.h"
#include "ShapeSource.h"

#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

using namespace activesurface;

namespace
{

constexpr double VoxelSize = 0.0625;

// The mesh is .0016 r inside the ball, .02 h; interpolation is off by .04 h, chords by .01 h.
constexpr double Tolerance = 0.08 * VoxelSize;

// As MakeShrinkingBall, but that the start comes through port 1.
vtkSmartPointer<vtkActiveImplicitSurface> MakeShrinking(vtkAlgorithm* start)
{
  auto filter = MakeShrinkingBall();
  filter->SetInitialFunction(nullptr);
  filter->SetInputConnection(1, start->GetOutputPort());
  return filter;
}

vtkSmartPointer<ShapeSource> MakeMeshSource(double radius)
{
  return MakeSource([radius](double) { return MakeBallMesh(radius); });
}

void IsABall(Check& check, vtkActiveImplicitSurface* filter, double radius, const std::string& name)
{
  const Radii radii = GetRadii(filter);
  check.Near(radii.Least, radius, Tolerance, "least radius, " + name);
  check.Near(radii.Largest, radius, Tolerance, "largest radius, " + name);
}

void Refuses(Check& check, vtkAlgorithm* start, const std::string& words)
{
  auto filter = MakeShrinking(start);
  Messages messages(filter);
  filter->UpdateTimeStep(0.2);
  check.Equal(Messages::Count(messages.Errors, words), 1, "errors with \"" + words + "\"");
  vtkPolyData* skin = filter->GetOutput(); // none where an input is composite
  check.Equal(skin ? skin->GetNumberOfPoints() : 0, 0, "points");
}

}

void MeshIsLikeTheFunction(Check& check)
{
  auto function = MakeShrinkingBall();
  auto filter = MakeShrinking(MakeMeshSource(0.6));
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.6, "at the start");
  filter->UpdateTimeStep(0.5);
  function->UpdateTimeStep(0.5);
  IsABall(check, filter, GetRadii(function).Least, "later");
  check.Equal(messages.Warnings.size() + messages.Errors.size(), std::size_t(0), "messages");
}

// Inside is where TargetIsoValue and InvertTarget say, for an image; they are the target's too.
void ImageIsLikeTheFunction(Check& check)
{
  auto filter = MakeShrinking(MakeSource([](double) { return MakeBallImage(0.6); }));
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.6, "at the start");
  filter->SetTargetIsoValue(0.13);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.7, "at a level");
  const auto negative = [](double)
  {
    vtkSmartPointer<vtkImageData> image = MakeBallImage(0.6);
    vtkDataArray* values = image->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      values->SetTuple1(i, -values->GetTuple1(i));
    }
    return image;
  };
  filter = MakeShrinking(MakeSource(negative));
  filter->InvertTargetOn();
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.6, "inverted");
}

void OpenMeshIsAWarningOrAShell(Check& check)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetThetaResolution(64);
  bowl->SetPhiResolution(32);
  bowl->SetEndPhi(90.0);
  auto filter = MakeShrinking(bowl);
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.2);
  check.Equal(Messages::Count(messages.Warnings, "port 1, Initial: The mesh"), 1, "warnings");
  filter->SetMeshThickness(0.2);
  filter->UpdateTimeStep(0.0);
  check.Near(GetRadii(filter).Largest, 0.6, Tolerance, "outer radius of the shell");
}

void BothAreAnError(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetInputConnection(1, MakeMeshSource(0.6)->GetOutputPort());
  Messages messages(filter);
  filter->Update();
  check.Equal(Messages::Count(messages.Errors, "There are two initial shapes"), 1, "errors");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
  filter->SetInitialFunction(nullptr);
  filter->Update();
  check.Less(0, filter->GetOutput()->GetNumberOfPolys(), "triangles with one");
}

void WhatIsNoShapeIsAnError(Check& check)
{
  Refuses(check, MakeSource([](double) { return vtkSmartPointer<vtkPolyData>::New(); }),
    "port 1, Initial, is empty");
  Refuses(check, MakeSource([](double) { return MakeLines(); }),
    "port 1, Initial, is a skeleton of lines, which is no initial shape");
  Refuses(check,
    MakeSource(
      [](double)
      {
        vtkNew<vtkImageData> image;
        image->SetDimensions(4, 4, 4);
        return vtkSmartPointer<vtkDataSet>(image);
      }),
    "image of input port 1 has no active point scalars");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBallMesh(0.6));
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  Refuses(check, producer, "port 1 is a composite data set");
}

void ChangeOfTheInputRestarts(Check& check)
{
  auto source = MakeMeshSource(0.6);
  auto filter = MakeShrinking(source);
  filter->UpdateTimeStep(0.3);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.4);
  const auto oneStep = filter->GetTargetEvaluations();
  check.Less(0, oneStep, "evaluations");
  check.Equal(source->Executions.size(), std::size_t(1), "executions");
  source->SetShape([](double) { return MakeBallMesh(0.7); });
  filter->ResetCounters();
  filter->UpdateTimeStep(0.5);
  check.Less(2 * oneStep, filter->GetTargetEvaluations(), "evaluations from the start again");
  check.True(
    GetBytes(filter) == GetBytesAt(MakeShrinking(MakeMeshSource(0.7)), 0.5), "the same bytes");
}

// An earlier time starts anew on the shape that is held.
void InputIsAskedForItsFirstStepOnly(Check& check)
{
  auto source = MakeSource([](double t) { return MakeBallMesh(0.6 + 0.01 * t); }, { 3, 4, 5 });
  auto filter = MakeShrinking(source);
  filter->UpdateTimeStep(0.4);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.63, "at the start");
  check.Equal(source->GetExecutions(), "3 ", "times asked for");
}

void OneSourceMayBeBoth(Check& check)
{
  auto source = MakeSource([](double t) { return MakeBallMesh(0.5, 0.1 * t); }, { 0, 1, 2 });
  auto both = MakeShrinking(source);
  both->SetTargetFunction(nullptr);
  both->SetInputConnection(0, source->GetOutputPort());
  both->UpdateTimeStep(1.0);
  both->UpdateTimeStep(2.0);
  check.Equal(source->GetExecutions(), "0 1 2 ", "times asked for");
  // It goes .1 per unit of time and lags behind by .1 (1 - e^-2).
  const auto bounds = GetSkinBounds(both);
  const double centre = 0.5 * (bounds[0] + bounds[1]);
  check.Near(centre, 0.2 - 0.1 * (1.0 - std::exp(-2.0)), 0.5 * VoxelSize, "centre");
}

// Of a mesh with .6 and a quarter of its width more: 1.5 * .6.
void BoundsComeFromTheInput(Check& check)
{
  auto filter = MakeShrinking(MakeMeshSource(0.6));
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  filter->SetVoxelSize(0.0);
  filter->OutputPotentialOn();
  filter->Update();
  check.Near(filter->GetPotential()->GetSpacing()[0], 1.5 / 64.0, 1e-9, "voxel size");
  check.Less(0, filter->GetOutput()->GetNumberOfPolys(), "triangles");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "MeshIsLikeTheFunction", MeshIsLikeTheFunction },
      { "ImageIsLikeTheFunction", ImageIsLikeTheFunction },
      { "OpenMeshIsAWarningOrAShell", OpenMeshIsAWarningOrAShell },
      { "BothAreAnError", BothAreAnError }, { "WhatIsNoShapeIsAnError", WhatIsNoShapeIsAnError },
      { "ChangeOfTheInputRestarts", ChangeOfTheInputRestarts },
      { "InputIsAskedForItsFirstStepOnly", InputIsAskedForItsFirstStepOnly },
      { "OneSourceMayBeBoth", OneSourceMayBeBoth },
      { "BoundsComeFromTheInput", BoundsComeFromTheInput } });
}
