// The image of the potential, output port 1: its extent, its values and its time.

#include "Support/PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace activesurface;

namespace TestPotentialImage
{

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace
{

constexpr double VoxelSize = 0.0625;

std::string Text(const int extent[6])
{
  std::string text;
  for (int i = 0; i < 6; ++i)
  {
    text += std::to_string(extent[i]) + " ";
  }
  return text;
}

std::string GetWholeExtent(vtkActiveImplicitSurface* filter)
{
  return Text(filter->GetOutputInformation(1)->Get(SDDP::WHOLE_EXTENT()));
}

double GetTime(vtkDataObject* data)
{
  return data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
}

}

// The potential starts as vtkSphere's first-order distance (r^2 - R^2) / 2r, divided by its slope.
// The error at the distance d is d^2 / 2R: 0.052 h at d = h, and 0.058 h with the next order.
TEST(TestPotentialImage, ValuesAreDistancesFromTheSkin)
{
  auto filter = MakeShrinkingBall();
  filter->OutputPotentialOn();
  filter->Update();
  vtkImageData* image = filter->GetPotential();
  EXPECT_EQ(std::string(image->GetPointData()->GetScalars()->GetName()), "Potential") << "name";
  double largest = 0.0;
  int near = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const double value = image->GetPointData()->GetScalars()->GetTuple1(i);
    const double exact = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 0.6;
    EXPECT_TRUE(std::fabs(exact) < 0.01 * VoxelSize || (value < 0.0) == (exact < 0.0)) << "sign";
    if (std::fabs(exact) < VoxelSize)
    {
      ++near;
      largest = std::max(largest, std::fabs(value - exact));
    }
  }
  EXPECT_GT(near, 1000) << "nodes within a voxel";
  EXPECT_LT(largest, 0.065 * VoxelSize) << "largest error there";
  EXPECT_NEAR(image->GetScalarRange()[0], -3.0 * VoxelSize, 1e-6) << "least value";
  EXPECT_NEAR(image->GetScalarRange()[1], 3.0 * VoxelSize, 1e-6) << "largest value";
}

TEST(TestPotentialImage, ExtentCoversTheBoundsInLatticeNodes)
{
  auto filter = MakeShrinkingBall();
  filter->SetModelBounds(-0.7, 0.7, -1.0, 1.0, 0.01, 2.0);
  filter->UpdateInformation();
  EXPECT_EQ(GetWholeExtent(filter), "-12 12 -16 16 0 32 ") << "WHOLE_EXTENT";
  filter->OutputPotentialOn();
  filter->Update();
  vtkImageData* image = filter->GetPotential();
  EXPECT_EQ(Text(image->GetExtent()), "-12 12 -16 16 0 32 ") << "extent";
  EXPECT_EQ(image->GetSpacing()[0], VoxelSize) << "spacing";
  EXPECT_EQ(image->GetOrigin()[2], 0.0) << "origin";
  filter->SetVoxelSize(0.125);
  filter->Update();
  EXPECT_EQ(Text(filter->GetPotential()->GetExtent()), "-6 6 -8 8 0 16 ")
    << "extent, after a change";
}

TEST(TestPotentialImage, ImageIsMadeOnlyIfWanted)
{
  auto filter = MakeShrinkingBall();
  filter->Update();
  EXPECT_EQ(filter->GetPotential()->GetNumberOfPoints(), 0) << "nodes without a wish";
  const auto substeps = filter->GetSubsteps();
  filter->Update(1);
  EXPECT_EQ(filter->GetPotential()->GetNumberOfPoints(), 33 * 33 * 33) << "nodes by Update(1)";
  EXPECT_EQ(filter->GetSubsteps(), substeps) << "substeps";
  auto other = MakeShrinkingBall();
  other->OutputPotentialOn();
  other->UpdateTimeStep(0.3);
  EXPECT_EQ(other->GetPotential()->GetNumberOfPoints(), 33 * 33 * 33) << "nodes by OutputPotential";
  EXPECT_EQ(GetTime(other->GetPotential()), 0.1 * 3) << "DATA_TIME_STEP";
}

