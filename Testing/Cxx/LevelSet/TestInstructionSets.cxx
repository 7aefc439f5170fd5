// The terms of the evolution equation are bitwise identical with every instruction set. They are
// compiled here for several sets, as in the library, and compared on rows of random potentials.

#include "Base/Tension.h"
#include "Front/RowKernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>

using namespace activesurface;

namespace TestInstructionSets
{

using Row = std::array<float, 8>;

struct Scene
{
  LeafBlock Block;
  Row Speed;
  RowMask Relaxation;
};

ACTIVE_ALWAYS_INLINE void StepRow(const Scene& scene, Row& next)
{
  const float* u = scene.Block.Row(3, 4);
  std::copy_n(u, 8, next.begin());
  AddTransport(u, scene.Speed.data(), .37f, scene.Relaxation, next.data());
  AddTension<LeafBlock::X, LeafBlock::Y>(u, .21f, next.data());
  Row slopes;
  CentralGradientSquares(u, slopes.data());
  for (int z = 0; z < 8; ++z)
  {
    next[z] += slopes[z];
  }
}

void StepWithBaseline(const Scene& scene, Row& next)
{
  StepRow(scene, next);
}

#ifdef __x86_64__
__attribute__((target("avx2,fma"))) void StepWithAvx2(const Scene& scene, Row& next)
{
  StepRow(scene, next);
}

__attribute__((target("avx512f,avx512vl"))) void StepWithAvx512(const Scene& scene, Row& next)
{
  StepRow(scene, next);
}
#endif

// A distance with noise, flat spots (no gradient) and kinks, as they may occur in a band.
Scene MakeScene(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.f, seed % 4 == 0 ? 1.f : .05f);
  Scene scene;
  int node = 0;
  for (float& value : scene.Block.Value)
  {
    const float x = float(node / LeafBlock::X) - 5.5f;
    const float z = float(node % LeafBlock::Y) - 5.5f;
    value = seed % 3 == 0 ? std::round(noise(random)) : std::fabs(x) - .3f * z + noise(random);
    ++node;
  }
  for (int z = 0; z < 8; ++z)
  {
    scene.Speed[z] = noise(random);
    scene.Relaxation[z] = z % 3 ? .3f : 0.f;
  }
  return scene;
}

using Step = void (*)(const Scene&, Row&);

void CheckSameBytes(Step step, const std::string& name)
{
  int different = 0;
  for (unsigned seed = 0; seed < 3000; ++seed)
  {
    const Scene scene = MakeScene(seed);
    Row expected, actual;
    StepWithBaseline(scene, expected);
    step(scene, actual);
    different += std::memcmp(expected.data(), actual.data(), sizeof(Row)) != 0;
  }
  EXPECT_EQ(different, 0) << "rows of 3000 that differ from the baseline, " << name;
}

TEST(TestInstructionSets, EveryInstructionSetGivesTheSameBytes)
{
  Row row;
  StepWithBaseline(MakeScene(1), row);
  EXPECT_TRUE(std::isfinite(row[0])) << "the baseline gives numbers";
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    CheckSameBytes(StepWithAvx2, "AVX2");
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
  {
    CheckSameBytes(StepWithAvx512, "AVX-512");
  }
#endif
}

}
