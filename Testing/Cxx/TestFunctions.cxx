// Implicit functions as targets: any of VTK, whatever its scale, its sign and its gradient.

#include "Check.h"
#include "PipelineTools.h"

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

#include <mutex>
#include <set>
#include <thread>

using namespace activesurface;

namespace
{

constexpr double VoxelSize = 0.0625;

vtkSmartPointer<vtkSphere> MakeBall(double x, double radius)
{
  auto ball = vtkSmartPointer<vtkSphere>::New();
  ball->SetCenter(x, 0.0, 0.0);
  ball->SetRadius(radius);
  return ball;
}

// From a ball of radius .6 towards the target for a while; the bytes of the skin.
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

// Not in the list of those that may be called by several threads.
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

// VTK gives a union the gradient of a difference, here that of the wrong ball, which would change
// the speed by the ratio of the two.
void BooleansHaveTheGradientOfTheTermThatDecides(Check& check)
{
  auto ball = MakeBall(0.0, 0.4);
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
  auto far = MakeBall(5.0, 0.1);
  auto around = MakeBall(0.1, 3.0);
  using Boolean = vtkImplicitBoolean;
  check.True(combine(Boolean::VTK_UNION, far, ball) == alone, "union with a far one");
  check.True(combine(Boolean::VTK_UNION, ball, far) == alone, "the other way round");
  check.True(combine(Boolean::VTK_INTERSECTION, around, ball) == alone, "intersection");
  check.True(combine(Boolean::VTK_INTERSECTION, ball, around) == alone, "the other way round");
  check.True(combine(Boolean::VTK_DIFFERENCE, ball, far) == alone, "difference");
  check.True(combine(Boolean::VTK_UNION_OF_MAGNITUDES, around, ball) == alone, "magnitudes");
}

void BooleansMayBeNested(Check& check)
{
  auto ball = MakeBall(0.0, 0.4);
  vtkNew<vtkImplicitBoolean> inner;
  inner->SetOperationTypeToUnion();
  inner->AddFunction(MakeBall(5.0, 0.1));
  inner->AddFunction(ball);
  vtkNew<vtkImplicitBoolean> outer;
  outer->SetOperationTypeToDifference();
  outer->AddFunction(inner);
  outer->AddFunction(MakeBall(-5.0, 0.2));
  check.True(BytesTowards(outer) == BytesTowards(ball), "the same bytes as the ball alone");
}

// A superquadric of roundness 1 is a ball. VTK gives it no gradient; central differences of a
// quadratic function are exact but for rounding.
void FunctionsWithoutGradientGetOne(Check& check)
{
  vtkNew<vtkSuperquadric> round;
  round->SetSize(0.4);
  const auto bounds = BoundsTowards(round, 0.5);
  const auto expected = BoundsTowards(MakeBall(0.0, 0.4), 0.5);
  for (int i = 0; i < 6; ++i)
  {
    check.Near(bounds[i], expected[i], 1e-5, "bound " + std::to_string(i));
  }
}

void SumsAndTransformsWork(Check& check)
{
  const auto expected = BoundsTowards(MakeBall(0.1, 0.4), 0.5);
  vtkNew<vtkImplicitSum> sum;
  sum->AddFunction(MakeBall(0.1, 0.4), 2.0);
  check.Near(BoundsTowards(sum, 0.5)[1], expected[1], 1e-5, "vtkImplicitSum");
  auto moved = MakeBall(0.0, 0.4);
  vtkNew<vtkTransform> transform;
  transform->Translate(-0.1, 0.0, 0.0);
  moved->SetTransform(transform);
  check.Near(BoundsTowards(moved, 0.5)[1], expected[1], 1e-5, "a transform");
}

// Powers of two are exact in floating point.
void ScaleOfTheFunctionDoesNotMatter(Check& check)
{
  const auto make = [](double scale)
  {
    vtkNew<vtkQuadric> quadric;
    quadric->SetCoefficients(
      scale, 2.0 * scale, scale, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.25 * scale);
    return BytesTowards(quadric);
  };
  check.True(make(1.0) == make(1024.0), "1024 times as steep");
}

// -F above -iso is F below iso.
void InsideMayBeAboveTheIsoValue(Check& check)
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
  check.True(GetBytesAt(plain, 0.5) == GetBytesAt(inverted, 0.5), "the same bytes");
  plain->SetInitialFunction(nullptr);
  plain->UpdateTimeStep(0.0);
  // Chords are within h^2 / 8r.
  check.Near(
    GetSkinBounds(plain)[1], std::sqrt(0.125), 0.03 * VoxelSize, "radius at the iso value");
}

