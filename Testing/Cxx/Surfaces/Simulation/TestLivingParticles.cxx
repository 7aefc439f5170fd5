// Automatic behaviour over particles: sizes and attraction, Transport, creation of parts, weighted
// tension, and messages.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/SameSkins.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkDataObject.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestLivingParticles
{

namespace
{

constexpr double Spacing = 0.2;
constexpr double R = 0.5 * Spacing;

vtkSmartPointer<ParticleSource> MakeSource(const ParticleSource::Cloud& cloud)
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(cloud);
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0 });
  return source;
}

// Only the ids and the spacing are set.
vtkSmartPointer<vtkActiveImplicitSurface> MakePlainSkin(const ParticleSource::Cloud& cloud)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(MakeSource(cloud)->GetOutputPort());
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetParticleSpacing(Spacing);
  return filter;
}

// A block of 4 x 4 x 4 particles that starts at x.
std::vector<Particle> MakeBlock(double x)
{
  std::vector<Particle> particles;
  for (int i = 0; i < 64; ++i)
  {
    particles.push_back({ x + Spacing * (i % 4), Spacing * (i / 4 % 4), Spacing * (i / 16), i });
  }
  return particles;
}

std::vector<Particle> MakeMovingBlock(double time)
{
  return MakeBlock(0.3 * time);
}

int CountIn(vtkActiveImplicitSurface* filter, double time, const char* column)
{
  filter->UpdateTimeStep(time);
  vtkTable* history = filter->GetHistory();
  return history->GetValueByName(history->GetNumberOfRows() - 1, column).ToInt();
}

int CountParts(vtkActiveImplicitSurface* filter, double time)
{
  return CountIn(filter, time, "Components");
}

// A block of 14 x 14 x 14 particles around 0, displaced by a ball in its middle as by a bubble in
// water.
std::vector<Particle> MakeBlockAround(double radius)
{
  constexpr int side = 14;
  std::vector<Particle> particles;
  for (int i = 0; i < side * side * side; ++i)
  {
    const double x[3] = { Spacing * (i % side - 6.5), Spacing * (i / side % side - 6.5),
      Spacing * (i / (side * side) - 6.5) };
    const double distance = std::hypot(x[0], x[1], x[2]);
    const double factor = std::cbrt(1.0 + std::pow(radius / distance, 3.0));
    particles.push_back({ factor * x[0], factor * x[1], factor * x[2], i });
  }
  return particles;
}

}

TEST(TestLivingParticles, SpacingGivesVoxelAndReach)
{
  auto plain = MakePlainSkin(MakeMovingBlock);
  auto set = MakePlainSkin(MakeMovingBlock);
  set->SetVoxelSize(R);
  set->SetTargetReach(6.0 * R);
  set->SetKernelRadius(2.25 * Spacing);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 1.0), GetBytesAt(set, 1.0)));
}

TEST(TestLivingParticles, AutomaticAttractionIsSixFromStepToStep)
{
  auto plain = MakePlainSkin(MakeMovingBlock);
  auto set = MakePlainSkin(MakeMovingBlock);
  set->SetAttraction(6.0); // for steps that are 1 apart
  EXPECT_TRUE(AreSameSkins(GetBytesAt(plain, 2.0), GetBytesAt(set, 2.0)));
  set->SetAttraction(1.0);
  EXPECT_FALSE(AreSameSkins(GetBytesAt(plain, 2.0), GetBytesAt(set, 2.0))) << "1 is 1";
}

// Without Transport the skin has three time constants for the three voxels of each step, so it lags
// by 3 / (e^3 - 1) = 0.16 voxel.
TEST(TestLivingParticles, TransportTakesTheLagAway)
{
  auto filter = MakePlainSkin(MakeMovingBlock);
  filter->SetAttraction(3.0);
  filter->SetTension(0.0);
  filter->SetTargetNoise(0.0); // within it the skin follows slowly
  const auto lagAt = [&](double time)
  {
    filter->UpdateTimeStep(time);
    const auto bounds = GetSkinBounds(filter);
    return 0.3 * time + 1.5 * Spacing - 0.5 * (bounds[0] + bounds[1]);
  };
  EXPECT_LT(std::fabs(lagAt(3.0)), 0.05 * R) << "in voxels .05";
  filter->SetTransport(0.0);
  EXPECT_GT(lagAt(3.0), 0.15 * R);
}

TEST(TestLivingParticles, ParticleThatAppearsAwayGetsASkinOfItsOwn)
{
  const auto appearing = [](double time)
  {
    std::vector<Particle> particles = MakeBlock(0.0);
    if (time > 0.5)
    {
      particles.push_back({ 30.0, 0.0, 0.0, 100 });
    }
    return particles;
  };
  auto filter = MakePlainSkin(appearing);
  EXPECT_EQ(CountParts(filter, 0.0), 1);
  EXPECT_EQ(CountParts(filter, 1.0), 2) << "in the step in which it comes";
  // The ball of an isolated particle is enlarged by 15.5 %, see FindLossOfBall.
  EXPECT_NEAR(GetSkinBounds(filter)[1], 30.0 + 1.155 * R, 0.1 * R);
  filter->CreatePartsOff();
  EXPECT_EQ(CountParts(filter, 1.0), 1) << "without CreateParts";
}

