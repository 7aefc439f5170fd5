// Inputs that vtkSkeletonPotential accepts as elements, useless inputs, and its cooperation with
// other classes of VTK.

#include "Support/MessageCapture.h"
#include "Support/SkeletonShapes.h"

#include "vtkImplicitBoolean.h"
#include "vtkTransform.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{
std::atomic<long> Allocations{ 0 };
}

// Prevents inlining: compilers would otherwise see malloc paired with delete.
[[gnu::noinline]] void* operator new(std::size_t size)
{
  ++Allocations;
  if (void* memory = std::malloc(size))
  {
    return memory;
  }
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace TestSkeletonInput
{
TEST(TestSkeletonInput, ChangesOfTheInputAreSeen)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.5) << "at the start";
  const auto changes = [&](const char* sentence, double expected)
  {
    static vtkMTimeType before = 0;
    EXPECT_TRUE(potential->GetMTime() > before) << "GetMTime: " << sentence;
    EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), expected) << sentence;
    before = potential->GetMTime();
  };
  shape.Points->SetPoint(0, 3.0, 0.0, 0.0);
  shape.Points->Modified();
  changes("a point has moved", 0.5);
  shape.Radii->SetValue(0, 6.0);
  shape.Radii->Modified();
  changes("a radius has grown", 0.5 - std::pow(0.75, 3));
  shape.Strengths->SetValue(0, 2.0);
  shape.Strengths->Modified();
  changes("a strength has grown", 0.5 - 2.0 * std::pow(0.75, 3));
  potential->SetThreshold(0.25);
  changes("Threshold", 0.25 - 2.0 * std::pow(0.75, 3));
  potential->SetStrengthArrayName(nullptr);
  changes("StrengthArrayName", 0.25 - std::pow(0.75, 3));
  potential->SetKernelToMetaball();
  changes("Kernel", 0.25 - 0.375);
  potential->SetRadiusArrayName("");
  changes("RadiusArrayName", 0.25);
  potential->SetRadius(6.0);
  changes("Radius", 0.25 - 0.375);
  vtkNew<vtkTransform> transform;
  potential->SetTransform(transform);
  changes("a transform is set", 0.25 - 0.375);
  transform->Translate(3.0, 0.0, 0.0);
  changes("the transform has moved", 0.25 - 0.375);
  EXPECT_EQ(potential->FunctionValue(0.0, 0.0, 0.0), 0.25 - 1.0) << "through the transform";
  potential->SetInput(nullptr);
  changes("no input", 0.25);
}

// One element is valid. Each of the others has one invalid number.
TEST(TestSkeletonInput, ElementsOfNoUseAreIgnored)
{
  SkeletonBuilder good;
  good.Add({ 0.1, 0.0, 0.0 }, 1.5, 0.8);
  SkeletonBuilder shape;
  shape.Add({ NaN, 0.0, 0.0 });
  shape.Add({ 0.0, Infinity, 0.0 });
  shape.Add({ 0.0, 0.0, 1e101 });
  shape.Add({ 0.0, 0.0, 0.0 }, 0.0);
  shape.Add({ 0.0, 0.0, 0.0 }, -1.0);
  shape.Add({ 0.0, 0.0, 0.0 }, NaN);
  shape.Add({ 0.0, 0.0, 0.0 }, Infinity);
  shape.Add({ 0.0, 0.0, 0.0 }, 1e-101);
  shape.Add({ 0.1, 0.0, 0.0 }, 1.5, 0.8);
  shape.Add({ 0.0, 0.0, 0.0 }, 1.0, NaN);
  shape.Add({ 0.0, 0.0, 0.0 }, 1.0, -Infinity);
  shape.Join({ shape.Add({ 0.0, 0.0, 0.0 }), shape.Add({ 1.0, NaN, 0.0 }) });
  vtkNew<vtkSkeletonPotential> potential;
  vtkNew<vtkSkeletonPotential> expected;
  shape.GiveTo(potential);
  good.GiveTo(expected);
  const MessageCapture messages(potential);
  const Point x = { 0.3, 0.2, 0.4 };
  EXPECT_EQ(ValueAt(potential, x), ValueAt(expected, x)) << "value of the good ones";
  EXPECT_TRUE(GradientAt(potential, x) == GradientAt(expected, x)) << "their gradient";
  EXPECT_EQ(potential->GetNumberOfIgnoredElements(), 11) << "ignored";
  EXPECT_EQ(messages.Warnings.size(), 1u) << "one warning";
  EXPECT_TRUE(messages.Has("11 points or segments are ignored")) << "that says how many";

  SkeletonBuilder broken;
  broken.Add({ 0.0, 0.0, 0.0 });
  broken.Join({ 0, 7 });
  broken.Mark(-3);
  vtkNew<vtkSkeletonPotential> ofBroken;
  broken.GiveTo(ofBroken);
  const MessageCapture second(ofBroken);
  EXPECT_EQ(ofBroken->GetNumberOfIgnoredElements(), 2) << "points that do not exist";
  EXPECT_EQ(ValueAt(ofBroken, { 0.0, 0.0, 0.0 }), -0.5) << "the rest is there";

  ofBroken->SetRadiusArrayName("");
  ofBroken->SetRadius(0.0);
  EXPECT_EQ(ofBroken->GetNumberOfIgnoredElements(), 3) << "Radius 0";
  ofBroken->SetRadius(NaN);
  EXPECT_EQ(ofBroken->GetNumberOfIgnoredElements(), 3) << "Radius NaN";
}

