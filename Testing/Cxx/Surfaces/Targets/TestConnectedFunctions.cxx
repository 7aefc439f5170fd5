// Implicit functions with the output of an algorithm as input: evaluation updates the algorithm,
// and any upstream change modifies the function.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/SkeletonShapes.h"

#include "vtkAlgorithmOutput.h"
#include "vtkGridPotential.h"
#include "vtkImageCast.h"
#include "vtkImageData.h"
#include "vtkLineSource.h"
#include "vtkRTAnalyticSource.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace activesurface;

namespace TestConnectedFunctions
{

namespace
{

// Returns x of the least value. The moving ball's particle is at x = 0.2 t.
double FindLeast(vtkSkeletonPotential* potential)
{
  double best = 0.0, least = 1.0;
  for (int i = 0; i <= 20; ++i)
  {
    const double value = ValueAt(potential, { 0.1 * i, 0.0, 0.0 });
    best = value < least ? 0.1 * i : best;
    least = std::min(least, value);
  }
  return best;
}

}

TEST(TestConnectedFunctions, ConnectedSkeletonFollowsItsAlgorithm)
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(0.0, 0.0, 0.0);
  line->SetPoint2(1.0, 0.0, 0.0);
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInputConnection(line->GetOutputPort());
  EXPECT_EQ(ValueAt(potential, { 0.5, 0.0, 0.0 }), -0.5) << "on the line";
  EXPECT_TRUE(potential->GetInputConnection() == line->GetOutputPort()) << "the connection";
  const vtkMTimeType before = potential->GetMTime();
  line->SetPoint1(0.0, 3.0, 0.0);
  line->SetPoint2(1.0, 3.0, 0.0);
  EXPECT_TRUE(potential->GetMTime() > before) << "the line has gone, GetMTime";
  EXPECT_EQ(ValueAt(potential, { 0.5, 0.0, 0.0 }), 0.5) << "where the line was";
  EXPECT_EQ(ValueAt(potential, { 0.5, 3.0, 0.0 }), -0.5) << "where it is";
  potential->SetInputConnection(nullptr);
  EXPECT_EQ(ValueAt(potential, { 0.5, 3.0, 0.0 }), 0.5) << "disconnected";
}

// A sphere of 64 x 64 triangles is within 2 r sin^2(pi / 64) of the exact one: 0.0024 and 0.0034.
// Interpolation between samples adds at most 0.25 voxel = 0.006.
TEST(TestConnectedFunctions, ConnectedMeshFollowsItsAlgorithm)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkGridPotential> potential;
  potential->SetVoxelSize(0.025);
  potential->SetInputConnection(sphere->GetOutputPort());
  EXPECT_NEAR(potential->FunctionValue(0.6, 0.0, 0.0), 0.1, 0.01) << "outside a radius of .5";
  sphere->SetRadius(0.7);
  potential->GetMTime();
  EXPECT_NEAR(potential->FunctionValue(0.6, 0.0, 0.0), -0.1, 0.01) << "inside a radius of .7";
  EXPECT_TRUE(potential->GetInput() == sphere->GetOutput()) << "the input is the output";
}

TEST(TestConnectedFunctions, ConnectedImageFollowsAChainOfAlgorithms)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-4, 4, -4, 4, -4, 4);
  vtkNew<vtkImageCast> cast;
  cast->SetInputConnection(source->GetOutputPort());
  cast->SetOutputScalarTypeToDouble();
  vtkNew<vtkGridPotential> potential;
  potential->SetInputConnection(cast->GetOutputPort());
  const double value = potential->FunctionValue(1.0, 2.0, 3.0);
  const vtkMTimeType before = potential->GetMTime();
  source->SetMaximum(2.0 * source->GetMaximum());
  EXPECT_TRUE(potential->GetMTime() > before) << "GetMTime";
  EXPECT_TRUE(potential->FunctionValue(1.0, 2.0, 3.0) > value) << "the image is brighter";
}

