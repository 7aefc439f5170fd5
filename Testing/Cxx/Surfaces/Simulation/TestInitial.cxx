// Initial shape of the skin from input port 1.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/SameSkins.h"
#include "Support/ShapeSource.h"

#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace activesurface;

namespace TestInitial
{

namespace
{

constexpr double VoxelSize = 0.0625;

// The mesh is 0.0016 r inside the ball, 0.02 h. Interpolation adds 0.04 h, chords 0.01 h.
constexpr double Tolerance = 0.08 * VoxelSize;

// MakeShrinkingBall with the start from port 1.
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

void Refuses(vtkAlgorithm* start, const std::string& words)
{
  auto filter = MakeShrinking(start);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.2);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, words), 1) << "errors with \"" << words << "\"";
  vtkPolyData* skin = filter->GetOutput(); // null for composite inputs
  EXPECT_EQ(skin ? skin->GetNumberOfPoints() : 0, 0) << "points";
}

}

TEST(TestInitial, MeshIsLikeTheFunction)
{
  auto function = MakeShrinkingBall();
  auto filter = MakeShrinking(MakeMeshSource(0.6));
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.6, Tolerance, "at the start");
  filter->UpdateTimeStep(0.5);
  function->UpdateTimeStep(0.5);
  CheckBall(filter, GetRadii(function).Least, Tolerance, "later");
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

// TargetIsoValue and InvertTarget define the inside of an initial image, as for the target.
TEST(TestInitial, ImageIsLikeTheFunction)
{
  auto filter = MakeShrinking(MakeSource([](double) { return MakeBallImage(0.6); }));
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.6, Tolerance, "at the start");
  filter->SetTargetIsoValue(0.13);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.7, Tolerance, "at a level");
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
  CheckBall(filter, 0.6, Tolerance, "inverted");
}

TEST(TestInitial, OpenMeshIsAWarningOrAShell)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetThetaResolution(64);
  bowl->SetPhiResolution(32);
  bowl->SetEndPhi(90.0);
  auto filter = MakeShrinking(bowl);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.2);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "port 1, Initial: The mesh"), 1) << "warnings";
  filter->SetMeshThickness(0.2);
  filter->UpdateTimeStep(0.0);
  EXPECT_NEAR(GetRadii(filter).Largest, 0.6, Tolerance) << "outer radius of the shell";
}

TEST(TestInitial, BothAreAnError)
{
  auto filter = MakeShrinkingBall();
  filter->SetInputConnection(1, MakeMeshSource(0.6)->GetOutputPort());
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "There are two initial shapes"), 1) << "errors";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  filter->SetInitialFunction(nullptr);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles with one";
}

TEST(TestInitial, WhatIsNoShapeIsAnError)
{
  Refuses(MakeSource([](double) { return vtkSmartPointer<vtkPolyData>::New(); }),
    "port 1, Initial, is empty");
  Refuses(MakeSource([](double) { return MakeLines(); }),
    "port 1, Initial, is a skeleton of lines, which is no initial shape");
  Refuses(MakeSource(
            [](double)
            {
              vtkNew<vtkImageData> image;
              image->SetDimensions(4, 4, 4);
              return vtkSmartPointer<vtkDataSet>(image);
            }),
    "image of input port 1 has no active point scalars");
}

TEST(TestInitial, OneBlockAloneIsTheShape)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  blocks->SetBlock(1, MakeBallMesh(0.6));
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  const auto filter = MakeShrinking(producer);
  filter->Update();
  ASSERT_TRUE(filter->GetOutput()) << "a vtkPolyData";
  const auto mesh = MakeMeshSource(0.6);
  const auto plain = MakeShrinking(mesh);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.2), GetBytesAt(plain, 0.2)));
}

