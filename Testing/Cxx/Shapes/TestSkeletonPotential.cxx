// vtkSkeletonPotential compared with its formulas. == means bitwise identical.

#include "Support/MessageCapture.h"
#include "Support/SkeletonShapes.h"

#include "vtkContourFilter.h"
#include "vtkSampleFunction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestSkeletonPotential
{
const std::array<int, 3> AllKernels = { vtkSkeletonPotential::WYVILL,
  vtkSkeletonPotential::CUBIC_SPLINE, vtkSkeletonPotential::METABALL };
const char* const KernelNames[] = { "Wyvill", "cubic spline", "metaball" };

// Kernels by their definition, and their derivatives.
double KernelAt(int kernel, double q)
{
  if (q >= 1.0)
  {
    return 0.0;
  }
  switch (kernel)
  {
    case vtkSkeletonPotential::WYVILL:
      return std::pow(1.0 - q * q, 3);
    case vtkSkeletonPotential::CUBIC_SPLINE:
      return q <= 0.5 ? 1.0 - 6.0 * q * q + 6.0 * q * q * q : 2.0 * std::pow(1.0 - q, 3);
    default:
      return q <= 1.0 / 3.0 ? 1.0 - 3.0 * q * q : 1.5 * std::pow(1.0 - q, 2);
  }
}

double KernelSlopeAt(int kernel, double q)
{
  if (q >= 1.0)
  {
    return 0.0;
  }
  switch (kernel)
  {
    case vtkSkeletonPotential::WYVILL:
      return -6.0 * q * std::pow(1.0 - q * q, 2);
    case vtkSkeletonPotential::CUBIC_SPLINE:
      return q <= 0.5 ? 18.0 * q * q - 12.0 * q : -6.0 * std::pow(1.0 - q, 2);
    default:
      return q <= 1.0 / 3.0 ? -6.0 * q : -3.0 * (1.0 - q);
  }
}

// Fewer than 20 roundings of numbers up to 18 * strength: 1e-13 is ample.
TEST(TestSkeletonPotential, KernelsHaveTheirValuesAndSlopes)
{
  const double radius = 2.0;
  const double strength = 3.0;
  const Point centre = { 0.5, -1.0, 4.0 };
  SkeletonBuilder shape;
  shape.Add(centre, radius, strength);
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  Random random(1);
  for (const int kernel : AllKernels)
  {
    potential->SetKernel(kernel);
    for (const double q : { 0.0, 1e-9, 0.1, 0.3, 0.36, 0.49, 0.51, 0.7, 0.999, 1.001, 5.0 })
    {
      const Point d = random.Direction();
      const double distance = q * radius;
      const Point x = { centre[0] + distance * d[0], centre[1] + distance * d[1],
        centre[2] + distance * d[2] };
      const std::string name = std::string(KernelNames[kernel]) + " at q = " + std::to_string(q);
      const double value = 0.5 - strength * KernelAt(kernel, q);
      EXPECT_NEAR(ValueAt(potential, x), value, 1e-13) << name;
      const double slope = -strength * KernelSlopeAt(kernel, q) / radius;
      const Point gradient = GradientAt(potential, x);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(gradient[axis], slope * d[axis], 1e-13) << name << ": gradient";
      }
    }
    EXPECT_TRUE((GradientAt(potential, centre) == Point{ 0.0, 0.0, 0.0 }))
      << "no slope at the centre";
  }
}

