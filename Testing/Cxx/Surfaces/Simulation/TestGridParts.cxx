// Parts of meshes and images that the skin does not meet get a skin, and hollows open. CreateParts
// does not change the parts that the skin meets.

#include "Support/HistoryTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestGridParts
{

namespace
{

constexpr double VoxelSize = 0.05; // voxel size of MakeSkin

// Derivation: see TestTargets.cxx.
constexpr double GridError = 0.06 * VoxelSize;

vtkSmartPointer<vtkPolyData> Append(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes)
{
  vtkNew<vtkAppendPolyData> both;
  for (const auto& mesh : meshes)
  {
    both->AddInputData(mesh);
  }
  both->Update();
  return both->GetOutput();
}

/** Image in the box +-1, in pixels of 0.05. */
vtkSmartPointer<vtkImageData> MakeImage(
  const std::function<double(double x, double y, double z)>& function)
{
  vtkSmartPointer<vtkImageData> image = MakeBallImage(0.5);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    values->SetComponent(i, 0, function(x[0], x[1], x[2]));
  }
  return image;
}

double TorusAt(double x, double y, double z)
{
  return std::hypot(std::hypot(x, y) - 0.5, z) - 0.2;
}

double ShellAt(double x, double y, double z)
{
  const double r = std::hypot(x, y, z);
  return std::max(r - 0.7, 0.35 - r);
}

using MakeBallOf = std::function<vtkSmartPointer<vtkDataSet>(double radius, double x)>;
const std::vector<MakeBallOf> Kinds = {
  [](double radius, double x) { return MakeBallMesh(radius, x); },
  [](double radius, double x) { return MakeBallImage(radius, x); },
};

}

TEST(TestGridParts, MorphBetweenShapesThatDoNotMeet)
{
  for (const MakeBallOf& make : Kinds)
  {
    const auto morph = [&make](double t) { return make(0.3, t == 0.0 ? -0.5 : 0.5); };
    auto filter = MakeSkinOver(MakeSource(morph, { 0, 1, 2 }));
    MessageCapture messages(filter);
    filter->UpdateTimeStep(2.0);
    EXPECT_EQ(DescribeTopology(filter, 0), "1 0 2");
    EXPECT_EQ(DescribeTopology(filter, 2), "1 0 2");
    EXPECT_NEAR(GetRadii(filter, 0.5).Least, 0.3, GridError);
    EXPECT_NEAR(GetRadii(filter, 0.5).Largest, 0.3, GridError);
    // The only warning is about the lag of the skin.
    EXPECT_EQ(messages.CountAll(), 1u);
    EXPECT_TRUE(messages.Has("outside the skin"));
    filter->CreatePartsOff();
    filter->UpdateTimeStep(2.0);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "without CreateParts";
  }
}

TEST(TestGridParts, InitialFunctionGoesToAMeshElsewhere)
{
  auto filter = MakeSkinOver(Append({ MakeBallMesh(0.3, 0.5), MakeBallMesh(0.15, -0.2) }));
  filter->SetInitialFunction(MakeBallFunction(0.2, -0.7));
  filter->SetNumberOfTimeSteps(3);
  filter->SetTimeStepSize(1.0);
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(DescribeTopology(filter, 2), "2 0 4");
  EXPECT_NEAR(GetSkinBounds(filter)[1], 0.8, GridError);
  EXPECT_NEAR(GetSkinBounds(filter)[0], -0.35, GridError);
}

TEST(TestGridParts, FunctionOfAMeshTellsItsParts)
{
  vtkNew<vtkGridPotential> function;
  function->SetInput(MakeBallMesh(0.3, 0.5));
  function->SetVoxelSize(VoxelSize);
  auto filter = MakeSkin();
  filter->SetTargetFunction(function);
  filter->SetInitialFunction(MakeBallFunction(0.2, -0.7));
  filter->SetEvolutionModeToEquilibrium();
  filter->Update();
  EXPECT_NEAR(GetRadii(filter, 0.5).Largest, 0.3, GridError);
}

TEST(TestGridParts, BubbleOpensDeepInside)
{
  const auto morph = [](double t) { return t == 0.0 ? MakeBallImage(0.7) : MakeImage(ShellAt); };
  auto filter = MakeSkinOver(MakeSource(morph, { 0, 1, 2 }));
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(DescribeTopology(filter, 0), "1 0 2");
  EXPECT_EQ(DescribeTopology(filter, 2), "1 1 4");
  EXPECT_NEAR(GetRadii(filter).Least, 0.35, GridError);
  EXPECT_NEAR(GetRadii(filter).Largest, 0.7, GridError);
}

// The inverted ball is a hollow in an unbounded body.
TEST(TestGridParts, InvertedPartIsAHollow)
{
  auto filter = MakeSkinOver(MakeBallMesh(0.3));
  filter->InvertTargetOn();
  filter->SetInitialFunction(MakeBallFunction(0.8));
  filter->BoundedDomainOn();
  filter->SetNumberOfTimeSteps(2);
  filter->SetTimeStepSize(1.0);
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(GetNumber(filter, 1, "Voids"), 1.0);
  EXPECT_NEAR(GetRadii(filter).Least, 0.3, GridError);
}

