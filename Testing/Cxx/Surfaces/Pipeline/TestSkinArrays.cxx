// Optional point arrays of the skin, and the substeps of a moving target.

#include "Support/PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace activesurface;

namespace TestSkinArrays
{

vtkDataArray* GetArray(vtkActiveImplicitSurface* filter, const char* name)
{
  return filter->GetOutput()->GetPointData()->GetArray(name);
}

std::string GetArrayBytes(vtkActiveImplicitSurface* filter, const char* name)
{
  vtkDataArray* array = GetArray(filter, name);
  return std::string(static_cast<const char*>(array->GetVoidPointer(0)),
    static_cast<std::size_t>(4 * array->GetNumberOfValues()));
}

// Thirty time constants after its start the skin moves as fast as its particle, 0.2 along x. A
// vertex has the normal speed 0.2 n_x, within 5 % in the mean.
TEST(TestSkinArrays, VelocityIsThatOfTheParticle)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetVoxelSize(0.02);
  filter->ComputeVelocityOn();
  filter->UpdateTimeStep(3.0);
  vtkDataArray* velocity = GetArray(filter, "Velocity");
  vtkDataArray* normals = GetArray(filter, "Normals");
  EXPECT_TRUE(velocity && velocity->GetNumberOfComponents() == 3) << "there are vectors";
  double error = 0.0, size = 0.0;
  for (vtkIdType v = 0; v < velocity->GetNumberOfTuples(); ++v)
  {
    double speed = 0.0;
    for (int d = 0; d < 3; ++d)
    {
      speed += velocity->GetComponent(v, d) * normals->GetComponent(v, d);
    }
    error += std::fabs(speed - 0.2 * normals->GetComponent(v, 0));
    size += std::fabs(0.2 * normals->GetComponent(v, 0));
  }
  EXPECT_GT(size, 0.0) << "sum of the exact speeds";
  EXPECT_LT(error / size, 0.05) << "mean error over the mean speed";
}

// If a checkpoint is at the requested time, the filter has to request the input again for the
// motion of the target.
TEST(TestSkinArrays, VelocityDoesNotDependOnTheWay)
{
  for (const double time : { 1.0, 2.5, 0.0 })
  {
    auto direct = MakeSkinOver(MakeMovingBall());
    direct->ComputeVelocityOn();
    direct->UpdateTimeStep(time);
    auto filter = MakeSkinOver(MakeMovingBall());
    filter->SetCheckpointInterval(1);
    filter->UpdateTimeStep(4.0);
    filter->ComputeVelocityOn();
    filter->UpdateTimeStep(time);
    EXPECT_TRUE(AreSameSkins(GetArrayBytes(filter, "Velocity"), GetArrayBytes(direct, "Velocity")))
      << "the same velocity at " << time;
  }
}

TEST(TestSkinArrays, ArraysAreThereOnRequestAndDoNotRestart)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.5);
  EXPECT_TRUE(!GetArray(filter, "Velocity") && !GetArray(filter, "MeanCurvature"))
    << "none at first";
  filter->ResetCounters();
  filter->ComputeVelocityOn();
  filter->ComputeCurvatureOn();
  filter->ComputeNormalsOff();
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(filter->GetSubsteps(), vtkIdType(0)) << "substeps";
  EXPECT_FALSE(GetArray(filter, "Normals")) << "no normals";
  const vtkIdType points = filter->GetOutput()->GetNumberOfPoints();
  EXPECT_EQ(GetArray(filter, "Velocity")->GetNumberOfTuples(), points) << "velocities";
  EXPECT_EQ(GetArray(filter, "MeanCurvature")->GetNumberOfTuples(), points) << "curvatures";
}

// At an Attraction of 0.01 the stable step is a hundred intervals long.
TEST(TestSkinArrays, MovingTargetIsLookedAtFourTimesFromStepToStep)
{
  auto filter = MakeSkinOver(MakeMovingBall());
  filter->SetAttraction(0.01);
  filter->UpdateTimeStep(1.0);
  EXPECT_GT(double(filter->GetSubsteps()), 3.0) << "substeps in one interval";
}
}
