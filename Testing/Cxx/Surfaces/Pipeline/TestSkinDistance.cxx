// SkinDistance: the side of the skin on which a point lies, and its distance.

#include "Support/SurfaceMeasures.h"

#include "Pipeline/SkinFunction.h"
#include "Surface/SkinDistance.h"

#include "vtkCellArray.h"
#include "vtkGridPotential.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelectEnclosedPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <vector>

using namespace activesurface;

namespace TestSkinDistance
{

namespace
{
constexpr double H = VoxelSizeOf(48);

Motion Attracted(double attraction)
{
  Motion motion;
  motion.Attraction = attraction;
  return motion;
}

// A ball attracted outward: the potential is compressed, with slopes above 1.
std::unique_ptr<NarrowBand> MakeGrownBall()
{
  auto band = std::make_unique<NarrowBand>(H);
  StartOn(*band, MakeAlgebraicBall(CentreA, 0.4));
  ShapeTarget target(MakeAlgebraicBall(CentreA, 0.7));
  band->Advance(0.6, Attracted(3.0), target);
  return band;
}

// A ball that shrinks by tension from r0 = 0.7 to r = 0.55. Tension does not correct slopes: the
// slope is r / r0.
std::unique_ptr<NarrowBand> MakeShrunkBall()
{
  auto band = std::make_unique<NarrowBand>(H);
  StartOn(*band, MakeBall(CentreA, 0.7));
  ShapeTarget target(MakeConstant(0.0));
  Motion motion = Attracted(0.0);
  motion.Tension = 1.0;
  band->Advance((0.49 - 0.3025) / 4.0, motion, target);
  return band;
}

std::unique_ptr<NarrowBand> MakeMetaballBand()
{
  auto band = std::make_unique<NarrowBand>(H);
  StartOn(*band, MakeBall(CentreA, 0.6));
  ShapeTarget target(Normalise(MakeSixMetaballs(), 0.3));
  band->Advance(0.5, Attracted(4.0), target);
  return band;
}

std::vector<Point> RandomPoints(std::size_t count, double side, unsigned seed)
{
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> number(-side, side);
  std::vector<Point> points(count);
  for (Point& point : points)
  {
    point = { number(generator), number(generator), number(generator) };
  }
  return points;
}

double DistanceFrom(const Point& centre, const Point& x)
{
  return std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]);
}

vtkSmartPointer<vtkPolyData> MakePolyData(const Mesh& mesh)
{
  vtkNew<vtkPoints> points;
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(mesh.GetPoint(i).data());
  }
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < mesh.Corners.size(); i += 3)
  {
    const vtkIdType corners[3] = { mesh.Corners[i], mesh.Corners[i + 1], mesh.Corners[i + 2] };
    triangles->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}
}

// u / |grad u| is wrong by d^2 / 2 times the relative change of the slope. That is 1 / r for the
// algebraic ball and 1 / r - r / r0^2 after tension, so 0.032 h and 0.015 h at d = h. Interpolation
// adds h^2 / 4r = 0.02 h, and the skin half of the spread of its measured radii.
namespace
{
void CheckDistance(const NarrowBand& band, double slope)
{
  const Range radii = GetRadii(Polygonise(band), CentreA);
  EXPECT_NEAR(GetSlopes(band).Mean, slope, 0.02) << "mean slope of the potential";
  const SkinDistance skin(band);
  double largest = 0.0, sum = 0.0;
  int near = 0;
  for (const Point& x : RandomPoints(100000, 1.0, 1))
  {
    const double exact = DistanceFrom(CentreA, x) - radii.Mean;
    if (std::fabs(exact) < H)
    {
      const double error = std::fabs(skin.Evaluate(x.data(), nullptr) - exact) / H;
      largest = std::max(largest, error);
      sum += error;
      ++near;
    }
  }
  EXPECT_GT(near, 1000) << "points within a voxel";
  EXPECT_LT(largest, 0.055 + 0.5 * radii.GetSpread() / H) << "largest error [h]";
  EXPECT_LT(sum / near, 0.02) << "mean error [h]";
}
}