// Central differences with step h are off by h/2 times the jump or variation of the second
// derivative, at most 24 strength / radius^2 per element and end. Rounding adds 1e-15 / h.
TEST(TestSkeletonPotential, GradientIsThatOfTheValue)
{
  const double h = 1e-7;
  Random random(2);
  SkeletonBuilder shape;
  double bound = 0.0;
  for (int i = 0; i < 20; ++i)
  {
    const double radius = random.Between(0.5, 1.0);
    shape.Add(random.In(0.0, 1.0), radius, random.Between(-0.5, 1.0));
    bound += 24.0 / (radius * radius);
  }
  shape.Join({ 4, 5, 6, 7 });
  shape.Join({ 6, 8 });
  shape.Join({ 9, 10 });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  for (const int kernel : AllKernels)
  {
    potential->SetKernel(kernel);
    double largestError = 0.0;
    for (int i = 0; i < 500; ++i)
    {
      const Point x = random.In(-0.5, 1.5);
      const Point gradient = GradientAt(potential, x);
      for (int axis = 0; axis < 3; ++axis)
      {
        Point before = x;
        Point after = x;
        before[axis] -= h;
        after[axis] += h;
        const double rise = ValueAt(potential, after) - ValueAt(potential, before);
        const double error = std::fabs(rise / (after[axis] - before[axis]) - gradient[axis]);
        largestError = std::max(largestError, error);
      }
    }
    EXPECT_LT(largestError, bound * h + 1e-7) << KernelNames[kernel];
  }
}

// A segment acts like a point at the same distance.
TEST(TestSkeletonPotential, SegmentIsACapsule)
{
  SkeletonBuilder shape;
  shape.Join({ shape.Add({ 0.0, 0.0, 0.0 }), shape.Add({ 2.0, 0.0, 0.0 }) });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  for (const int kernel : AllKernels)
  {
    potential->SetKernel(kernel);
    for (const double d : { 0.0, 0.2, 0.4, 0.8, 1.2 })
    {
      const double expected = 0.5 - KernelAt(kernel, d);
      const double s = d * std::sqrt(0.5);
      const std::string name = std::string(KernelNames[kernel]) + " at " + std::to_string(d);
      EXPECT_NEAR(ValueAt(potential, { 0.7, d, 0.0 }), expected, 1e-14)
        << name << " from the middle";
      EXPECT_NEAR(ValueAt(potential, { 1.3, s, s }), expected, 1e-14) << name << " from the middle";
      EXPECT_NEAR(ValueAt(potential, { -d, 0.0, 0.0 }), expected, 1e-14)
        << name << " from the start";
      EXPECT_NEAR(ValueAt(potential, { 2.0 + s, 0.0, s }), expected, 1e-14)
        << name << " from the end";
    }
  }
}

// At a quarter of the length, radius and strength have changed by a quarter of the difference.
TEST(TestSkeletonPotential, RadiusAndStrengthRunLinearly)
{
  SkeletonBuilder shape;
  shape.Join({ shape.Add({ 0.0, 0.0, 0.0 }, 1.0, 2.0), shape.Add({ 0.0, 4.0, 0.0 }, 3.0, -2.0) });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  for (const int kernel : AllKernels)
  {
    potential->SetKernel(kernel);
    const double influence = 1.0 * KernelAt(kernel, 0.6 / 1.5);
    EXPECT_NEAR(ValueAt(potential, { 0.0, 1.0, 0.6 }), 0.5 - influence, 1e-14)
      << KernelNames[kernel];
    const double atEnd = -2.0 * KernelAt(kernel, 1.5 / 3.0);
    EXPECT_NEAR(ValueAt(potential, { 0.0, 5.5, 0.0 }), 0.5 - atEnd, 1e-14) << KernelNames[kernel];
  }
}

