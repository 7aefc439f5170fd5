// Properties of ANISOTROPIC: isolated balls, planes and volumes of the true size, gradients,
// bitwise identical results everywhere, and robustness to bad neighbourhoods.

#include "Support/MessageCapture.h"
#include "Support/SkeletonShapes.h"

#include "Base/InstructionSets.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace activesurface;

namespace TestParticleModels
{

namespace
{
constexpr double Spacing = 0.2;
constexpr double R = 0.5 * Spacing; // a particle's own radius

constexpr double Reach = 2.25 * Spacing;

void Choose(vtkSkeletonPotential* potential)
{
  potential->SetParticleModelToAnisotropic();
  potential->SetParticleSpacing(Spacing);
  potential->SetRadius(Reach);
}

vtkSmartPointer<vtkSkeletonPotential> MakePotential(const std::vector<Point>& places)
{
  SkeletonBuilder shape;
  for (const Point& x : places)
  {
    shape.Add(x, Reach, 1.0);
  }
  auto potential = vtkSmartPointer<vtkSkeletonPotential>::New();
  shape.GiveTo(potential);
  Choose(potential);
  return potential;
}

std::vector<Point> MakeBox(int x, int y, int z)
{
  std::vector<Point> places;
  for (int i = 0; i < x; ++i)
  {
    for (int j = 0; j < y; ++j)
    {
      for (int k = 0; k < z; ++k)
      {
        places.push_back({ (i + 0.5) * Spacing, (j + 0.5) * Spacing, (k + 0.5) * Spacing });
      }
    }
  }
  return places;
}

// Fraction of a segment at which F changes its sign, to 2^-40.
double FindSurface(vtkSkeletonPotential* potential, const Point& inside, const Point& outside)
{
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 40; ++i)
  {
    const double middle = 0.5 * (low + high);
    Point x;
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = inside[axis] + middle * (outside[axis] - inside[axis]);
    }
    (ValueAt(potential, x) < 0.0 ? low : high) = middle;
  }
  return low;
}

// Volume of the inside, from columns of points r/4 apart.
double FindVolume(vtkSkeletonPotential* potential, const Point& low, const Point& high)
{
  const double step = 0.25 * R;
  std::size_t inside = 0;
  for (double x = low[0]; x < high[0]; x += step)
  {
    for (double y = low[1]; y < high[1]; y += step)
    {
      std::vector<Point> column;
      for (double z = low[2]; z < high[2]; z += step)
      {
        column.push_back({ x, y, z });
      }
      std::vector<double> values(column.size());
      potential->EvaluateBatch(
        static_cast<vtkIdType>(column.size()), column[0].data(), values.data(), nullptr);
      for (const double value : values)
      {
        inside += value < 0.0 ? 1 : 0;
      }
    }
  }
  return static_cast<double>(inside) * step * step * step;
}

std::vector<Point> MakeCloud(unsigned seed, int count, double side)
{
  Random random(seed);
  std::vector<Point> places;
  for (int i = 0; i < count; ++i)
  {
    places.push_back(random.In(0.0, side));
  }
  return places;
}
}

TEST(TestParticleModels, LoneParticleIsABallOfItsOwnRadius)
{
  auto potential = MakePotential({ { 0.1, 0.2, 0.3 } });
  for (const Point& way : std::vector<Point>{ { 1, 0, 0 }, { 0, -1, 0 }, { .6, 0, .8 } })
  {
    const Point far = { 0.1 + way[0], 0.2 + way[1], 0.3 + way[2] };
    EXPECT_NEAR(FindSurface(potential, { 0.1, 0.2, 0.3 }, far), R, 1e-6 * R);
  }
}