TEST(TestSkinDistance, BallsHaveTheirDistance)
{
  CheckDistance(*MakeGrownBall(), 1.02);
  CheckDistance(*MakeShrunkBall(), 0.55 / 0.7);
}

// A triangle deviates from the trilinear surface by about h^2 / 8 times the curvature. So only
// points next to the surface may be on different sides.
TEST(TestSkinDistance, SidesAreThoseOfTheMesh)
{
  auto band = MakeMetaballBand();
  const Mesh mesh = Polygonise(*band);
  const SkinDistance skin(*band);
  const std::vector<Point> points = RandomPoints(100000, 1.0, 2);
  vtkNew<vtkSelectEnclosedPoints> enclosed;
  enclosed->Initialize(MakePolyData(mesh));
  int inside = 0, different = 0;
  double farthest = 0.0;
  for (Point x : points)
  {
    const double distance = skin.Evaluate(x.data(), nullptr);
    const bool isInside = enclosed->IsInsideSurface(x.data()) != 0;
    inside += isInside ? 1 : 0;
    if (isInside != (distance < 0.0))
    {
      ++different;
      farthest = std::max(farthest, std::fabs(distance) / H);
    }
  }
  EXPECT_GT(inside, 2000) << "points inside";
  EXPECT_LT(farthest, 0.1) << "distance of the farthest one that differs [h]";
  const double share = 0.2 * H * GetArea(mesh) / 8.0; // fraction of the box
  EXPECT_LT(different / 1e5, 0.25 * share) << "share of those that differ";
}

// The distance is 0 at the vertices, up to their rounding to single precision, 6e-8 or 1.4e-6 h.
TEST(TestSkinDistance, VerticesOfTheSkinAreAtZero)
{
  auto band = MakeMetaballBand();
  const Mesh mesh = Polygonise(*band);
  const SkinDistance skin(*band);
  double largest = 0.0;
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, std::fabs(skin.Evaluate(mesh.GetPoint(i).data(), nullptr)) / H);
  }
  EXPECT_LT(largest, 1e-5) << "largest distance of a vertex [h]";
}

// Points lie in the interior of voxels, where the value is smooth. A central difference is off by
// step^2 / 6 times the third derivative, which is at most about 1e3 / h^2.
TEST(TestSkinDistance, GradientIsThatOfTheValue)
{
  auto band = MakeMetaballBand();
  const SkinDistance skin(*band);
  const double step = 1e-4 * H;
  int compared = 0;
  for (const Point& at : RandomPoints(20000, 1.0, 3))
  {
    Point x, gradient;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double place = std::floor(at[axis] / H);
      x[axis] = H * (place + std::min(std::max(at[axis] / H - place, 0.001), 0.999));
    }
    const double value = skin.Evaluate(x.data(), gradient.data());
    if (std::fabs(value) > 2.5 * H)
    {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      Point low = x, high = x;
      low[axis] -= step;
      high[axis] += step;
      const double rise = skin.Evaluate(high.data(), nullptr) - skin.Evaluate(low.data(), nullptr);
      EXPECT_NEAR(gradient[axis], rise / (high[axis] - low[axis]), 1e-5) << "gradient";
      ++compared;
    }
  }
  EXPECT_GT(compared, 3000) << "compared";
}

