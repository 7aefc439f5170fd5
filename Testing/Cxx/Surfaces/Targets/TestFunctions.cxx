// Implicit functions as targets: any function of VTK, of any scale, sign and gradient.

#include "Support/GridShapes.h"
#include "Support/PipelineTools.h"

#include "vtkImplicitBoolean.h"
#include "vtkImplicitFunction.h"
#include "vtkImplicitSum.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkQuadric.h"
#include "vtkSkeletonPotential.h"
#include "vtkSphere.h"
#include "vtkSuperquadric.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <set>
#include <string>
#include <thread>

using namespace activesurface;

namespace TestFunctions
{

namespace
{

constexpr double VoxelSize = 0.0625;

// Bytes of the skin after a motion from a ball of radius 0.6 towards the target.
std::string BytesTowards(vtkImplicitFunction* target)
{
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(target);
  return GetBytesAt(filter, 0.5);
}

std::array<double, 6> BoundsTowards(vtkImplicitFunction* target, double time)
{
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(target);
  filter->SetTimeStepSize(0.1 * time);
  filter->UpdateTimeStep(time);
  return GetSkinBounds(filter);
}

// A class that is not in the list of thread-safe functions.
class ShyBall : public vtkSphere
{
public:
  static ShyBall* New();
  vtkTypeMacro(ShyBall, vtkSphere);
  double EvaluateFunction(double x[3]) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Callers.insert(std::this_thread::get_id());
    return this->Superclass::EvaluateFunction(x);
  }
  std::mutex Mutex;
  std::set<std::thread::id> Callers;
};
vtkStandardNewMacro(ShyBall);

}

// VTK returns for a union the gradient of a difference, here that of the wrong ball. The speed
// would change by the ratio of the lengths of the two gradients.
TEST(TestFunctions, BooleansHaveTheGradientOfTheTermThatDecides)
{
  auto ball = MakeBallFunction(0.4, 0.0);
  const std::string alone = BytesTowards(ball);
  const auto combine = [ball](
                         int operation, vtkImplicitFunction* first, vtkImplicitFunction* second)
  {
    vtkNew<vtkImplicitBoolean> boolean;
    boolean->SetOperationType(operation);
    boolean->AddFunction(first);
    boolean->AddFunction(second);
    return BytesTowards(boolean);
  };
  auto far = MakeBallFunction(0.1, 5.0);
  auto around = MakeBallFunction(3.0, 0.1);
  using Boolean = vtkImplicitBoolean;
  EXPECT_TRUE(AreSameSkins(combine(Boolean::VTK_UNION, far, ball), alone))
    << "union with a far one";
  EXPECT_TRUE(AreSameSkins(combine(Boolean::VTK_UNION, ball, far), alone)) << "the other way round";
  EXPECT_TRUE(AreSameSkins(combine(Boolean::VTK_INTERSECTION, around, ball), alone))
    << "intersection";
  EXPECT_TRUE(AreSameSkins(combine(Boolean::VTK_INTERSECTION, ball, around), alone))
    << "the other way round";
  EXPECT_TRUE(AreSameSkins(combine(Boolean::VTK_DIFFERENCE, ball, far), alone)) << "difference";
  EXPECT_TRUE(AreSameSkins(combine(Boolean::VTK_UNION_OF_MAGNITUDES, around, ball), alone))
    << "magnitudes";
}

TEST(TestFunctions, BooleansMayBeNested)
{
  auto ball = MakeBallFunction(0.4, 0.0);
  vtkNew<vtkImplicitBoolean> inner;
  inner->SetOperationTypeToUnion();
  inner->AddFunction(MakeBallFunction(0.1, 5.0));
  inner->AddFunction(ball);
  vtkNew<vtkImplicitBoolean> outer;
  outer->SetOperationTypeToDifference();
  outer->AddFunction(inner);
  outer->AddFunction(MakeBallFunction(0.2, -5.0));
  EXPECT_TRUE(AreSameSkins(BytesTowards(outer), BytesTowards(ball)))
    << "the same bytes as only the ball";
}