// Beyond the reach the speed is Attraction * TargetReach: uniform, so exact but for chords, .13 h
// (README of NarrowBand, Figures).
void FarTargetsAttractWithConstantSpeed(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(MakeBall(0.0, 0.1));
  filter->SetTargetReach(0.05);
  filter->SetAttraction(2.0);
  filter->SetTimeStepSize(0.5);
  filter->UpdateTimeStep(2.0);
  check.Near(GetSkinBounds(filter)[1], 0.6 - 2.0 * 0.05 * 2.0, 0.13 * VoxelSize, "radius");
}

// V = .4^2 - r^2, so r = .4 (1 + c e^(-.8 t)) / (1 - c e^(-.8 t)), c = .2. First order in time:
// substeps of .1 have .92^5 for e^(-.4), which makes the radius .002 or .03 h less; chords .02 h.
void WithoutNormalizationTheValueItselfAttracts(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->NormalizeTargetOff();
  filter->UpdateTimeStep(0.5);
  const double e = 0.2 * std::exp(-0.4);
  check.Near(GetSkinBounds(filter)[1], 0.4 * (1.0 + e) / (1.0 - e), 0.06 * VoxelSize, "radius");
}

void SkeletonPotentialsNeedNoBounds(Check& check)
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
  check.Less(1000, filter->GetOutput()->GetNumberOfPolys(), "triangles on the target");
  filter->SetTargetFunction(MakeBall(10.0, 0.3));
  filter->SetInitialFunction(potential);
  filter->Update();
  check.Less(1000, filter->GetOutput()->GetNumberOfPolys(), "triangles on the initial shape");

  // Its input counts for the MTime.
  filter->SetTargetFunction(potential);
  filter->SetInitialFunction(nullptr);
  filter->Update();
  const double before = GetSkinBounds(filter)[1];
  points->SetPoint(1, 10.4, 0.0, 0.0);
  points->Modified();
  data->Modified();
  filter->Update();
  check.Near(GetSkinBounds(filter)[1] - before, 0.1, 0.02, "its points have moved");
}

void UnknownFunctionsAreEvaluatedByOneThread(Check& check)
{
  vtkNew<ShyBall> shy;
  shy->SetRadius(0.4);
  check.True(BytesTowards(shy) == BytesTowards(MakeBall(0.0, 0.4)), "the same bytes");
  // Enough work for more than one, if they were let.
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(shy);
  filter->SetInitialFunction(shy);
  filter->SetVoxelSize(0.02);
  filter->SetTimeStepSize(0.01);
  filter->UpdateTimeStep(0.02);
  check.Equal(shy->Callers.size(), std::size_t(1), "threads");
}

void FunctionsAreLetGo(Check& check)
{
  auto ball = MakeBall(0.0, 0.4);
  const int count = ball->GetReferenceCount();
  {
    vtkNew<vtkActiveImplicitSurface> filter;
    filter->SetTargetFunction(ball);
    filter->SetInitialFunction(ball);
    filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
    filter->Update();
    check.Less(count, ball->GetReferenceCount(), "references while in use");
  }
  check.Equal(ball->GetReferenceCount(), count, "references afterwards");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "BooleansHaveTheGradientOfTheTermThatDecides",
        BooleansHaveTheGradientOfTheTermThatDecides },
      { "BooleansMayBeNested", BooleansMayBeNested },
      { "FunctionsWithoutGradientGetOne", FunctionsWithoutGradientGetOne },
      { "SumsAndTransformsWork", SumsAndTransformsWork },
      { "ScaleOfTheFunctionDoesNotMatter", ScaleOfTheFunctionDoesNotMatter },
      { "InsideMayBeAboveTheIsoValue", InsideMayBeAboveTheIsoValue },
      { "FarTargetsAttractWithConstantSpeed", FarTargetsAttractWithConstantSpeed },
      { "WithoutNormalizationTheValueItselfAttracts", WithoutNormalizationTheValueItselfAttracts },
      { "SkeletonPotentialsNeedNoBounds", SkeletonPotentialsNeedNoBounds },
      { "UnknownFunctionsAreEvaluatedByOneThread", UnknownFunctionsAreEvaluatedByOneThread },
      { "FunctionsAreLetGo", FunctionsAreLetGo } });
}
