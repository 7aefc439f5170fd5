// Properties of the motion strategy reach the numerics, and restart the motion.

#include "Support/HistoryTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeFunction.h"

#include "vtkPolyData.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestMotionProperties
{

namespace
{

constexpr double Pi = 3.14159265358979323846;
using Filter = vtkActiveImplicitSurface*;

// A shape that moves only by tension, in the box +-1 with n nodes along each side.
vtkSmartPointer<vtkActiveImplicitSurface> MakeTense(const Shape& start, int n)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInitialFunction(MakeFunction(start));
  filter->SetTargetFunction(MakeFunction(MakeConstant(0.0)));
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->SetVoxelSize(VoxelSizeOf(n));
  filter->SetAttraction(0.0);
  filter->SetTension(1.0);
  filter->SetTimeStepSize(0.008);
  return filter;
}

const Shape Ellipsoid = MakeEllipsoid({ 0.7, 0.4, 0.3 });

void IsHeld(Filter filter, const char* column, double expected, double tolerance = 1e-5)
{
  filter->UpdateTimeStep(1e9);
  EXPECT_GT(CountRows(filter), 2) << "rows";
  for (int row = 1; row < CountRows(filter); ++row)
  {
    EXPECT_NEAR(GetNumber(filter, row, column) / expected, 1.0, tolerance)
      << std::string(column) << " over what is held, row " << row;
  }
}

// Final relative deficit of a ball under a penalty.
double GetMissingShare(Filter filter, const char* column)
{
  filter->UpdateTimeStep(1e9);
  return 1.0 - GetNumber(filter, CountRows(filter) - 1, column) / GetNumber(filter, 0, column);
}

// The smaller root of e (1 - e)^power = right, by Newton's method from 0.
double GetOffset(double power, double right)
{
  double e = 0.0;
  for (int i = 0; i < 50; ++i)
  {
    const double value = e * std::pow(1.0 - e, power) - right;
    const double slope = std::pow(1.0 - e, power) - power * e * std::pow(1.0 - e, power - 1.0);
    e -= value / slope;
  }
  return e;
}

}

// The tolerance of 1e-5 is that of a motion with splits in TestControls.
TEST(TestMotionProperties, ExactVolumeIsHeldInTheHistory)
{
  const Shape peanut = MakeDumbbell({ CentreA, { 1.0, 0.0, 0.0 }, 0.5, 0.3, 0.1 });
  auto tearing = MakeTense(peanut, 40);
  tearing->SetVolumeControlToExact();
  tearing->UpdateTimeStep(0.0);
  IsHeld(tearing, "Volume", GetNumber(tearing, 0, "Volume"));
  EXPECT_EQ(DescribeTopology(tearing, CountRows(tearing) - 1), "2 0 4") << "two drops at last";

  auto following = MakeSkinOver(MakeMovingBall());
  following->SetVolumeControlToExact();
  following->SetTension(0.01);
  following->UpdateTimeStep(0.0);
  IsHeld(following, "Volume", GetNumber(following, 0, "Volume"));
}

TEST(TestMotionProperties, ExactAreaIsHeldInTheHistory)
{
  auto filter = MakeTense(Ellipsoid, 40);
  filter->SetAreaControlToExact();
  filter->UpdateTimeStep(0.0);
  IsHeld(filter, "Area", GetNumber(filter, 0, "Area"));
}

TEST(TestMotionProperties, TargetVolumeAndAreaAreHeld)
{
  auto volume = MakeTense(Ellipsoid, 40);
  volume->SetVolumeControlToExact();
  volume->SetTargetVolume(0.5);
  IsHeld(volume, "Volume", 0.5);
  auto area = MakeTense(Ellipsoid, 40);
  area->SetAreaControlToExact();
  area->SetTargetArea(3.0);
  IsHeld(area, "Area", 3.0);
}

// The missing share e of the volume solves e (1 - e)^(1/3) = c, and that of the area e (1 -
// e)^(1/2) = c. Here c = 2 b / (g r0), with the tension b, the stiffness g and the radius r0 at the
// start. The tolerance of 1 % is that of TestControls.
TEST(TestMotionProperties, PenaltiesLeaveTheirOffsets)
{
  constexpr double stiffness = 100.0;
  auto volume = MakeTense(MakeBall(CentreA, 0.5), 32);
  volume->SetVolumeControlToPenalty();
  volume->SetVolumeStiffness(stiffness);
  const double volumeMissing = GetMissingShare(volume, "Volume");
  const double ofVolume = std::cbrt(3.0 * GetNumber(volume, 0, "Volume") / (4.0 * Pi));
  EXPECT_NEAR(volumeMissing / GetOffset(1.0 / 3.0, 2.0 / (stiffness * ofVolume)), 1.0, 0.01)
    << "missing volume over the exact one";

  auto area = MakeTense(MakeBall(CentreA, 0.5), 32);
  area->SetAreaControlToPenalty();
  area->SetAreaStiffness(stiffness);
  const double areaMissing = GetMissingShare(area, "Area");
  const double ofArea = std::sqrt(GetNumber(area, 0, "Area") / (4.0 * Pi));
  EXPECT_NEAR(areaMissing / GetOffset(0.5, 2.0 / (stiffness * ofArea)), 1.0, 0.01)
    << "missing area over the exact one";
}