TEST(TestInitial, ChangeOfTheInputRestarts)
{
  auto source = MakeMeshSource(0.6);
  auto filter = MakeShrinking(source);
  filter->UpdateTimeStep(0.3);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.4);
  const auto oneStep = filter->GetTargetEvaluations();
  EXPECT_GT(oneStep, 0) << "evaluations";
  EXPECT_EQ(source->Executions.size(), 1u) << "executions";
  source->SetShape([](double) { return MakeBallMesh(0.7); });
  filter->ResetCounters();
  filter->UpdateTimeStep(0.5);
  EXPECT_LT(2 * oneStep, filter->GetTargetEvaluations()) << "evaluations from the start again";
  EXPECT_TRUE(AreSameSkins(GetBytes(filter), GetBytesAt(MakeShrinking(MakeMeshSource(0.7)), 0.5)))
    << "the same bytes";
}

// An earlier time restarts from the stored initial shape.
TEST(TestInitial, InputIsAskedForItsFirstStepOnly)
{
  auto source = MakeSource([](double t) { return MakeBallMesh(0.6 + 0.01 * t); }, { 3, 4, 5 });
  auto filter = MakeShrinking(source);
  filter->UpdateTimeStep(0.4);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.63, Tolerance, "at the start");
  EXPECT_EQ(source->GetExecutions(), "3 ") << "times asked for";
}

TEST(TestInitial, OneSourceMayBeBoth)
{
  auto source = MakeSource([](double t) { return MakeBallMesh(0.5, 0.1 * t); }, { 0, 1, 2 });
  auto both = MakeShrinking(source);
  both->SetTargetFunction(nullptr);
  both->SetAttraction(1.0);
  both->SetInputConnection(0, source->GetOutputPort());
  both->UpdateTimeStep(1.0);
  both->UpdateTimeStep(2.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 ") << "times asked for";
  // The target moves by 0.1 per unit of time. The skin lags behind by 0.1 (1 - e^-2).
  const auto bounds = GetSkinBounds(both);
  const double centre = 0.5 * (bounds[0] + bounds[1]);
  EXPECT_NEAR(centre, 0.2 - 0.1 * (1.0 - std::exp(-2.0)), 0.5 * VoxelSize) << "centre";
}

// After a failure the filter requests another step, because VTK would not repeat the failed
// request. The initial shape is that of the first step nevertheless.
TEST(TestInitial, OneSourceMayBeBothAfterAFailure)
{
  const auto make = [] {
    return MakeSource([](double t) { return MakeBallMesh(0.5 + 0.1 * t); }, { 0, 1, 2 });
  };
  const auto over = [](ShapeSource* source, int mode)
  {
    auto filter = MakeShrinking(source);
    filter->SetTargetFunction(nullptr);
    filter->SetInputConnection(0, source->GetOutputPort());
    filter->SetAttraction(0.0);
    filter->SetEvolutionMode(mode);
    return filter;
  };
  for (const int mode :
    { vtkActiveImplicitSurface::TRANSIENT, vtkActiveImplicitSurface::EQUILIBRIUM })
  {
    auto source = make(), good = make();
    auto filter = over(source, mode), expected = over(good, mode);
    source->SetFailing(true);
    MessageCapture messages(filter->GetExecutive());
    MessageCapture ofSource(source->GetExecutive());
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points after the failure";
    source->SetFailing(false);
    filter->Update();
    expected->Update();
    CheckBall(expected, 0.5, Tolerance, "of the first step");
    EXPECT_TRUE(GetBytes(filter) == GetBytes(expected)) << "the same skin";
  }
}

// The automatic bounds are 1.5 wide: a mesh of width 1.2, and a quarter of its width.
TEST(TestInitial, BoundsComeFromTheInput)
{
  auto filter = MakeShrinking(MakeMeshSource(0.6));
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  filter->SetVoxelSize(-1.0);
  filter->OutputPotentialOn();
  filter->Update();
  EXPECT_NEAR(filter->GetPotential()->GetSpacing()[0], 1.5 / 64.0, 1e-9) << "voxel size";
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles";
}

}
