// A particle that dies between two steps: its skin shrinks, and does not vanish suddenly.

#include "Support/PipelineTools.h"

#include "vtkMassProperties.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestDroplet
{

namespace
{

constexpr double Threshold = 0.5;
constexpr double Voxel = 0.025;
constexpr double Attraction = 20.0;
constexpr double Reach = 0.05;
constexpr double Support = 0.6;

// A ball at -0.5 that remains, and one at 0.5 that dies between the times 0 and 1.
vtkSmartPointer<vtkActiveImplicitSurface> MakeDroplet()
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(
    [](double t)
    {
      const Particle stays = { -0.5, 0.0, 0.0, 1 };
      const Particle dies = { 0.5, 0.0, 0.0, 2 };
      return t < 1.0 ? std::vector<Particle>{ dies, stays } : std::vector<Particle>{ stays };
    });
  source->SetSteps({ 0.0, 1.0, 2.0 });
  auto filter = MakeSkinOver(source);
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(Support);
  filter->SetVoxelSize(Voxel);
  filter->SetAttraction(Attraction);
  filter->SetTargetReach(Reach);
  filter->SetCFL(0.25);
  return filter;
}

// Radius of the isolated droplet's skin at a time: dr/dt = -Attraction * F / |dF/dr|, limited by
// the reach.
double GetDropletRadius(double time)
{
  constexpr int steps = 20000;
  double r = Support * std::sqrt(1.0 - std::cbrt(Threshold));
  for (int i = 0; i < steps && r > 0.0; ++i)
  {
    const double strength = 1.0 - i * time / steps;
    const double u = 1.0 - r * r / (Support * Support);
    const double value = Threshold - strength * u * u * u;
    const double slope = 6.0 * strength * u * u * r / (Support * Support);
    r -= time / steps * Attraction * std::max(-Reach, std::min(value / slope, Reach));
  }
  return std::max(r, 0.0);
}

double GetVolume(vtkActiveImplicitSurface* filter)
{
  vtkNew<vtkMassProperties> properties;
  properties->SetInputData(filter->GetOutput());
  return properties->GetVolume();
}

}

// The tolerance of 0.12 voxel is that of a moving ball in TestTracking.
TEST(TestDroplet, DyingDropletShrinksAsItsPotentialTells)
{
  auto filter = MakeDroplet();
  for (const double time : { 0.0, 0.1, 0.2, 0.3, 0.4, 0.5 })
  {
    filter->UpdateTimeStep(time);
    const double radius = GetDropletRadius(time);
    EXPECT_NEAR(GetSkinBounds(filter)[1] - 0.5, radius, 0.12 * Voxel) << "radius at " << time;
  }
}

// The skin is no faster than Attraction * Reach, so the volume decreases by at most a shell of this
// speed times the interval. The tolerance adds 0.1 voxel to the shell for the error of the volume,
// and a ball of 3 voxels' diameter, too small for the lattice. The volume of a ball with a radius
// of 11 voxels is accurate to 0.58 %.
TEST(TestDroplet, DyingDropletDoesNotPop)
{
  constexpr double dt = 0.05;
  auto filter = MakeDroplet();
  filter->UpdateTimeStep(0.0);
  const double ball = GetVolume(filter) / 2.0;
  double volume = 2.0 * ball;
  const double pi = std::acos(-1.0);
  const double lost = 4.0 / 3.0 * pi * std::pow(1.5 * Voxel, 3);
  for (int i = 1; i <= 20; ++i)
  {
    filter->UpdateTimeStep(i * dt);
    const double radius = std::cbrt(3.0 * std::max(volume - ball, 0.0) / (4.0 * pi));
    const double shell = 4.0 * pi * radius * radius * (Attraction * Reach * dt + 0.1 * Voxel);
    const double now = GetVolume(filter);
    const std::string when = " at " + std::to_string(i * dt);
    EXPECT_LT(now, volume + 1e-6 * ball) << "volume does not rise" << when;
    EXPECT_LT(volume - now, shell + lost) << "volume does not jump" << when;
    volume = now;
  }
  EXPECT_NEAR(volume / ball, 1.0, 5.8e-3) << "only the other ball is left when it has died";
}

}