// A superquadric of roundness 1 is a ball. VTK returns no gradient for it; central differences of a
// quadratic function are exact up to rounding.
TEST(TestFunctions, FunctionsWithoutGradientGetOne)
{
  vtkNew<vtkSuperquadric> round;
  round->SetSize(0.4);
  const auto bounds = BoundsTowards(round, 0.5);
  const auto expected = BoundsTowards(MakeBallFunction(0.4, 0.0), 0.5);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-5) << "bound " << i;
  }
}

TEST(TestFunctions, SumsAndTransformsWork)
{
  const auto expected = BoundsTowards(MakeBallFunction(0.4, 0.1), 0.5);
  vtkNew<vtkImplicitSum> sum;
  sum->AddFunction(MakeBallFunction(0.4, 0.1), 2.0);
  EXPECT_NEAR(BoundsTowards(sum, 0.5)[1], expected[1], 1e-5) << "vtkImplicitSum";
  auto moved = MakeBallFunction(0.4, 0.0);
  vtkNew<vtkTransform> transform;
  transform->Translate(-0.1, 0.0, 0.0);
  moved->SetTransform(transform);
  EXPECT_NEAR(BoundsTowards(moved, 0.5)[1], expected[1], 1e-5) << "a transform";
}

// Powers of two are exact in floating point.
TEST(TestFunctions, ScaleOfTheFunctionDoesNotMatter)
{
  const auto make = [](double scale)
  {
    vtkNew<vtkQuadric> quadric;
    quadric->SetCoefficients(
      scale, 2.0 * scale, scale, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.25 * scale);
    return BytesTowards(quadric);
  };
  EXPECT_TRUE(make(1.0) == make(1024.0)) << "1024 times as steep";
}

// -F above -iso is F below iso.
TEST(TestFunctions, InsideMayBeAboveTheIsoValue)
{
  vtkNew<vtkQuadric> below;
  below->SetCoefficients(1, 1, 1, 0, 0, 0, 0, 0, 0, -0.25);
  vtkNew<vtkQuadric> above;
  above->SetCoefficients(-1, -1, -1, 0, 0, 0, 0, 0, 0, 0.25);
  auto plain = MakeShrinkingBall();
  plain->SetTargetFunction(below);
  plain->SetTargetIsoValue(-0.125);
  auto inverted = MakeShrinkingBall();
  inverted->SetTargetFunction(above);
  inverted->SetTargetIsoValue(0.125);
  inverted->InvertTargetOn();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 0.5), GetBytesAt(inverted, 0.5))) << "the same bytes";
  plain->SetInitialFunction(nullptr);
  plain->UpdateTimeStep(0.0);
  // Chords are within h^2 / 8r.
  EXPECT_NEAR(GetSkinBounds(plain)[1], std::sqrt(0.125), 0.03 * VoxelSize)
    << "radius at the iso value";
}

// Beyond the reach the speed is Attraction * TargetReach. The tolerance of 0.13 h is less than that
// of a uniform speed in TestTracking.
TEST(TestFunctions, FarTargetsAttractWithConstantSpeed)
{
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(MakeBallFunction(0.1, 0.0));
  filter->SetTargetReach(0.05);
  filter->SetAttraction(2.0);
  filter->SetTimeStepSize(0.5);
  filter->UpdateTimeStep(2.0);
  EXPECT_NEAR(GetSkinBounds(filter)[1], 0.6 - 2.0 * 0.05 * 2.0, 0.13 * VoxelSize) << "radius";
}

// V = 0.4^2 - r^2, so r = 0.4 (1 + c e^(-0.8 t)) / (1 - c e^(-0.8 t)), c = 0.2. The error is first
// order in time: substeps of 0.1 give 0.92^5 instead of e^(-0.4), a radius smaller by 0.002 or 0.03
// h. Chords add 0.02 h.
TEST(TestFunctions, WithoutNormalizationTheValueItselfAttracts)
{
  auto filter = MakeShrinkingBall();
  filter->NormalizeTargetOff();
  filter->UpdateTimeStep(0.5);
  const double e = 0.2 * std::exp(-0.4);
  EXPECT_NEAR(GetSkinBounds(filter)[1], 0.4 * (1.0 + e) / (1.0 - e), 0.06 * VoxelSize) << "radius";
}