TEST(TestConnectedFunctions, EvaluatingIsNoChange)
{
  auto source = MakeMovingBall();
  source->SetRestless(true);
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInputConnection(source->GetOutputPort());
  const vtkMTimeType before = potential->GetMTime();
  ValueAt(potential, { 0.0, 0.0, 0.0 });
  EXPECT_EQ(potential->GetMTime(), before) << "GetMTime after an evaluation";
  ValueAt(potential, { 0.0, 0.0, 0.0 });
  EXPECT_EQ(source->GetExecutions(), "0 ") << "executions";
}

TEST(TestConnectedFunctions, AnotherTimeUpstreamIsAChange)
{
  auto source = MakeMovingBall();
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetRadius(0.5);
  potential->SetInputConnection(source->GetOutputPort());
  EXPECT_EQ(FindLeast(potential), 0.0) << "place at the first time";
  const vtkMTimeType before = potential->GetMTime();
  source->UpdateTimeStep(4.0);
  EXPECT_TRUE(potential->GetMTime() > before) << "GetMTime after the source was asked for another";
  EXPECT_NEAR(FindLeast(potential), 0.8, 1e-12) << "place at time 4";
}

TEST(TestConnectedFunctions, AllOfTheOutputIsRead)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkGridPotential> potential;
  potential->SetInputConnection(sphere->GetOutputPort());
  sphere->UpdatePiece(1, 2, 0);
  EXPECT_TRUE(sphere->GetOutput()->GetNumberOfPolys() < 60)
    << "somebody has asked for a piece of it";
  EXPECT_TRUE(potential->FunctionValue(0.0, 0.0, 0.0) < 0.0) << "the centre is inside";
  EXPECT_EQ(std::string(potential->GetDefects()), "") << "defects of the mesh";
}

TEST(TestConnectedFunctions, AllOfAnImageIsRead)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-4, 4, -4, 4, -4, 4);
  vtkNew<vtkGridPotential> potential;
  potential->SetInputConnection(source->GetOutputPort());
  const int corner[6] = { -1, 1, -1, 1, -1, 1 };
  source->UpdateExtent(corner);
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 27) << "somebody has asked for a part of it";
  double bounds[6];
  EXPECT_TRUE(potential->GetGridBounds(bounds)) << potential->GetError();
  EXPECT_EQ(bounds[0], -4.0) << "x min of all of it";
  EXPECT_EQ(bounds[1], 4.0) << "x max of all of it";
}

TEST(TestConnectedFunctions, AnAlgorithmOfTheWrongKindIsOneError)
{
  vtkNew<vtkRTAnalyticSource> image;
  image->SetWholeExtent(-1, 1, -1, 1, -1, 1);
  vtkNew<vtkSkeletonPotential> potential;
  MessageCapture messages(potential);
  potential->SetInputConnection(image->GetOutputPort());
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.5) << "value";
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.5) << "value, again";
  EXPECT_EQ(messages.Errors.size(), 1u) << "errors";
}

TEST(TestConnectedFunctions, SkinFollowsAConnectedFunction)
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-0.3, 0.0, 0.0);
  line->SetPoint2(0.3, 0.0, 0.0);
  vtkNew<vtkSkeletonPotential> connected, given;
  connected->SetInputConnection(line->GetOutputPort());
  line->Update();
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(line->GetOutput());
  given->SetInput(copy);
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(given);
  const std::string expected = GetBytesAt(filter, 0.4);
  filter->SetTargetFunction(connected);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.4), expected)) << "the same bytes";
  int executions = 0;
  CountExecutions(filter, executions);
  filter->Update();
  EXPECT_EQ(executions, 0) << "executions without a change";
  line->SetPoint2(0.3, 0.3, 0.0);
  EXPECT_TRUE(GetBytesAt(filter, 0.4) != expected) << "other bytes for another line";
  EXPECT_EQ(executions, 1) << "executions after a change";
}

}