TEST(TestSkinDistance, DeepInsideAndFarOutsideAreClamped)
{
  NarrowBand band(VoxelSizeOf(128));
  StartOn(band, MakeBall(CentreA, 0.8));
  const SkinDistance skin(band);
  const double three = 3.0 * VoxelSizeOf(128);
  const auto expect = [&](const Point& x, double value)
  {
    Point gradient = { 1.0, 1.0, 1.0 };
    EXPECT_NEAR(skin.Evaluate(x.data(), gradient.data()), value, 1e-15) << "value";
    EXPECT_TRUE((gradient == Point{ 0.0, 0.0, 0.0 })) << "no gradient";
  };
  for (const Point& x : RandomPoints(20000, 1.5, 4))
  {
    const double distance = DistanceFrom(CentreA, x) - 0.8;
    if (std::fabs(distance) > 2.0 * three)
    {
      expect(x, std::copysign(three, distance));
    }
  }
  expect(CentreA, -three);
  expect({ 1e9, 0.0, 0.0 }, three);
  expect({ 0.0, -1e300, 1e300 }, three);
  double bounds[6];
  EXPECT_TRUE(skin.GetBounds(bounds)) << "bounds";
  for (int i = 0; i < 6; ++i)
  {
    const double end = CentreA[i / 2] + (i % 2 == 0 ? -0.8 : 0.8);
    EXPECT_NEAR(bounds[i], end, VoxelSizeOf(128)) << "bound " << i;
    EXPECT_TRUE(i % 2 == 0 ? bounds[i] <= end : bounds[i] >= end) << "holds the ball";
  }
}

TEST(TestSkinDistance, PlacesThatAreNotFiniteGiveNaN)
{
  auto band = MakeGrownBall();
  const SkinDistance skin(*band);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { std::nan(""), infinity, -infinity })
  {
    Point gradient;
    const Point x = { 0.0, bad, 0.0 };
    EXPECT_TRUE(std::isnan(skin.Evaluate(x.data(), gradient.data()))) << "value";
    EXPECT_TRUE(std::isnan(gradient[0])) << "gradient";
  }
}

TEST(TestSkinDistance, NoSkinIsOutsideEverywhere)
{
  NarrowBand band(H);
  const SkinDistance never(band);
  StartOn(band, MakeBall(CentreA, 0.2));
  ShapeTarget target(MakeConstant(1.0));
  EXPECT_TRUE(band.Advance(1.0, Attracted(1.0), target).Vanished) << "a ball that vanishes";
  const SkinDistance vanished(band);
  for (const SkinDistance* skin : { &never, &vanished })
  {
    double bounds[6] = { 7.0 };
    Point gradient = { 1.0, 1.0, 1.0 };
    EXPECT_EQ(skin->Evaluate(CentreA.data(), gradient.data()), 3.0 * H) << "value";
    EXPECT_TRUE((gradient == Point{ 0.0, 0.0, 0.0 })) << "no gradient";
    EXPECT_TRUE(!skin->GetBounds(bounds) && bounds[0] == 7.0) << "no bounds";
  }
}

TEST(TestSkinDistance, SnapshotKeepsItsBytes)
{
  auto band = MakeGrownBall();
  const auto skin = std::make_shared<const SkinDistance>(*band);
  const std::vector<Point> points = RandomPoints(20000, 1.0, 5);
  const auto sample = [&points](const std::function<double(Point)>& function)
  {
    std::vector<double> values;
    for (const Point& x : points)
    {
      values.push_back(function(x));
    }
    return values;
  };
  const auto values = sample([&](Point x) { return skin->Evaluate(x.data(), nullptr); });
  ShapeTarget target(MakeConstant(1.0));
  band->Advance(0.7, Attracted(1.0), target);
  band.reset();
  vtkNew<vtkGridPotential> potential;
  potential->SetSamples(std::make_shared<SkinSamples>(skin, std::array<double, 3>{}));
  std::vector<std::vector<double>> byThread(4);
  std::vector<std::thread> threads;
  for (auto& own : byThread)
  {
    threads.emplace_back(
      [&] { own = sample([&](Point x) { return potential->EvaluateFunction(x.data()); }); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const auto& own : byThread)
  {
    EXPECT_TRUE(std::memcmp(own.data(), values.data(), 8 * values.size()) == 0) << "the same bytes";
  }
  double bounds[6];
  EXPECT_TRUE(potential->GetGridBounds(bounds) && bounds[1] > 0.6) << "bounds";
}

}