// The surface should be a plane, r above the centres of the top layer, to 0.15 r.
TEST(TestParticleModels, LayersOfABodyAreAPlane)
{
  auto potential = MakePotential(MakeBox(16, 16, 10));
  for (const double x : { 1.5, 1.55, 1.6, 1.66, 1.7 })
  {
    const Point inside = { x, 1.6, 1.0 };
    const Point outside = { x, 1.6, 3.0 };
    const double height = 1.0 + 2.0 * FindSurface(potential, inside, outside);
    EXPECT_NEAR(height, 10 * Spacing, 0.15 * R) << "at x = " << x;
  }
}

TEST(TestParticleModels, SheetOfOneLayerIsAsThickAsAParticle)
{
  auto potential = MakePotential(MakeBox(16, 16, 1));
  for (const double x : { 1.5, 1.6, 1.66 })
  {
    const double height = FindSurface(potential, { x, 1.6, R }, { x, 1.6, R + 1.0 });
    EXPECT_NEAR(height, R, 0.15 * R) << "at x = " << x;
  }
}

TEST(TestParticleModels, BoxHasTheVolumeOfItsParticles)
{
  auto potential = MakePotential(MakeBox(12, 12, 12));
  potential->Build();
  const double volume = FindVolume(potential, { -.3, -.3, -.3 }, { 2.7, 2.7, 2.7 });
  EXPECT_NEAR(volume / (12 * 12 * 12 * Spacing * Spacing * Spacing), 1.0, 0.02);
}

TEST(TestParticleModels, SheetsThatAreApartHaveAGapBetween)
{
  std::vector<Point> places = MakeBox(12, 12, 3);
  const std::size_t count = places.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    // Facing layers are 5.5 r apart, so their surfaces would be 3.5 r apart.
    places.push_back({ places[i][0], places[i][1], places[i][2] + 2 * Spacing + 5.5 * R });
  }
  auto potential = MakePotential(places);
  EXPECT_GT(ValueAt(potential, { 1.2, 1.2, 2.5 * Spacing + 2.75 * R }), 0.0);
}

// Central differences of a step e have two errors: e^2 times the third derivative, which is below
// 10 / R^3, and the rounding of F, 2e-7, over e.
TEST(TestParticleModels, GradientIsThatOfTheFunction)
{
  auto potential = MakePotential(MakeCloud(1, 300, 1.5));
  Random random(2);
  const double e = 5e-3 * R;
  for (int i = 0; i < 200; ++i)
  {
    const Point x = random.In(-0.2, 1.7);
    const Point gradient = GradientAt(potential, x);
    for (int axis = 0; axis < 3; ++axis)
    {
      Point before = x, after = x;
      before[axis] -= e;
      after[axis] += e;
      const double slope = (ValueAt(potential, after) - ValueAt(potential, before)) / (2.0 * e);
      EXPECT_NEAR(gradient[axis], slope, 5e-4 / R);
    }
  }
}

TEST(TestParticleModels, BatchesAndInstructionSetsGiveTheSameBits)
{
  const InstructionSet usual = GetInstructionSet();
  const std::vector<Point> places = MakeCloud(4, 3000, 1.6);
  std::vector<std::vector<double>> all;
  for (const InstructionSet set :
    { InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512 })
  {
    SetInstructionSet(set);
    auto potential = MakePotential(MakeCloud(3, 400, 1.5));
    potential->Build();
    std::vector<double> numbers(4 * places.size());
    const auto count = static_cast<vtkIdType>(places.size());
    potential->EvaluateBatch(count, places[0].data(), numbers.data(), numbers.data() + count);
    for (std::size_t i = 0; i < places.size(); i += 37)
    {
      EXPECT_EQ(ValueAt(potential, places[i]), numbers[i]) << "single evaluation as in the batch";
    }
    all.push_back(numbers);
  }
  SetInstructionSet(usual);
  EXPECT_TRUE(all[0] == all[1] && all[0] == all[2]);
}