TEST(TestSkeletonInput, ArraysOfNoUseAreErrors)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 });
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  vectors->InsertNextTuple3(1.0, 1.0, 1.0);
  vtkNew<vtkDoubleArray> tooLong;
  tooLong->SetName("long");
  tooLong->InsertNextValue(1.0);
  tooLong->InsertNextValue(1.0);
  shape.Data->GetPointData()->AddArray(vectors);
  shape.Data->GetPointData()->AddArray(tooLong);
  for (const bool isRadius : { true, false })
  {
    for (const std::string name : { "absent", "vectors", "long" })
    {
      vtkNew<vtkSkeletonPotential> potential;
      potential->SetInput(shape.Data);
      isRadius ? potential->SetRadiusArrayName(name.c_str())
               : potential->SetStrengthArrayName(name.c_str());
      const MessageCapture messages(potential);
      EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.5) << name << ": F is 1/2";
      EXPECT_TRUE((GradientAt(potential, { 0.1, 0.0, 0.0 }) == Point{ 0.0, 0.0, 0.0 }))
        << "no gradient";
      EXPECT_EQ(messages.Errors.size(), 1u) << name << ": one error";
      const std::string kind = isRadius ? "radius" : "strength";
      EXPECT_TRUE(messages.Has("The " + kind + " array \"" + name + "\"")) << name << ": is named";
    }
  }
}

TEST(TestSkeletonInput, WithoutElementsIsThreshold)
{
  vtkNew<vtkSkeletonPotential> potential;
  const auto isEmpty = [&](const char* sentence)
  {
    EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.5) << sentence;
    EXPECT_TRUE((GradientAt(potential, { 0.0, 0.0, 0.0 }) == Point{ 0.0, 0.0, 0.0 })) << sentence;
    double bounds[6];
    EXPECT_TRUE(!potential->GetSkeletonBounds(bounds) && bounds[0] > bounds[1]) << "no bounds";
  };
  isEmpty("no input");
  vtkNew<vtkPolyData> empty;
  potential->SetInput(empty);
  isEmpty("an input without points");
  SkeletonBuilder shape;
  shape.GiveTo(potential);
  isEmpty("an input with no points in it");
  potential->SetElements(0, nullptr, nullptr, nullptr);
  isEmpty("no elements");
}