TEST(TestMotionProperties, BothExactIsAnError)
{
  auto direct = MakeTense(Ellipsoid, 40);
  direct->SetVolumeControlToExact();
  const std::string bytes = GetBytesAt(direct, 0.016);
  auto filter = MakeTense(Ellipsoid, 40);
  filter->SetVolumeControlToExact();
  filter->SetAreaControlToExact();
  MessageCapture messages(filter);
  filter->UpdateTimeStep(0.016);
  EXPECT_EQ(
    MessageCapture::Count(messages.Errors, "AreaControl and VolumeControl cannot both be"), 1)
    << "errors that say why";
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "vtkActiveImplicitSurface ("), 1)
    << "own errors";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  EXPECT_EQ(CountRows(filter), 0) << "rows";
  filter->SetAreaControlToNone();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.016), bytes)) << "bytes after the correction";
}

// The walls at x = 0.93 and y = -0.69 lie between nodes, and the skin reaches only these two.
// Tolerance 1e-6, single precision.
TEST(TestMotionProperties, BoundedSkinStaysWithin)
{
  auto filter = MakeTense(MakeBall({ 0.1, 0.0, 0.0 }, 0.5), 40);
  filter->SetTargetFunction(MakeFunction(MakeBall({ 0.5, 0.01, -0.02 }, 0.7)));
  filter->SetModelBounds(-0.93, 0.93, -0.69, 0.93, -0.93, 0.93);
  filter->BoundedDomainOn();
  filter->SetAttraction(1.0);
  filter->SetTension(0.0);
  filter->SetTimeStepSize(1.0);
  double farthest = 0.0, lowest = 0.0;
  for (int step = 0; step <= 10; ++step)
  {
    filter->UpdateTimeStep(step);
    const std::string name = " at " + std::to_string(step);
    const auto bounds = GetSkinBounds(filter);
    EXPECT_LT(bounds[1], 0.93 + 1e-6) << "farthest point" << name;
    EXPECT_LT(-0.69 - 1e-6, bounds[2]) << "lowest point" << name;
    EXPECT_EQ(CountDefects(GetMesh(filter->GetOutput())), 0u) << "defects" << name;
    EXPECT_EQ(DescribeTopology(filter, step), "1 0 2") << "bodies, voids, Euler number" << name;
    farthest = bounds[1];
    lowest = bounds[2];
  }
  EXPECT_NEAR(farthest, 0.93, 0.01 * VoxelSizeOf(40)) << "it lies on the wall";
  EXPECT_NEAR(lowest, -0.69, 0.01 * VoxelSizeOf(40)) << "on both";
  filter->BoundedDomainOff();
  filter->UpdateTimeStep(10.0);
  EXPECT_NEAR(GetSkinBounds(filter)[1], 1.2, 0.1 * VoxelSizeOf(40))
    << "without walls it goes through";
}

// The initial shape extends through the wall at x = 0.93.
TEST(TestMotionProperties, BoundedSkinStartsClosed)
{
  auto filter = MakeTense(MakeBall({ 0.5, 0.01, -0.02 }, 0.7), 40);
  filter->SetModelBounds(-0.93, 0.93, -0.93, 0.93, -0.93, 0.93);
  filter->BoundedDomainOn();
  filter->Update();
  EXPECT_LT(GetSkinBounds(filter)[1], 0.93 + 1e-6) << "farthest point";
  EXPECT_LT(0.93 - 1e-6, GetSkinBounds(filter)[1]) << "it lies on the wall";
  EXPECT_EQ(CountDefects(GetMesh(filter->GetOutput())), 0u) << "defects";
  EXPECT_EQ(DescribeTopology(filter, 0), "1 0 2") << "bodies, voids, Euler number";
}

namespace
{

std::set<std::string> Print(Filter filter)
{
  std::ostringstream text;
  filter->Print(text);
  std::set<std::string> lines;
  std::istringstream input(text.str());
  for (std::string line; std::getline(input, line);)
  {
    lines.insert(line);
  }
  return lines;
}

}

TEST(TestMotionProperties, PaperFaithfulSetsSixProperties)
{
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetTargetEvaluationToNode();
  const std::set<std::string> before = Print(filter);
  filter->PaperFaithful();
  std::string changed;
  for (const std::string& line : Print(filter))
  {
    if (before.count(line) == 0 && line.find("Modified Time") == std::string::npos)
    {
      changed += line;
    }
  }
  EXPECT_EQ(changed,
    "  GradientScheme: 0  NormalizeTarget: 0  PaperScheme: 1  ParticleModel: 0  "
    "TargetEvaluation: 0  TimeIntegration: 0")
    << "changed lines";
}