TEST(TestGridParts, PartOfASeriesAppearsOnTheWayToItsStep)
{
  for (const MakeBallOf& make : Kinds)
  {
    const bool isMesh = vtkPolyData::SafeDownCast(make(0.3, 0.0)) != nullptr;
    const auto series = [isMesh](double t) -> vtkSmartPointer<vtkDataSet>
    {
      if (isMesh)
      {
        return t < 2.0 ? MakeBallMesh(0.3, -0.5)
                       : Append({ MakeBallMesh(0.3, -0.5), MakeBallMesh(0.2, 0.5) });
      }
      return MakeImage(
        [t](double x, double y, double z)
        {
          const double left = std::hypot(x + 0.5, y, z) - 0.3;
          return t < 2.0 ? left : std::min(left, std::hypot(x - 0.5, y, z) - 0.2);
        });
    };
    auto filter = MakeSkinOver(MakeSource(series, { 0, 1, 2, 3 }));
    const std::string there = GetBytesAt(filter, 3.0);
    EXPECT_EQ(DescribeTopology(filter, 1), "1 0 2");
    EXPECT_EQ(DescribeTopology(filter, 2), "2 0 4");
    EXPECT_EQ(DescribeTopology(filter, 3), "2 0 4");
    EXPECT_NEAR(GetSkinBounds(filter)[1], 0.7, GridError);
    filter->UpdateTimeStep(0.0);
    filter->SetNumberOfThreads(1);
    filter->UpdateTimeStep(1.5);
    EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 3.0), there)) << "any way, any threads";
  }
}

// The balls at both steps share a lens of one voxel, so the skin meets the next shape. The first
// morph limits F to 0.1, so its blend has an isolated piece at 0.3 of the interval: F is 0.7 * 0.1
// - 0.3 * 0.3 < 0 at the centre of the second ball, and 0.7 * 0.1 - 0.3 * 0.15 > 0 between this
// centre and the lens.
TEST(TestGridParts, ShapesThatMeetChangeByNoBit)
{
  using Morph = std::function<vtkSmartPointer<vtkDataSet>(double t)>;
  const std::vector<Morph> morphs = {
    [](double t)
    {
      const double centre = t == 0.0 ? -0.275 : 0.275;
      return MakeImage([centre](double x, double y, double z)
        { return std::min(std::hypot(x - centre, y, z) - 0.3, 0.1); });
    },
    [](double t) { return MakeBallMesh(0.3, t == 0.0 ? -0.275 : 0.275); },
    [](double t) { return MakeBallImage(0.3, t == 0.0 ? -0.275 : 0.275); },
    [](double t) { return t == 0.0 ? MakeBallImage(0.35) : MakeImage(TorusAt); },
    [](double t) { return t == 0.0 ? MakeImage(TorusAt) : MakeBallImage(0.35); },
    [](double t) { return t == 0.0 ? MakeImage(ShellAt) : MakeBallImage(0.5); },
  };
  for (std::size_t i = 0; i < morphs.size(); ++i)
  {
    auto filter = MakeSkinOver(MakeSource(morphs[i], { 0, 1, 2 }));
    filter->UpdateTimeStep(1.0);
    const std::string with = GetBytes(filter);
    const std::string later = GetBytesAt(filter, 2.0);
    filter->CreatePartsOff();
    EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), with)) << i;
    EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 2.0), later)) << i;
  }
}

// Tension removes balls below 2.83 sqrt(Tension / Attraction), here 0.28. They must not be created
// again and again.
TEST(TestGridParts, WhatTensionTakesIsNotCreated)
{
  for (const double radius : { 0.2, 0.4 })
  {
    auto filter = MakeSkinOver(Append({ MakeBallMesh(0.4, -0.5), MakeBallMesh(radius, 0.5) }));
    filter->SetInitialFunction(MakeBallFunction(0.4, -0.5));
    filter->SetTension(0.1);
    filter->SetNumberOfTimeSteps(3);
    filter->SetTimeStepSize(0.05);
    const std::string with = GetBytesAt(filter, 0.1);
    EXPECT_EQ(DescribeTopology(filter, 2), radius > 0.3 ? "2 0 4" : "1 0 2");
    filter->CreatePartsOff();
    EXPECT_EQ(GetBytesAt(filter, 0.1) == with, radius < 0.3);
  }
}

TEST(TestGridParts, PaperCreatesNone)
{
  auto filter = MakeSkinOver(Append({ MakeBallMesh(0.3, 0.5), MakeBallMesh(0.3, -0.5) }));
  filter->SetInitialFunction(MakeBallFunction(0.3, -0.5));
  filter->PaperFaithful();
  filter->SetNumberOfTimeSteps(2);
  filter->SetTimeStepSize(0.1);
  filter->UpdateTimeStep(0.1);
  EXPECT_EQ(GetNumber(filter, 1, "Components"), 1.0);
}

// The stray triangle extends the automatic bounds to a million voxels, where a start from all nodes
// would be refused. The triangle also makes the mesh open. Distances to open meshes are computed in
// another way, and agree to a thousandth of a voxel.
TEST(TestGridParts, StrayTriangleCostsItself)
{
  vtkNew<vtkPoints> points;
  const double far = 1e6 * VoxelSize;
  points->InsertNextPoint(far, far, far);
  points->InsertNextPoint(far + 0.1, far, far);
  points->InsertNextPoint(far, far + 0.1, far);
  vtkNew<vtkCellArray> triangle;
  triangle->InsertNextCell({ 0, 1, 2 });
  vtkNew<vtkPolyData> stray;
  stray->SetPoints(points);
  stray->SetPolys(triangle);
  const auto volumeOver = [](vtkPolyData* mesh)
  {
    auto filter = MakeSkinOver(mesh);
    filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0); // bounds of the mesh
    filter->SetTargetReach(0.3);
    MessageCapture messages(filter);
    filter->UpdateTimeStep(1.0);
    EXPECT_EQ(messages.Errors.size(), 0u);
    return GetNumber(filter, 1, "Volume");
  };
  const double alone = volumeOver(MakeBallMesh(0.5));
  const double area = 3.1416; // area of the ball
  EXPECT_NEAR(volumeOver(Append({ MakeBallMesh(0.5), stray })), alone, 0.001 * VoxelSize * area);
}

}
