// BoundedDomain over particles: a skin that is nearer to a wall than r rests flat on the wall.

#include "Support/PipelineTools.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkMassProperties.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestWalls
{

namespace
{

constexpr double Spacing = 0.1;
constexpr double R = 0.5 * Spacing;
constexpr double Voxel = R;
// Vertices of the skin keep a distance of 2^-13 voxel from nodes, on which the walls lie here.
constexpr double AtNode = 1.01 * Voxel / 8192.0;

using Cloud = std::function<std::vector<Particle>(double time)>;

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinInBox(const Cloud& cloud, int steps)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(cloud);
  std::vector<double> times;
  for (int i = 0; i < steps; ++i)
  {
    times.push_back(i);
  }
  source->SetSteps(times);
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetParticleSpacing(Spacing);
  filter->SetModelBounds(0.0, 1.0, 0.0, 1.0, 0.0, 1.0);
  filter->BoundedDomainOn();
  return filter;
}

// A pool 1 x 1 x 0.5 of jittered particles, which leaves between r - jitter and r + jitter to the
// walls at its bottom and sides.
std::vector<Particle> MakePool(double time)
{
  std::mt19937_64 generator(static_cast<unsigned>(time));
  std::uniform_real_distribution<double> jitter(-0.4 * R, 0.4 * R);
  std::vector<Particle> particles;
  for (int i = 0; i < 500; ++i)
  {
    const auto at = [&](int k) { return Spacing * (k + 0.5) + jitter(generator); };
    const double x = at(i % 10), y = at(i / 10 % 10), z = at(i / 100);
    particles.push_back({ x, y, z, i });
  }
  return particles;
}

// Distances to the nearest side of the box, for the points of the skin below a height. Points near
// an edge of the box are left out, because the skin is rounded there.
std::vector<double> FindGaps(vtkPolyData* skin, double below)
{
  std::vector<double> found;
  for (vtkIdType i = 0; i < skin->GetNumberOfPoints(); ++i)
  {
    double x[3];
    skin->GetPoint(i, x);
    std::array<double, 3> gaps = { std::min(x[0], 1.0 - x[0]), std::min(x[1], 1.0 - x[1]), x[2] };
    std::sort(gaps.begin(), gaps.end());
    if (x[2] < below && gaps[1] > Spacing)
    {
      found.push_back(gaps[0]);
    }
  }
  return found;
}

double GetVolume(vtkPolyData* skin)
{
  vtkNew<vtkMassProperties> measure;
  measure->SetInputData(skin);
  return measure->GetVolume();
}

// Heights of the skin's points under the middle of the block of MakeBlock, below a height.
std::vector<double> FindHeights(vtkPolyData* skin, double below)
{
  std::vector<double> found;
  for (vtkIdType i = 0; i < skin->GetNumberOfPoints(); ++i)
  {
    double x[3];
    skin->GetPoint(i, x);
    constexpr double middle = 0.5, half = 0.1;
    if (x[2] < below && std::max(std::fabs(x[0] - middle), std::fabs(x[1] - middle)) < half)
    {
      found.push_back(x[2]);
    }
  }
  return found;
}

// A block of 6 x 6 x 4 particles whose skin is at `gap` above the floor.
std::vector<Particle> MakeBlock(double gap)
{
  std::vector<Particle> particles;
  for (int i = 0; i < 144; ++i)
  {
    particles.push_back(
      { 0.25 + Spacing * (i % 6), 0.25 + Spacing * (i / 6 % 6), R + gap + Spacing * (i / 36), i });
  }
  return particles;
}

}