TEST(TestPotentialImage, EachPortHasItsOwnTime)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.4);
  filter->GetOutputInformation(1)->Set(SDDP::UPDATE_TIME_STEP(), 0.5);
  filter->Update(1);
  EXPECT_EQ(GetTime(filter->GetPotential()), 0.5) << "the image's time";
  EXPECT_EQ(GetTime(filter->GetOutput()), 0.4) << "the skin's time";
  const std::string bytes = GetBytes(filter);
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(GetTime(filter->GetOutput()), 0.5) << "the skin's time after an update";
  EXPECT_TRUE(bytes != GetBytes(filter)) << "the skin differs";
}

TEST(TestPotentialImage, PartOfTheExtentIsACrop)
{
  auto filter = MakeShrinkingBall();
  filter->Update(1);
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetPotential());
  auto part = MakeShrinkingBall();
  const int extent[6] = { -12, -3, 2, 9, 0, 4 };
  part->UpdateExtent(extent);
  part->UpdateInformation();
  part->GetOutputInformation(1)->Set(SDDP::UPDATE_EXTENT(), extent, 6);
  part->GetOutputInformation(1)->Set(SDDP::UPDATE_EXTENT_INITIALIZED(), 1);
  part->Update(1);
  vtkImageData* image = part->GetPotential();
  EXPECT_EQ(Text(image->GetExtent()), Text(extent)) << "extent";
  bool same = true;
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int x = extent[0]; x <= extent[1]; ++x)
    {
      same = same &&
        image->GetScalarComponentAsFloat(x, 5, z, 0) ==
          whole->GetScalarComponentAsFloat(x, 5, z, 0);
    }
  }
  EXPECT_TRUE(same) << "the values are those of the whole";
}

TEST(TestPotentialImage, ContoursOfTheImageAreTheSkin)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputConnection(filter->GetOutputPort(1));
  contour->SetValue(0, 0.0);
  contour->UpdateTimeStep(0.5);
  filter->UpdateTimeStep(0.5);
  double bounds[6];
  contour->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(bounds[1], GetSkinBounds(filter)[1], 0.02 * VoxelSize) << "largest x";
  EXPECT_NEAR(bounds[4], GetSkinBounds(filter)[4], 0.02 * VoxelSize) << "least z";
}

// The bounds of particles are unknown until the particles have been read. With a connected
// consumer, UpdateInformation reads the first step, without an additional execution.
TEST(TestPotentialImage, ExtentOverParticlesIsKnownToConsumers)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  vtkNew<vtkFlyingEdges3D> consumer;
  consumer->SetInputConnection(filter->GetOutputPort(1));
  consumer->SetValue(0, 0.0);
  consumer->UpdateInformation();
  // The support's box is 0.6 long, and 0.75 with a margin of a quarter: half of that, 0.375, is 7.5
  // voxels.
  EXPECT_EQ(GetWholeExtent(filter), "-8 8 -8 8 -8 8 ") << "WHOLE_EXTENT beforehand";
  consumer->UpdateTimeStep(1.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 ") << "times asked for";
  EXPECT_GT(consumer->GetOutput()->GetNumberOfPolys(), 0) << "triangles of the contour";
}

TEST(TestPotentialImage, ExtentOverParticlesIsKnownAfterTheFirstUpdate)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  filter->UpdateInformation();
  EXPECT_EQ(GetWholeExtent(filter), "0 -1 0 -1 0 -1 ") << "WHOLE_EXTENT before";
  EXPECT_EQ(source->GetExecutions(), "") << "times asked for";
  filter->Update();
  EXPECT_EQ(GetWholeExtent(filter), "-8 8 -8 8 -8 8 ") << "WHOLE_EXTENT after";
  filter->Update(1);
  EXPECT_EQ(Text(filter->GetPotential()->GetExtent()), "-8 8 -8 8 -8 8 ") << "extent";

  auto image = MakeSkinOver(MakeMovingBall());
  image->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
  image->Update(1);
  EXPECT_EQ(Text(image->GetPotential()->GetExtent()), "-8 8 -8 8 -8 8 ")
    << "extent, asked for first";
}

TEST(TestPotentialImage, VanishedSkinsAreOutsideEverywhere)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> away;
  away->SetCenter(5.0, 5.0, 5.0);
  filter->SetInitialFunction(away);
  filter->GlobalWarningDisplayOff();
  filter->Update(1);
  filter->GlobalWarningDisplayOn();
  EXPECT_NEAR(filter->GetPotential()->GetScalarRange()[0], 3.0 * VoxelSize, 1e-6) << "least value";
}

}