// Cutting a line into pieces, or into cells of their own, changes nothing.
TEST(TestSkeletonPotential, JointsDoNotBulge)
{
  SkeletonBuilder whole;
  whole.Join({ whole.Add({ 0.0, 0.0, 0.0 }), whole.Add({ 3.0, 0.0, 0.0 }) });
  SkeletonBuilder pieces;
  SkeletonBuilder cells;
  std::vector<vtkIdType> line;
  for (const double x : { 0.0, 0.1, 0.9, 1.0, 2.5, 3.0 })
  {
    line.push_back(pieces.Add({ x, 0.0, 0.0 }));
    cells.Add({ x, 0.0, 0.0 });
    if (line.size() > 1)
    {
      cells.Join({ line[line.size() - 2], line.back() });
    }
  }
  pieces.Join(line);
  pieces.Join({ line[2], line[1] }); // again, backwards
  vtkNew<vtkSkeletonPotential> ofWhole;
  vtkNew<vtkSkeletonPotential> ofPieces;
  vtkNew<vtkSkeletonPotential> ofCells;
  whole.GiveTo(ofWhole);
  pieces.GiveTo(ofPieces);
  cells.GiveTo(ofCells);
  Random random(3);
  for (int i = 0; i < 200; ++i)
  {
    const Point p = random.In(-1.0, 1.0);
    const Point x = { 1.5 + 2.5 * p[0], p[1], p[2] };
    EXPECT_NEAR(ValueAt(ofPieces, x), ValueAt(ofWhole, x), 1e-13) << "a line cut into pieces";
    EXPECT_EQ(ValueAt(ofCells, x), ValueAt(ofPieces, x)) << "pieces as cells of their own";
  }
}

// Each segment has its own copies of its ends, as in pieces of several ranks. Ends that differ in
// radius are no joint. A segment between two copies of a point is that point.
TEST(TestSkeletonPotential, CopiesOfAnEndAreOnePoint)
{
  const std::vector<Point> corners = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 1.0, 1.0, 0.5 },
    { 2.0, 1.0, 0.5 } };
  SkeletonBuilder shared;
  SkeletonBuilder copied;
  std::vector<vtkIdType> line;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    line.push_back(shared.Add(corners[i]));
    if (i > 0)
    {
      copied.Join({ copied.Add(corners[i - 1]), copied.Add(corners[i]) });
    }
  }
  shared.Join(line);
  copied.Join({ copied.Add(corners[1]), copied.Add(corners[1]) });
  vtkNew<vtkSkeletonPotential> ofShared;
  vtkNew<vtkSkeletonPotential> ofCopied;
  shared.GiveTo(ofShared);
  copied.GiveTo(ofCopied);
  Random random(5);
  for (int i = 0; i < 200; ++i)
  {
    const Point x = random.In(-0.5, 2.5);
    EXPECT_EQ(ValueAt(ofCopied, x), ValueAt(ofShared, x)) << "as with shared points";
  }
  copied.Radii->SetValue(2, 2.0 * copied.Radii->GetValue(1));
  copied.Data->Modified();
  EXPECT_LT(ValueAt(ofCopied, corners[1]), -1.0) << "no joint of two radii";
  SkeletonBuilder single;
  single.Join({ single.Add(corners[0]), single.Add(corners[0]) });
  vtkNew<vtkSkeletonPotential> ofSingle;
  single.GiveTo(ofSingle);
  EXPECT_EQ(ValueAt(ofSingle, corners[0]), -0.5) << "one point";
}

// On the outer side of a bend or branching, the joint acts as one point.
TEST(TestSkeletonPotential, BendsAndBranchesAreOneAtTheJoint)
{
  SkeletonBuilder shape;
  const vtkIdType joint = shape.Add({ 0.0, 0.0, 0.0 });
  shape.Join({ shape.Add({ 3.0, 0.0, 0.0 }), joint, shape.Add({ 0.0, 3.0, 0.0 }) });
  shape.Join({ joint, shape.Add({ 0.0, 0.0, 3.0 }) });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  const double d = std::sqrt(0.12);
  EXPECT_NEAR(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.5, 1e-14) << "at the joint";
  EXPECT_NEAR(ValueAt(potential, { -0.2, -0.2, -0.2 }), 0.5 - KernelAt(0, d), 1e-14) << "outside";
  EXPECT_NEAR(ValueAt(potential, { 2.0, -0.3, 0.0 }), 0.5 - KernelAt(0, 0.3), 1e-14)
    << "on a branch";
  shape.Mark(joint);
  shape.Data->Modified();
  EXPECT_NEAR(ValueAt(potential, { 0.0, 0.0, 0.0 }), -1.5, 1e-14) << "a vertex cell adds a point";
}