TEST(TestWalls, APoolRestsOnItsWallsFlat)
{
  auto filter = MakeSkinInBox(MakePool, 3);
  for (const double time : { 0.0, 1.0, 2.0 })
  {
    filter->UpdateTimeStep(time);
    const std::vector<double> gaps = FindGaps(filter->GetOutput(), 0.3);
    ASSERT_GT(gaps.size(), 300u);
    const auto onWall =
      std::count_if(gaps.begin(), gaps.end(), [](double gap) { return gap < AtNode; });
    EXPECT_GT(static_cast<double>(onWall), 0.98 * static_cast<double>(gaps.size())) << time;
    EXPECT_LT(*std::max_element(gaps.begin(), gaps.end()), 0.1 * Spacing) << time;
  }
}

// A wall may be anywhere between nodes.
TEST(TestWalls, ABlockRestsFlatOnAWallBetweenNodes)
{
  for (const double voxel : { R, 0.5 * R })
  {
    for (double gap = 0.1; gap < 0.85; gap += 0.1)
    {
      auto filter = MakeSkinInBox([](double) { return MakeBlock(1.0); }, 1);
      const double wall = 1.0 - gap * R;
      filter->SetModelBounds(-1.0, 2.0, -1.0, 2.0, wall, 3.0);
      filter->SetVoxelSize(voxel);
      filter->Update();
      const std::vector<double> heights = FindHeights(filter->GetOutput(), 1.2);
      ASSERT_GT(heights.size(), 10u);
      const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
      EXPECT_NEAR(*low, wall, 1e-3 * voxel) << "gap " << gap << " r, voxel " << voxel;
      EXPECT_NEAR(*high, wall, 0.05 * voxel) << "gap " << gap << " r, voxel " << voxel;
    }
  }
}

TEST(TestWalls, TheFreeSurfaceMeetsTheWallsAtItsHeight)
{
  auto filter = MakeSkinInBox(MakePool, 1);
  filter->Update();
  vtkPolyData* skin = filter->GetOutput();
  double sums[2] = {}, counts[2] = {};
  for (vtkIdType i = 0; i < skin->GetNumberOfPoints(); ++i)
  {
    double x[3];
    skin->GetPoint(i, x);
    const double gap = std::min({ x[0], 1.0 - x[0], x[1], 1.0 - x[1] });
    const int place = gap > 0.3 ? 0 : 1;
    if (x[2] > 0.4 && (gap > 0.3 || (gap > 0.5 * R && gap < 2.0 * R)))
    {
      sums[place] += x[2];
      counts[place] += 1.0;
    }
  }
  ASSERT_GT(counts[0], 20.0);
  ASSERT_GT(counts[1], 20.0);
  EXPECT_NEAR(sums[1] / counts[1], sums[0] / counts[0], 0.5 * R);
}

// The filled volume beneath the block grows to that of the widest filled gap, and then falls about
// twice as fast, without a jump.
TEST(TestWalls, ABlockComesToTheFloorWithoutAJump)
{
  constexpr int count = 21;
  constexpr double step = 0.1 * R, area = 0.6 * 0.6;
  constexpr double flat = (0.6 - 4.0 * R) * (0.6 - 4.0 * R); // without the rounded edges
  // Gaps up to r or two voxels, whichever is less, are filled.
  for (const auto& [voxel, filled] : { std::pair{ R, 8 }, { R / 3.0, 4 } })
  {
    std::vector<double> volumes;
    for (int i = 0; i < count; ++i)
    {
      auto filter = MakeSkinInBox([i](double) { return MakeBlock(step * i); }, 1);
      filter->SetVoxelSize(voxel);
      filter->Update();
      volumes.push_back(GetVolume(filter->GetOutput()));
    }
    const double free = volumes.back();
    for (int i = 1; i < count; ++i)
    {
      EXPECT_LT(std::fabs(volumes[i] - volumes[i - 1]), 3.5 * flat * step)
        << "gap " << 0.1 * i << " r, voxel " << voxel;
    }
    EXPECT_GT(volumes[filled] - free, flat * filled * step) << "a gap is filled, voxel " << voxel;
    EXPECT_NEAR(volumes[19], free, 0.02 * area * R) << "one of 1.9 r is not, voxel " << voxel;
  }
}

}