TEST(TestSkeletonInput, PlacesThatAreNotFiniteGiveNaN)
{
  Random random(7);
  SkeletonBuilder few;
  few.Add({ 0.0, 0.0, 0.0 });
  SkeletonBuilder many;
  Fill(many, random, 50, 10, 1.0, 1.0);
  for (SkeletonBuilder* shape : { &few, &many })
  {
    vtkNew<vtkSkeletonPotential> potential;
    shape->GiveTo(potential);
    for (const double bad : { NaN, Infinity, -Infinity })
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        Point x = { 0.0, 0.0, 0.0 };
        x[axis] = bad;
        EXPECT_TRUE(std::isnan(ValueAt(potential, x))) << "value";
        EXPECT_TRUE(std::isnan(GradientAt(potential, x)[axis])) << "gradient";
      }
    }
    EXPECT_EQ(ValueAt(potential, { 1e300, -1e300, 1e300 }), 0.5) << "very far away";
  }
}

TEST(TestSkeletonInput, BoundsHoldAllSupports)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 }, 0.5);
  shape.Join({ shape.Add({ 1.0, 2.0, 3.0 }, 0.25), shape.Add({ -4.0, 2.0, 3.0 }, 1.0) });
  shape.Add({ 100.0, 0.0, 0.0 }, -1.0);
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  const MessageCapture messages(potential);
  const double expected[6] = { -5.0, 1.25, -0.5, 3.0, -0.5, 4.0 };
  double bounds[6];
  EXPECT_TRUE(potential->GetSkeletonBounds(bounds)) << "there are bounds";
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(bounds[i], expected[i]) << "bound " << i;
  }
}

TEST(TestSkeletonInput, WorksInABooleanAndUnderATransform)
{
  SkeletonBuilder left;
  left.Add({ -2.0, 0.0, 0.0 });
  SkeletonBuilder right;
  right.Add({ 2.0, 0.0, 0.0 });
  vtkNew<vtkSkeletonPotential> a;
  vtkNew<vtkSkeletonPotential> b;
  left.GiveTo(a);
  right.GiveTo(b);
  vtkNew<vtkImplicitBoolean> both;
  both->AddFunction(a);
  both->AddFunction(b);
  EXPECT_EQ(both->FunctionValue(-2.0, 0.0, 0.0), -0.5) << "union, on the left";
  EXPECT_EQ(both->FunctionValue(2.0, 0.0, 0.0), -0.5) << "union, on the right";
  EXPECT_EQ(both->FunctionValue(0.0, 0.0, 0.0), 0.5) << "union, between";

  vtkNew<vtkTransform> transform;
  transform->Translate(-2.0, 0.0, 0.0);
  a->SetTransform(transform);
  vtkNew<vtkDoubleArray> points;
  points->SetNumberOfComponents(3);
  points->InsertNextTuple3(0.0, 0.0, 0.0);
  points->InsertNextTuple3(0.5, 0.0, 0.0);
  vtkNew<vtkDoubleArray> values;
  a->FunctionValue(points, values);
  EXPECT_EQ(values->GetValue(0), -0.5) << "moved to the origin";
  EXPECT_EQ(values->GetValue(1), 0.5 - std::pow(0.75, 3)) << "half a radius from the origin";
  const double x[3] = { 0.5, 0.0, 0.0 };
  double g[3];
  a->FunctionGradient(x, g);
  EXPECT_NEAR(g[0], 3.0 * std::pow(0.75, 2), 1e-14) << "gradient under the transform";
}

TEST(TestSkeletonInput, OwnElementsAreAsThoseOfAnInput)
{
  Random random(8);
  SkeletonBuilder shape;
  std::vector<double> positions;
  std::vector<double> radii;
  std::vector<double> strengths;
  for (int i = 0; i < 300; ++i)
  {
    const Point p = random.In(0.0, 1.0);
    positions.insert(positions.end(), p.begin(), p.end());
    radii.push_back(i == 7 ? NaN : random.Between(0.05, 0.3));
    strengths.push_back(random.Between(-0.5, 1.0));
    shape.Add(p, radii.back(), strengths.back());
  }
  vtkNew<vtkSkeletonPotential> ofInput;
  vtkNew<vtkSkeletonPotential> ofArrays;
  shape.GiveTo(ofInput);
  const MessageCapture input(ofInput);
  const MessageCapture arrays(ofArrays);
  ofArrays->SetElements(300, positions.data(), radii.data(), strengths.data());
  int different = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Point x = random.In(0.0, 1.0);
    different += ValueAt(ofInput, x) != ValueAt(ofArrays, x) ? 1 : 0;
  }
  EXPECT_EQ(different, 0) << "points where the bits differ";
  EXPECT_EQ(ofArrays->GetNumberOfIgnoredElements(), 1) << "ignored";
  EXPECT_EQ(arrays.Warnings.size(), 0u) << "silently";
  EXPECT_EQ(input.Warnings.size(), 1u) << "which an input is not";

  ofArrays->SetRadius(2.0);
  ofArrays->SetElements(1, positions.data(), nullptr, nullptr);
  const Point x = { positions[0] + 1.0, positions[1], positions[2] };
  EXPECT_NEAR(ValueAt(ofArrays, x), 0.5 - std::pow(0.75, 3), 1e-14) << "Radius, strength 1";
  ofArrays->SetInput(shape.Data);
  ofArrays->SetRadiusArrayName("r");
  ofArrays->SetStrengthArrayName("s");
  EXPECT_EQ(ValueAt(ofArrays, x), ValueAt(ofInput, x)) << "an input takes their place";
}