// A bubble of radius 0, 6, 7 and 5 r.
TEST(TestLivingParticles, HollowThatParticlesMakeOpens)
{
  const auto breathing = [](double time)
  {
    const double radii[] = { 0.0, 6.0, 7.0, 5.0 };
    return MakeBlockAround(R * radii[static_cast<int>(time)]);
  };
  for (const int model : { vtkActiveImplicitSurface::SUM, vtkActiveImplicitSurface::ANISOTROPIC })
  {
    SCOPED_TRACE(model);
    auto filter = MakePlainSkin(breathing);
    filter->SetParticleModel(model);
    EXPECT_EQ(CountIn(filter, 0.0, "Voids"), 0);
    for (const double time : { 1.0, 2.0, 3.0 })
    {
      EXPECT_EQ(CountIn(filter, time, "Voids"), 1);
      auto fresh = MakePlainSkin([&](double) { return breathing(time); });
      fresh->SetParticleModel(model);
      EXPECT_EQ(CountIn(fresh, 0.0, "Voids"), 1) << "which starts with it";
      EXPECT_NEAR(GetRadii(filter).Least, GetRadii(fresh).Least, R) << "a voxel";
    }
    filter->CreatePartsOff();
    EXPECT_EQ(CountIn(filter, 2.0, "Voids"), 0) << "without CreateParts";
  }
}

TEST(TestLivingParticles, FirstStepMayBeEmpty)
{
  const auto coming = [](double time)
  { return time > 0.5 ? MakeBlock(0.0) : std::vector<Particle>(); };
  auto filter = MakePlainSkin(coming);
  MessageCapture messages(filter);
  EXPECT_EQ(CountParts(filter, 0.0), 0);
  EXPECT_EQ(CountParts(filter, 1.0), 1);
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
  auto whole = MakePlainSkin([](double) { return MakeBlock(0.0); });
  whole->UpdateTimeStep(2.0);
  filter->UpdateTimeStep(2.0);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(GetSkinBounds(filter)[i], GetSkinBounds(whole)[i], 0.05 * R) << "side " << i;
  }
}

TEST(TestLivingParticles, StepsWithParticlesTellTheSizeOfAnEmptyFirstOne)
{
  const auto coming = [](double time)
  { return time > 0.5 ? MakeBlock(0.0) : std::vector<Particle>(); };
  auto filter = MakePlainSkin(coming);
  filter->SetParticleSpacing(-1.0);
  EXPECT_EQ(CountParts(filter, 0.0), 0);
  EXPECT_EQ(CountParts(filter, 1.0), 1);
}

TEST(TestLivingParticles, NothingAtAnyStepIsTold)
{
  auto filter = MakePlainSkin([](double) { return std::vector<Particle>(); });
  filter->SetParticleSpacing(-1.0);
  MessageCapture messages(filter);
  EXPECT_EQ(CountParts(filter, 0.0), 0);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "follow from the first particles"), 1);
  EXPECT_EQ(messages.CountAll(), 1u);
}

TEST(TestLivingParticles, SkinThatHasVanishedComesBackWithParticles)
{
  const auto leaving = [](double time)
  { return time > 0.5 && time < 2.5 ? std::vector<Particle>() : MakeBlock(0.0); };
  auto filter = MakePlainSkin(leaving);
  MessageCapture messages(filter);
  EXPECT_EQ(CountParts(filter, 2.0), 0);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "it reappears where the target does"), 1);
  EXPECT_EQ(CountParts(filter, 3.0), 1);
  EXPECT_EQ(messages.CountAll(), 1u);
}

// Tension / Attraction = r^2 removes balls with a radius below 2.83 r in the limit of many steps.
// The ball of an isolated particle is smaller.
TEST(TestLivingParticles, TensionSparesDrops)
{
  const auto withDrop = [](double)
  {
    std::vector<Particle> particles = MakeBlock(0.0);
    particles.push_back({ 2.0, 0.0, 0.0, 100 });
    return particles;
  };
  auto filter = MakePlainSkin(withDrop);
  filter->SetAttraction(6.0);
  filter->SetTension(6.0 * R * R);
  EXPECT_EQ(CountParts(filter, 3.0), 2);
  const double spared = GetSkinBounds(filter)[1] - 2.0;
  EXPECT_GT(spared, 0.8 * R) << "radius of the drop";
  filter->TensionWeightingOff();
  filter->UpdateTimeStep(3.0);
  EXPECT_LT(GetSkinBounds(filter)[1] - 2.0, 0.9 * spared);
}

}