TEST(TestFunctions, SkeletonPotentialsNeedNoBounds)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(10.0, 0.0, 0.0);
  points->InsertNextPoint(10.3, 0.0, 0.0);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInput(data);
  potential->SetRadius(0.5);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetTargetFunction(potential);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 1000) << "triangles on the target";
  filter->SetTargetFunction(MakeBallFunction(0.3, 10.0));
  filter->SetInitialFunction(potential);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 1000) << "triangles on the initial shape";

  // The MTime of the function's input counts.
  filter->SetTargetFunction(potential);
  filter->SetInitialFunction(nullptr);
  filter->Update();
  const double before = GetSkinBounds(filter)[1];
  points->SetPoint(1, 10.4, 0.0, 0.0);
  points->Modified();
  data->Modified();
  filter->Update();
  EXPECT_NEAR(GetSkinBounds(filter)[1] - before, 0.1, 0.02) << "its points have moved";
}

TEST(TestFunctions, UnknownFunctionsAreEvaluatedByOneThread)
{
  vtkNew<ShyBall> shy;
  shy->SetRadius(0.4);
  EXPECT_TRUE(AreSameSkins(BytesTowards(shy), BytesTowards(MakeBallFunction(0.4, 0.0))))
    << "the same bytes";
  // There is enough work for several threads.
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(shy);
  filter->SetInitialFunction(shy);
  filter->SetVoxelSize(0.02);
  filter->SetTimeStepSize(0.01);
  filter->UpdateTimeStep(0.02);
  EXPECT_EQ(shy->Callers.size(), 1u) << "threads";
}

TEST(TestFunctions, FunctionsAreLetGo)
{
  auto ball = MakeBallFunction(0.4, 0.0);
  const int count = ball->GetReferenceCount();
  {
    vtkNew<vtkActiveImplicitSurface> filter;
    filter->SetTargetFunction(ball);
    filter->SetInitialFunction(ball);
    filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
    filter->Update();
    EXPECT_LT(count, ball->GetReferenceCount()) << "references while in use";
  }
  EXPECT_EQ(ball->GetReferenceCount(), count) << "references afterwards";
}

// Distances to a ball, sampled as finely as the skin. Trilinear interpolation is off by spacing^2 /
// 4r = 0.04 voxel, and the skin by at most another 0.04 (front.md of LevelSet, Accuracy).
TEST(TestFunctions, GridPotentialIsATargetOfTheSkin)
{
  Place place(false);
  const double h = 0.0625;
  place.Origin = { 0.0, 0.0, 0.0 };
  place.Spacing = { h, h, h };
  place.Extent = { -14, 14, -14, 14, -14, 14 };
  vtkNew<vtkGridPotential> potential;
  potential->SetInput(MakeImage(place, VTK_FLOAT,
    [h](double i, double j, double k) { return h * std::sqrt(i * i + j * j + k * k) - 0.4; }));
  const auto follow = [](vtkImplicitFunction* target)
  {
    auto filter = MakeShrinkingBall();
    filter->SetTargetFunction(target);
    filter->SetTimeStepSize(1.0);
    filter->UpdateTimeStep(10.0);
    return filter;
  };
  auto filter = follow(potential);
  for (const double bound : GetSkinBounds(filter))
  {
    EXPECT_NEAR(std::fabs(bound), 0.4, 0.1 * h) << "reaches the ball";
  }
  vtkNew<vtkImplicitBoolean> both;
  both->AddFunction(potential);
  both->AddFunction(potential);
  EXPECT_TRUE(AreSameSkins(GetBytes(follow(both)), GetBytes(filter))) << "in a union";
}

}