TEST(TestSkeletonInput, AnAlgorithmTakesThePlaceOfOwnElements)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 });
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(shape.Data);
  const Point own = { 5.0, 0.0, 0.0 };
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetElements(1, own.data(), nullptr, nullptr);
  EXPECT_EQ(ValueAt(potential, own), -0.5) << "own elements";
  potential->SetInputConnection(producer->GetOutputPort());
  EXPECT_EQ(ValueAt(potential, own), 0.5) << "they have gone";
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.5) << "those of the algorithm";
}

TEST(TestSkeletonInput, AnErrorLeavesNoElements)
{
  SkeletonBuilder shape;
  shape.Join({ shape.Add({ 0.0, 0.0, 0.0 }), shape.Add({ 5.0, 0.0, 0.0 }) });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  potential->SetParticleModel(vtkSkeletonPotential::ANISOTROPIC);
  const MessageCapture messages(potential);
  double bounds[6];
  EXPECT_FALSE(potential->GetSkeletonBounds(bounds)) << "bounds";
  EXPECT_TRUE(messages.Has("Lines need ParticleModel SUM")) << messages.GetLastError();
}

TEST(TestSkeletonInput, MovingElementsNeedNoMemory)
{
  Random random(9);
  vtkNew<vtkSkeletonPotential> potential;
  std::vector<double> positions(3 * 2000);
  const std::vector<double> radii(2000, 0.1);
  long allocated = 0;
  for (int step = 0; step < 20; ++step)
  {
    for (double& coordinate : positions)
    {
      coordinate = random.Between(0.0, 1.0 + 0.01 * std::sin(step));
    }
    const long before = Allocations;
    potential->SetElements(2000, positions.data(), radii.data(), nullptr);
    potential->Build();
    double value;
    potential->EvaluateBatch(1, positions.data(), &value, nullptr);
    allocated = step < 10 ? 0 : allocated + (Allocations - before);
  }
  EXPECT_EQ(allocated, 0) << "allocations in the last ten of twenty steps";
}

TEST(TestSkeletonInput, EveryPointThatEndsNoSegmentIsAnElement)
{
  SkeletonBuilder shape;
  shape.Join({ shape.Add({ 0.0, 0.0, 0.0 }), shape.Add({ 5.0, 0.0, 0.0 }) });
  shape.Add({ 0.0, 5.0, 0.0 });
  const vtkIdType marked = shape.Add({ 0.0, 0.0, 5.0 });
  shape.Mark(marked);
  const vtkIdType single = shape.Add({ 5.0, 5.0, 5.0 });
  shape.Join({ single });
  shape.Join({ single, single });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  EXPECT_EQ(ValueAt(potential, { 0.0, 5.0, 0.0 }), -0.5) << "a point without a cell";
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 5.0 }), -0.5) << "a point with a vertex cell";
  EXPECT_EQ(ValueAt(potential, { 5.0, 5.0, 5.0 }), -0.5) << "a point of a line without pieces";
  EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.5) << "the end of a segment";
  EXPECT_EQ(potential->GetNumberOfIgnoredElements(), 0) << "ignored";
}
}