// At least one axis of each neighbourhood has length zero.
TEST(TestParticleModels, DegenerateNeighbourhoodsHaveASurface)
{
  const std::vector<std::vector<Point>> shapes = { std::vector<Point>(50, Point{ 1, 1, 1 }),
    MakeBox(20, 1, 1), MakeBox(9, 9, 1), { { 0, 0, 0 }, { Spacing, 0, 0 } } };
  for (const std::vector<Point>& shape : shapes)
  {
    auto potential = MakePotential(shape);
    // Tests only the particle in the middle, because the surface is rounded at ends and corners.
    EXPECT_LT(ValueAt(potential, shape[shape.size() / 2]), 0.0) << shape.size() << " particles";
    for (const Point& x : shape)
    {
      const Point far = { x[0], x[1], x[2] + 3.0 * R };
      EXPECT_GT(ValueAt(potential, far), 0.0) << shape.size() << " particles";
      const Point gradient = GradientAt(potential, { x[0], x[1], x[2] + R });
      EXPECT_TRUE(std::isfinite(gradient[0] + gradient[1] + gradient[2]));
    }
  }
}

TEST(TestParticleModels, ParticlesWithoutStrengthAddNothing)
{
  SkeletonBuilder with, without;
  for (const Point& x : MakeCloud(5, 60, 0.8))
  {
    with.Add(x, Reach, 1.0);
    without.Add(x, Reach, 1.0);
  }
  for (const Point& x : MakeCloud(6, 20, 0.8))
  {
    with.Add(x, Reach, -1.0);
    with.Add(x, Reach, 0.0);
  }
  vtkNew<vtkSkeletonPotential> one;
  vtkNew<vtkSkeletonPotential> other;
  with.GiveTo(one);
  without.GiveTo(other);
  Choose(one);
  Choose(other);
  for (const Point& x : MakeCloud(7, 200, 0.8))
  {
    EXPECT_EQ(ValueAt(one, x), ValueAt(other, x));
  }
}

TEST(TestParticleModels, NothingAndNowhere)
{
  vtkNew<vtkSkeletonPotential> empty;
  Choose(empty);
  EXPECT_EQ(ValueAt(empty, { 0, 0, 0 }), 0.5);
  auto potential = MakePotential({ { 0, 0, 0 } });
  const Point far = { 1e3, 0, 0 };
  EXPECT_GT(ValueAt(potential, far), 0.0);
  EXPECT_EQ(GradientAt(potential, far)[0], 0.0);
  EXPECT_TRUE(std::isnan(ValueAt(potential, { std::nan(""), 0, 0 })));
}

TEST(TestParticleModels, PlacesBeyondSinglePrecisionAreRefused)
{
  const Point far = { 0.0, 2e9 * R, 0.0 };
  EXPECT_EQ(ValueAt(MakePotential({ { 0, 0, 0 } }), far), 0.5) << "a point, not a particle";
  auto potential = MakePotential({ { 0, 0, 0 }, far });
  MessageCapture messages(potential);
  EXPECT_EQ(ValueAt(potential, { 0, 0, 0 }), 0.5);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "10^9 times the smallest particle radius"), 1);
}

TEST(TestParticleModels, LinesAreRefused)
{
  SkeletonBuilder shape;
  shape.Join({ shape.Add({ 0, 0, 0 }), shape.Add({ 1, 0, 0 }) });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  Choose(potential);
  MessageCapture messages(potential);
  EXPECT_EQ(ValueAt(potential, { 0, 0, 0 }), 0.5);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "Lines need ParticleModel SUM"), 1);
}

TEST(TestParticleModels, OneIsRound)
{
  SkeletonBuilder shape;
  for (const Point& x : MakeBox(9, 9, 1))
  {
    shape.Add(x, 2.25 * Spacing, 1.0);
  }
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  potential->SetParticleModelToAnisotropic();
  potential->SetParticleSpacing(Spacing);
  const Point above = { 0.9, 0.9, 3.0 * R };
  const double flat = ValueAt(potential, above);
  potential->SetAnisotropy(1.0);
  EXPECT_LT(ValueAt(potential, above), flat) << "round kernels reach further across a sheet";
}

}
