// Skeletons, meshes and images as the target: the shapes that they define.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "Index/Skeleton.h"
#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSampleFunction.h"
#include "vtkShortArray.h"
#include "vtkSkeletonPotential.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace activesurface;

namespace TestTargets
{

namespace
{

constexpr double VoxelSize = 0.05;
constexpr int Points = vtkDataObject::FIELD_ASSOCIATION_POINTS;

// The mesh is 0.0016 r = 0.016 h inside the ball. Interpolation of distances adds h^2 / 8 * 2 / r =
// 0.025 h, and chords of the skin h^2 / 8 r = 0.013 h.
constexpr double MeshError = 0.06 * VoxelSize;

// Interpolation of squared distances is off by 3 * 2 * h^2 / 8, over 2 r = 1: 0.038 h. Chords add
// 0.013 h.
constexpr double ImageError = 0.06 * VoxelSize;

void UnsetBounds(vtkActiveImplicitSurface* filter)
{
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
}

void Refuses(vtkActiveImplicitSurface* filter, const std::string& words)
{
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, words), 1) << "errors with \"" << words << "\"";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
}

}

// The skeleton and the function have the same formula, bounds and voxels.
TEST(TestTargets, LinesActLikeASkeletonPotential)
{
  vtkSmartPointer<vtkPolyData> lines = MakeLines();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("size");
  vtkNew<vtkDoubleArray> strengths;
  strengths->SetName("weight");
  vtkNew<vtkDoubleArray> reaches;
  reaches->SetName("reach");
  const double reachPerRadius = 1.0 / FindRadiusOfLevel(SkeletonKernel::CubicSpline, 0.4);
  for (const double size : { 0.1, 0.15, 0.2, 0.125 })
  {
    radii->InsertNextValue(size);
    reaches->InsertNextValue(reachPerRadius * size);
    strengths->InsertNextValue(1.2 - size);
  }
  lines->GetPointData()->AddArray(radii);
  lines->GetPointData()->AddArray(reaches);
  lines->GetPointData()->AddArray(strengths);
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInput(lines);
  potential->SetRadius(0.3);
  auto input = MakeSkinOver(lines);
  auto function = MakeSkin();
  function->SetTargetFunction(potential);
  for (vtkActiveImplicitSurface* filter : { input.Get(), function.Get() })
  {
    filter->SetVoxelSize(-1.0);
    UnsetBounds(filter);
  }
  EXPECT_TRUE(AreSameSkins(GetBytesAt(input, 0.0), GetBytesAt(function, 0.0)))
    << "one radius, at the start";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(input, 1.0), GetBytesAt(function, 1.0)))
    << "one radius, at the end";

  input->SetInputArrayToProcess(0, 0, 0, Points, "size");
  input->SetInputArrayToProcess(2, 0, 0, Points, "weight");
  input->SetParticleKernelToCubicSpline();
  input->SetParticleThreshold(0.4);
  potential->SetRadiusArrayName("reach");
  potential->SetStrengthArrayName("weight");
  potential->SetKernelToCubicSpline();
  potential->SetThreshold(0.4);
  EXPECT_GT(GetBytesAt(function, 0.0).size(), 1000u) << "bytes";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(input, 0.0), GetBytesAt(function, 0.0)))
    << "with arrays, at the start";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(input, 1.0), GetBytesAt(function, 1.0)))
    << "with arrays, at the end";
}

TEST(TestTargets, MeshOfABallGivesABall)
{
  auto filter = MakeSkinOver(MakeBallMesh(0.5));
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.5, MeshError, "at the start");
  filter->UpdateTimeStep(1.0);
  CheckBall(filter, 0.5, MeshError, "at the end");
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(MakeBallMesh(0.5));
  filter->SetInputConnection(stripper->GetOutputPort());
  filter->UpdateTimeStep(0.0);
  EXPECT_GT(stripper->GetOutput()->GetNumberOfStrips(), 0) << "strips";
  CheckBall(filter, 0.5, MeshError, "of strips");
  filter->SetTargetIsoValue(0.1);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.6, MeshError, "at another level");
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

TEST(TestTargets, ImageOfABallGivesABall)
{
  vtkNew<vtkSphere> ball;
  vtkNew<vtkSampleFunction> sampled;
  sampled->SetImplicitFunction(ball);
  sampled->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  sampled->SetSampleDimensions(41, 41, 41);
  auto filter = MakeSkin();
  filter->SetInputConnection(sampled->GetOutputPort());
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.5, ImageError, "at the start");
  filter->UpdateTimeStep(1.0);
  CheckBall(filter, 0.5, ImageError, "at the end");

  // Rounding to integers is 0.5 of 1000, 0.01 h.
  vtkSmartPointer<vtkImageData> shorts = MakeBallImage(0.5);
  vtkDataArray* values = shorts->GetPointData()->GetScalars();
  vtkNew<vtkShortArray> rounded;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    rounded->InsertNextValue(static_cast<short>(std::lround(1000.0 * values->GetTuple1(i))));
  }
  shorts->GetPointData()->SetScalars(rounded);
  filter->SetInputData(shorts);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.5, ImageError + 0.01 * VoxelSize, "of short integers");
}