// Contour vertices lie where linear interpolation of F over a step of h is 0. They are off by h^2/8
// * |W''| / |W'|. W'' <= 12 for all kernels, and W' at the surface follows from the kernel.
TEST(TestSkeletonPotential, SampledSurfaceIsASphere)
{
  const double fractions[] = { 0.45420202, 0.36117586, 0.42264973 };
  const double h = 2.0 / 49.0;
  for (const int kernel : AllKernels)
  {
    vtkNew<vtkSkeletonPotential> potential;
    SkeletonBuilder shape;
    shape.Add({ 0.1, 0.0, 0.0 }, 2.0);
    shape.GiveTo(potential);
    potential->SetKernel(kernel);
    vtkNew<vtkSampleFunction> sample;
    sample->SetImplicitFunction(potential);
    sample->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
    sample->SetSampleDimensions(50, 50, 50);
    sample->SetOutputScalarTypeToDouble();
    vtkNew<vtkContourFilter> contour;
    contour->SetInputConnection(sample->GetOutputPort());
    contour->SetValue(0, 0.0);
    contour->Update();
    const double q = fractions[kernel];
    const double slope = std::fabs(KernelSlopeAt(kernel, q));
    const double tolerance = h * h / 8.0 * (12.0 / 4.0) / (slope / 2.0);
    double largestError = 0.0;
    vtkPolyData* surface = contour->GetOutput();
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      Point p;
      surface->GetPoint(i, p.data());
      largestError = std::max(largestError, std::fabs(Distance(p, { 0.1, 0.0, 0.0 }) - 2.0 * q));
    }
    EXPECT_TRUE(surface->GetNumberOfPoints() > 1000) << "there is a surface";
    EXPECT_LT(largestError, tolerance) << KernelNames[kernel];
    EXPECT_LT(ValueAt(potential, { 0.1, 0.0, 0.0 }), 0.0) << "negative inside";
  }
}

TEST(TestSkeletonPotential, NegativeStrengthCarves)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 }, 2.0, 1.0);
  shape.Add({ 0.5, 0.0, 0.0 }, 1.0, -1.0);
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  EXPECT_LT(ValueAt(potential, { -0.5, 0.0, 0.0 }), 0.0) << "inside on the other side";
  EXPECT_GT(ValueAt(potential, { 0.5, 0.0, 0.0 }), 0.0) << "outside where it is carved";
}

TEST(TestSkeletonPotential, AfterAnErrorAllSpaceIsOutside)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 });
  const auto expectError = [&](const char* sentence, const auto& change, const auto& mend)
  {
    vtkNew<vtkSkeletonPotential> potential;
    shape.GiveTo(potential);
    change(potential);
    const MessageCapture messages(potential);
    EXPECT_EQ(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.5) << sentence;
    EXPECT_EQ(messages.Errors.size(), 1u) << sentence;
    EXPECT_TRUE(messages.Has(sentence)) << sentence;
    mend(potential);
    EXPECT_LT(ValueAt(potential, { 0.0, 0.0, 0.0 }), 0.0) << sentence;
  };
  for (const double bad : { -0.5, 0.0, std::numeric_limits<double>::quiet_NaN() })
  {
    expectError(
      "Threshold has to be", [&](vtkSkeletonPotential* potential) { potential->SetThreshold(bad); },
      [](vtkSkeletonPotential* potential) { potential->SetThreshold(0.25); });
    expectError(
      "ParticleSpacing is",
      [&](vtkSkeletonPotential* potential)
      {
        potential->SetParticleModelToAnisotropic();
        potential->SetParticleSpacing(bad);
      },
      [](vtkSkeletonPotential* potential) { potential->SetParticleSpacing(1.0); });
  }
}
}
