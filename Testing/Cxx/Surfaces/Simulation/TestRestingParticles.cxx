// Particles of which some do not move: the skin over them is converged and costs little. The result
// is the same as if all particles were evaluated again.

#include "Support/PipelineTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestRestingParticles
{

namespace
{

// A static heap, and three particles that fall on it at different places, from step 1 to step 3.
std::vector<Particle> MakeHeap(double time)
{
  std::vector<Particle> particles;
  for (int i = 0; i < 5; ++i)
  {
    for (int j = 0; j < 5; ++j)
    {
      particles.push_back({ -0.8 + 0.15 * i, -0.4 + 0.15 * j, -0.6, 5 * i + j });
    }
  }
  const double fallen = 0.4 * std::min(std::max(time - 1.0, 0.0), 2.0);
  particles.push_back({ -0.55, -0.05, 0.4 - fallen, 100 });
  particles.push_back({ -0.75, -0.35, 0.6 - fallen, 101 });
  particles.push_back({ -0.25, 0.15, 0.3 - 0.5 * fallen, 102 });
  return particles;
}

// The heap with a larger number of other particles that fade in and out far from the skin. The
// change from one substep to the next is so large that everything counts as changed.
std::vector<Particle> MakeHeapAndOthers(double time)
{
  std::vector<Particle> particles = MakeHeap(time);
  const int step = static_cast<int>(time);
  for (int i = 0; i < (step > 0 ? 60 : 0); ++i) // none at the start: they would have a skin
  {
    particles.push_back({ 0.7, 0.7, 0.7, 1000 * (step + 1) + i });
  }
  return particles;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkin(const ParticleSource::Cloud& cloud)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(cloud);
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0 });
  auto skin = MakeSkinOver(source);
  skin->CreatePartsOff();
  return skin;
}

}

TEST(TestRestingParticles, SkinOverAHeapIsTheSameWhateverIsRemembered)
{
  auto skin = MakeSkin(MakeHeap);
  auto other = MakeSkin(MakeHeapAndOthers);
  for (int step = 1; step <= 6; ++step)
  {
    const std::string when = " at step " + std::to_string(step);
    EXPECT_TRUE(AreSameSkins(GetBytesAt(skin, step), GetBytesAt(other, step)))
      << "the same bytes" << when;
    const auto bounds = GetSkinBounds(skin);
    EXPECT_LT(bounds[4], -0.6) << "the heap is there" << when;
  }
  EXPECT_LT(skin->GetTargetEvaluations(), other->GetTargetEvaluations()) << "evaluations";
}

}
