// TargetNoise: the skin follows slowly within this distance of the target. The automatic value over
// particles is r / 2.

#include "Support/PipelineTools.h"
#include "Support/SameSkins.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStaticCellLocator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestTargetNoise
{

namespace
{

constexpr double Rate = 10.0;
constexpr double Voxel = 0.05;

// Mean radius at a time of a ball that moves from one radius to another.
double GetRadiusAt(double time, double from, double to, double noise)
{
  vtkNew<vtkSphere> start, target;
  start->SetRadius(from);
  target->SetRadius(to);
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetModelBounds(-1, 1, -1, 1, -1, 1);
  filter->SetVoxelSize(Voxel);
  filter->SetInitialFunction(start);
  filter->SetTargetFunction(target);
  filter->SetTargetReach(1.0);
  filter->SetAttraction(Rate);
  filter->SetTargetNoise(noise);
  filter->UpdateTimeStep(time);
  double sum = 0.0;
  vtkPolyData* skin = filter->GetOutput();
  for (vtkIdType i = 0; i < skin->GetNumberOfPoints(); ++i)
  {
    double x[3];
    skin->GetPoint(i, x);
    sum += std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  }
  return sum / static_cast<double>(skin->GetNumberOfPoints());
}

constexpr double Spacing = 0.1;
constexpr double R = 0.5 * Spacing;
constexpr int Frames = 14;

// 12 x 12 x 4 particles, each with a jitter that is new in each step; its standard deviation is a
// tenth of r.
std::vector<Particle> MakePool(double time)
{
  std::mt19937_64 generator(static_cast<unsigned>(time));
  std::normal_distribution<double> jitter(0.0, 0.1 * R);
  std::vector<Particle> particles;
  for (int i = 0; i < 576; ++i)
  {
    const double shift = i / 144 % 2 == 0 ? 0.0 : 0.5;
    particles.push_back({ Spacing * (i % 12 + shift) + jitter(generator),
      Spacing * (i / 12 % 12 + shift) + jitter(generator), Spacing * (i / 144) + jitter(generator),
      i });
  }
  return particles;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOfPool()
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MakePool);
  std::vector<double> steps;
  for (int frame = 0; frame < Frames; ++frame)
  {
    steps.push_back(frame);
  }
  source->SetSteps(steps);
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetParticleSpacing(Spacing);
  return filter;
}

std::vector<double> MeasureHeights(vtkPolyData* skin)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(skin);
  locator->BuildLocator();
  std::vector<double> heights;
  for (int i = 0; i < 64; ++i)
  {
    const double x = 0.4 + 0.05 * (i % 8), y = 0.4 + 0.05 * (i / 8);
    const double above[3] = { x, y, 1.0 }, below[3] = { x, y, 0.15 };
    double t, hit[3], coordinates[3];
    int part;
    EXPECT_TRUE(locator->IntersectWithLine(above, below, 0.0, t, hit, coordinates, part));
    heights.push_back(hit[2]);
  }
  return heights;
}

// Root mean squares of the second difference in time, and in space at the end.
struct Unrest
{
  double InTime = 0.0;
  double InSpace = 0.0;
};

Unrest Measure(vtkActiveImplicitSurface* filter)
{
  std::vector<std::vector<double>> rows;
  for (int frame = 0; frame < Frames; ++frame)
  {
    filter->UpdateTimeStep(frame);
    rows.push_back(MeasureHeights(filter->GetOutput()));
  }
  const auto root = [](double sum, int count) { return std::sqrt(sum / count); };
  double time = 0.0, space = 0.0;
  int times = 0, spaces = 0;
  for (int frame = 4; frame + 1 < Frames; ++frame)
  {
    for (int i = 0; i < 64; ++i, ++times)
    {
      const double d = rows[frame - 1][i] - 2.0 * rows[frame][i] + rows[frame + 1][i];
      time += d * d;
    }
  }
  for (int i = 0; i < 64; ++i)
  {
    if (i % 8 > 0 && i % 8 < 7)
    {
      const std::vector<double>& last = rows.back();
      const double d = last[i - 1] - 2.0 * last[i] + last[i + 1];
      space += d * d;
      ++spaces;
    }
  }
  return { root(time, times), root(space, spaces) };
}

}

// d' = -0.03 Attraction d if d is small compared with the noise. At a fifth of the noise the rate
// is larger by 0.16 % of Attraction. The tolerance includes the error of a radius, 0.02 voxel.
TEST(TestTargetNoise, NearTheTargetTheSkinFollowsSlowly)
{
  const double to = 0.5, away = 0.04, noise = 0.2, time = 1.0;
  const double slow = away * std::exp(-0.03 * Rate * time);
  for (const double sign : { 1.0, -1.0 })
  {
    const double left = sign * (GetRadiusAt(time, to + sign * away, to, noise) - to);
    EXPECT_NEAR(left, slow, 0.02 * Voxel + 0.016 * slow);
    const double none = sign * (GetRadiusAt(time, to + sign * away, to, 0.0) - to);
    EXPECT_LT(std::fabs(none), 0.02 * Voxel) << "e^-10 without noise";
  }
}

// Beyond three times the noise the rate is Attraction, to a hundredth.
TEST(TestTargetNoise, FarFromTheTargetItMakesNoDifference)
{
  const double from = 0.3, to = 0.8, noise = 0.05, time = 0.12;
  EXPECT_NEAR(GetRadiusAt(time, from, to, noise), GetRadiusAt(time, from, to, 0.0), 0.05 * Voxel);
  const double left = to - GetRadiusAt(1.0, from, to, noise);
  EXPECT_LT(left, noise) << "is soon within it";
  EXPECT_GT(left, 0.25 * noise);
}

TEST(TestTargetNoise, AutomaticNoiseAndTensionAreOfTheSpacing)
{
  auto plain = MakeSkinOfPool();
  auto set = MakeSkinOfPool();
  set->SetTargetNoise(0.5 * R);
  set->SetAttraction(6.0); // from step to step
  set->SetTension(6.0 / 2.0 * R * R);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 3.0), GetBytesAt(set, 3.0)));
  set->SetTension(0.0);
  EXPECT_FALSE(AreSameSkins(GetBytesAt(plain, 3.0), GetBytesAt(set, 3.0)));
}

// A pool whose particles only jitter.
TEST(TestTargetNoise, TheSkinOfAPoolStandsStillAndIsFlat)
{
  auto smooth = MakeSkinOfPool();
  auto rough = MakeSkinOfPool();
  rough->SetTension(0.0);
  rough->SetTargetNoise(0.0);
  const Unrest with = Measure(smooth), without = Measure(rough);
  EXPECT_GT(without.InTime, 0.02 * R) << "the particles' own surface flickers";
  EXPECT_LT(with.InTime, without.InTime / 3.0);
  EXPECT_LT(with.InSpace, without.InSpace / 2.0);
}

}