// The rate of r^2 - R^2 is 2 R = 1.2, so after 20 time constants the skin has arrived. The plain
// mean of F over a node's crossings changes the radius by at most h^2 / 2R = 0.04 h.
TEST(TestMotionProperties, PaperSchemeArrivesAtABall)
{
  auto filter = MakeTense(MakeBall(CentreA, 0.4), 40);
  filter->SetAttraction(1.0);
  filter->SetTension(0.0);
  vtkNew<vtkSphere> goal;
  goal->SetRadius(0.6);
  filter->SetTargetFunction(goal);
  filter->PaperFaithful();
  filter->SetTimeStepSize(1.7);
  filter->UpdateTimeStep(17.0);
  const Mesh mesh = GetMesh(filter->GetOutput());
  const Range radii = GetRadii(mesh, { 0.0, 0.0, 0.0 });
  EXPECT_EQ(DescribeTopology(mesh), "1 0 2") << "bodies, voids, Euler number";
  EXPECT_NEAR((radii.Mean - 0.6) / VoxelSizeOf(40), 0.0, 0.04) << "error of the radius [h]";
}

// Same bounds and balls as for the band itself in TestEvaluation.
TEST(TestMotionProperties, EvaluationAtNodesRoughensTheNormals)
{
  const Shape end = MakeBall({ 0.21, 0.13, 0.07 }, 0.6);
  for (const int evaluation : { vtkActiveImplicitSurface::SHIFTED, vtkActiveImplicitSurface::NODE,
         vtkActiveImplicitSurface::CLOSEST_POINT })
  {
    auto filter = MakeTense(MakeBall({ 0.0, 0.0, 0.0 }, 0.4), 40);
    filter->SetTargetFunction(MakeFunction(end));
    filter->SetAttraction(1.0);
    filter->SetTension(0.0);
    filter->SetTargetEvaluation(evaluation);
    filter->SetTimeStepSize(2.0);
    filter->UpdateTimeStep(20.0);
    const double angle = GetDeviation(GetMesh(filter->GetOutput()), end, VoxelSizeOf(40)).MeanAngle;
    const bool isRough = evaluation == vtkActiveImplicitSurface::NODE;
    EXPECT_LT(isRough ? 10.0 : angle, isRough ? angle : 2.0)
      << "mean angle of the normals [degrees], evaluation " << evaluation;
  }
}

namespace
{

// Substeps of the update after a change, over those of the update before the change.
double GetSteps(const std::function<void(Filter)>& change)
{
  auto filter = MakeShrinkingBall();
  filter->SetTension(0.05);
  filter->UpdateTimeStep(0.3);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.4);
  const auto oneStep = filter->GetSubsteps();
  change(filter);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.5);
  return double(filter->GetSubsteps()) / double(oneStep);
}

}

TEST(TestMotionProperties, StrategyStartsTheMotionAnew)
{
  const std::vector<std::pair<std::string, std::function<void(Filter)>>> changes = {
    { "VolumeControl", [](Filter f) { f->SetVolumeControlToPenalty(); } },
    { "AreaControl", [](Filter f) { f->SetAreaControlToExact(); } },
    { "VolumeStiffness", [](Filter f) { f->SetVolumeStiffness(2.0); } },
    { "AreaStiffness", [](Filter f) { f->SetAreaStiffness(2.0); } },
    { "TargetVolume", [](Filter f) { f->SetTargetVolume(0.5); } },
    { "TargetArea", [](Filter f) { f->SetTargetArea(3.0); } },
    { "RestTolerance", [](Filter f) { f->SetRestTolerance(0.01); } },
    { "MaximumNumberOfSubsteps", [](Filter f) { f->SetMaximumNumberOfSubsteps(100); } },
    { "TargetEvaluation", [](Filter f) { f->SetTargetEvaluationToNode(); } },
    { "GradientScheme", [](Filter f) { f->SetGradientSchemeToCentral(); } },
    { "PaperScheme", [](Filter f) { f->PaperSchemeOn(); } },
    { "BoundedDomain", [](Filter f) { f->BoundedDomainOn(); } },
  };
  for (const auto& [name, change] : changes)
  {
    EXPECT_GT(GetSteps(change), 2.0) << "steps after a change of " << name;
  }
  // A single step has a ratio of at most 1.2: substeps become more as the ball shrinks.
  EXPECT_LT(GetSteps([](Filter) {}), 1.2) << "steps without a change";
  EXPECT_LT(GetSteps([](Filter f) { f->SetNumberOfThreads(1); }), 1.2) << "NumberOfThreads";
  EXPECT_LT(GetSteps([](Filter f) { f->SetMaximumNumberOfActiveVoxels(1000000); }), 1.2)
    << "MaximumNumberOfActiveVoxels";
  EXPECT_LT(GetSteps([](Filter f) { f->ComputeNormalsOff(); }), 1.2) << "ComputeNormals";
}

}