// The image is turned so that its x axis goes along -y.
TEST(TestTargets, ImageIsWhereItsDirectionSays)
{
  vtkSmartPointer<vtkImageData> image = MakeBallImage(0.5, 0.25);
  auto plain = MakeSkinOver(image);
  plain->UpdateTimeStep(0.0);
  EXPECT_NEAR(GetSkinBounds(plain)[1], 0.75, ImageError) << "x max as it is";
  const double direction[9] = { 0, 1, 0, -1, 0, 0, 0, 0, 1 };
  image->SetDirectionMatrix(direction);
  image->SetOrigin(0.1, 0.0, 0.0);
  auto turned = MakeSkinOver(image);
  turned->UpdateTimeStep(0.0);
  const auto bounds = GetSkinBounds(turned);
  EXPECT_NEAR(bounds[2], -0.75, ImageError) << "y min when turned";
  EXPECT_NEAR(bounds[1], 0.6, ImageError) << "x max when turned";
}

TEST(TestTargets, InvertedImageHasItsInsideAbove)
{
  vtkSmartPointer<vtkImageData> below = MakeBallImage(0.5);
  auto above = vtkSmartPointer<vtkImageData>::New();
  above->DeepCopy(below);
  vtkDataArray* values = above->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetTuple1(i, -values->GetTuple1(i));
  }
  auto plain = MakeSkinOver(below);
  auto inverted = MakeSkinOver(above);
  inverted->InvertTargetOn();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 0.5), GetBytesAt(inverted, 0.5))) << "the same bytes";
  plain->SetTargetIsoValue(0.11);
  plain->UpdateTimeStep(0.0);
  CheckBall(plain, 0.6, ImageError, "level .11");
  inverted->SetTargetIsoValue(-0.11);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 0.5), GetBytesAt(inverted, 0.5)))
    << "the same bytes at a level";
  // An inside that extends to the box of the image ends there.
  plain->SetTargetIsoValue(0.0);
  plain->InvertTargetOn();
  UnsetBounds(plain);
  plain->UpdateTimeStep(0.0);
  EXPECT_NEAR(GetSkinBounds(plain)[1], 1.0, VoxelSize) << "x max of the outside";
}

TEST(TestTargets, ImagesArrayCanBeChosen)
{
  vtkSmartPointer<vtkImageData> image = MakeBallImage(0.5);
  vtkNew<vtkDoubleArray> other;
  other->DeepCopy(MakeBallImage(0.7)->GetPointData()->GetScalars());
  other->SetName("other");
  image->GetPointData()->AddArray(other);
  auto filter = MakeSkinOver(image);
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.5, ImageError, "of the active scalars");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "other");
  filter->UpdateTimeStep(0.0);
  CheckBall(filter, 0.7, ImageError, "of the other array");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "none");
  Refuses(filter, "no point array as chosen by SetInputArrayToProcess(3");
}

TEST(TestTargets, OpenMeshIsAWarningOrAShell)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetThetaResolution(64);
  bowl->SetPhiResolution(32);
  bowl->SetEndPhi(90.0);
  auto filter = MakeSkin();
  filter->SetInputConnection(bowl->GetOutputPort());
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.2);
  filter->UpdateTimeStep(0.0);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "MeshThickness > 0 for a shell"), 1)
    << "warnings";
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "are a seam, merge its points"), 1)
    << "warnings that name the remedy";
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "open edges"), 1)
    << "warnings that name the edges";
  messages.Warnings.clear();
  filter->SetMeshThickness(0.2);
  filter->UpdateTimeStep(0.0);
  const Radii radii = GetRadii(filter);
  EXPECT_NEAR(radii.Largest, 0.6, MeshError) << "outer radius of the shell";
  // The shell is round at the rim: no point is nearer to the centre than the inner wall.
  EXPECT_NEAR(radii.Least, 0.4, MeshError) << "inner radius of the shell";
  EXPECT_GT(GetSkinBounds(filter)[4], -0.15) << "z min of the shell";
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "open edges"), 1) << "warnings";
}

// The margin is a quarter of the size of a mesh, and two voxels on each side of an image.
TEST(TestTargets, BoundsComeFromTheTarget)
{
  const auto spacing = [](vtkDataSet* data)
  {
    auto filter = MakeSkinOver(data);
    UnsetBounds(filter);
    filter->SetVoxelSize(-1.0);
    filter->OutputPotentialOn();
    filter->Update();
    return filter->GetPotential()->GetSpacing()[0];
  };
  EXPECT_NEAR(spacing(MakeBallMesh(0.5, 7.0)), 1.25 / 64.0, 1e-9) << "voxel size of a mesh";
  EXPECT_NEAR(spacing(MakeBallImage(0.5)), 2.0 / 60.0, 1e-9) << "voxel size of an image";
}

}
