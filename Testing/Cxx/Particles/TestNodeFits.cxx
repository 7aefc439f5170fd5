// Fits of particles, for eight at once in single precision, compared with those of all pairs in
// double precision.

#include "Support/FitsOfDoubles.h"
#include "Support/ParticlesAtRest.h"
#include "Support/SkeletonShapes.h"

#include "Nodes/LaneMatrix.h"
#include "ParticlePotential.h"
#include "vtkMath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace activesurface;

namespace TestNodeFits
{

namespace
{
constexpr double Voxel = 0.1;
constexpr double R = 0.1; // a particle's own radius
constexpr double Reach = 4.5 * R;

// A cube of `side` particles along each axis, as in a fluid: each is displaced by up to a quarter
// of the spacing.
std::vector<SkeletonVertex> MakeBlock(int side)
{
  Random random(5);
  std::vector<SkeletonVertex> particles;
  for (int n = 0; n < side * side * side; ++n)
  {
    SkeletonVertex particle;
    const int at[3] = { n / side / side, n / side % side, n % side };
    for (int axis = 0; axis < 3; ++axis)
    {
      particle.Position[axis] = 2.0 * R * (at[axis] + random.Between(-0.25, 0.25));
    }
    particle.Radius = Reach;
    particle.Strength = 1.0;
    particles.push_back(particle);
  }
  return particles;
}

void Build(const std::vector<SkeletonVertex>& particles, ParticleNodes& nodes)
{
  NodeParticleOptions options;
  options.VoxelSize = Voxel;
  options.OwnRadius = R;
  nodes.Build(ParticlesAtRest(particles), options);
}

}

TEST(TestNodeFits, EigenvaluesAreThoseOfDoubles)
{
  Random random(2);
  for (int n = 0; n < 200; ++n)
  {
    LaneMatrix lanes;
    double rows[8][3][3];
    for (int lane = 0; lane < 8; ++lane)
    {
      for (int i = 0; i < 3; ++i)
      {
        for (int k = i; k < 3; ++k)
        {
          // Some matrices have a row of zeros, as for a sheet; some have a triple eigenvalue.
          const bool isZero = lane == 1 && k == 2;
          const double entry = isZero ? 0.0 : lane == 2 ? (i == k) : random.Between(-1.0, 1.0);
          rows[lane][i][k] = rows[lane][k][i] = entry;
          lanes.Of(i, k)[lane] = static_cast<float>(entry);
        }
      }
    }
    const LaneEigen found(lanes);
    for (int lane = 0; lane < 8; ++lane)
    {
      double *matrix[3] = { rows[lane][0], rows[lane][1], rows[lane][2] }, values[3], frame[3][3];
      double* vectors[3] = { frame[0], frame[1], frame[2] };
      vtkMath::Jacobi(matrix, values, vectors);
      for (int i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(found.Value[i][lane], values[i], 2e-6) << "lane " << lane;
      }
    }
  }
}

TEST(TestNodeFits, CubeRootsAreThoseOfDoubles)
{
  for (float x = 1e-20f; x < 1e20f; x *= 1.37f)
  {
    const Lanes root = InverseCubeRoot(AllLanes(x));
    EXPECT_NEAR(root[3] * std::cbrt(static_cast<double>(x)), 1.0, 1e-6) << x;
  }
}

namespace
{

// Visits a third of the nodes of a block's shell that are no deeper than the band around its skin.
template <class Visit>
void ForEachNode(int side, const std::vector<SkeletonVertex>& particles, Visit&& visit)
{
  ParticleNodes nodes;
  Build(particles, nodes);
  Shell shell;
  nodes.FindShell(false, shell);
  const double last = 2.0 * R * (side - 1);
  // Three and a half voxels below the skin, which lies R outside the outermost particles.
  constexpr double deep = 3.5 * Voxel - R;
  for (const ShellLeaf& leaf : shell.Leaves)
  {
    float values[512];
    nodes.EvaluateLeaf(leaf, values);
    for (int n = 0; n < 512; n += 3)
    {
      const Point x = { Voxel * (leaf.Origin[0] + (n >> 6)),
        Voxel * (leaf.Origin[1] + (n >> 3 & 7)), Voxel * (leaf.Origin[2] + (n & 7)) };
      const bool isDeep = std::all_of(
        x.begin(), x.end(), [&](double place) { return place > deep && place < last - deep; });
      if (((leaf.Rows >> (n >> 3)) & 1) && !isDeep)
      {
        visit(values[n], x);
      }
    }
  }
}

double ToNodes(double sum)
{
  return 1.0 - std::sqrt(std::sqrt(sum));
}

}

TEST(TestNodeFits, ABlockHasTheSumsOfDoubles)
{
  constexpr int side = 12;
  const std::vector<SkeletonVertex> particles = MakeBlock(side);
  std::vector<Point> places;
  for (const SkeletonVertex& particle : particles)
  {
    places.push_back({ particle.Position[0], particle.Position[1], particle.Position[2] });
  }
  const FitsOfDoubles reference(places, R, Reach, 0.155 * Voxel);
  int compared = 0;
  ForEachNode(side, particles,
    [&](float value, const Point& x)
    {
      const double sum = reference.SumAt(x);
      if (sum > 0.05 && sum < 8.0)
      {
        EXPECT_NEAR(value, ToNodes(sum), 1e-4) << sum;
        ++compared;
      }
    });
  EXPECT_GT(compared, 1000);
}

// Particles deep in a body have no fits: none of their kernels reaches the band around the skin.
TEST(TestNodeFits, ParticlesDeepInABodyAreNotMissed)
{
  constexpr int side = 24;
  const std::vector<SkeletonVertex> particles = MakeBlock(side);
  ParticlePotential everywhere;
  NodeParticleOptions options;
  options.OwnRadius = R;
  everywhere.Build(particles, options);
  // Compares at the faces. Near edges and corners, only the fits for nodes enlarge balls to
  // compensate for their triangles.
  constexpr double last = 2.0 * R * (side - 1), margin = 13.0 * R;
  double largest = 0.0;
  ForEachNode(side, particles,
    [&](float value, const Point& x)
    {
      const auto within = std::count_if(
        x.begin(), x.end(), [&](double place) { return place > margin && place < last - margin; });
      double found = 0.0;
      everywhere.Evaluate(1, x.data(), &found, nullptr);
      if (within >= 2)
      {
        largest = std::max(largest, std::fabs(value - ToNodes(1.0 - 2.0 * found)));
      }
    });
  EXPECT_LT(largest, 1e-4);
}

TEST(TestNodeFits, OneParticleIsABallAroundIt)
{
  for (const double strength : { 1.0, 0.5 })
  {
    std::vector<SkeletonVertex> one = MakeBlock(1);
    one[0].Strength = strength;
    ParticleNodes nodes;
    Build(one, nodes);
    Shell shell;
    nodes.FindShell(false, shell);
    ASSERT_FALSE(shell.Leaves.empty());
    // Lengths are in voxels. The radius of a lone ball is own + 0.155 / own, with own the
    // particle's own radius. The ball's kernel is shorter than Reach.
    const double own = R / Voxel, ball = own + 0.155 / own, reach = 0.7 * Reach / Voxel;
    const double lone = std::pow(1.0 - ball * ball / reach / reach, 3.0);
    for (const ShellLeaf& leaf : shell.Leaves)
    {
      float values[512];
      nodes.EvaluateLeaf(leaf, values);
      for (int n = 0; n < 512; ++n)
      {
        if ((leaf.Rows >> (n >> 3)) & 1)
        {
          const double* p = one[0].Position;
          const double d =
            Distance({ double(leaf.Origin[0] + (n >> 6)), double(leaf.Origin[1] + (n >> 3 & 7)),
                       double(leaf.Origin[2] + (n & 7)) },
              { p[0] / Voxel, p[1] / Voxel, p[2] / Voxel });
          const double kernel = std::pow(std::max(1.0 - d * d / reach / reach, 0.0), 3.0);
          const double sum = strength * kernel / lone;
          EXPECT_NEAR(values[n], 1.0 - std::sqrt(std::sqrt(sum)), 1e-5) << d;
        }
      }
    }
  }
}

TEST(TestNodeFits, AParticleWithoutStrengthAddsNothing)
{
  std::vector<SkeletonVertex> block = MakeBlock(4), more = block;
  SkeletonVertex none = block[0];
  none.Position[0] += 0.3 * R;
  none.Strength = 0.0;
  more.push_back(none);
  ParticleNodes nodes, others;
  Build(block, nodes);
  Build(more, others);
  Shell shell;
  nodes.FindShell(false, shell);
  for (const ShellLeaf& leaf : shell.Leaves)
  {
    float values[512], same[512];
    nodes.EvaluateLeaf(leaf, values);
    others.EvaluateLeaf(leaf, same);
    EXPECT_TRUE(std::equal(values, values + 512, same));
  }
}

// In single precision, products of these strengths underflow.
TEST(TestNodeFits, TinyStrengthsGiveNoNaN)
{
  for (const double strength : { 1e-25, 1e-38, 1e-40, 1e-44 })
  {
    std::vector<SkeletonVertex> block = MakeBlock(4);
    for (SkeletonVertex& particle : block)
    {
      particle.Strength = strength;
    }
    block.front().Strength = 0.0;
    ParticleNodes nodes;
    Build(block, nodes);
    Shell shell;
    nodes.FindShell(false, shell);
    for (const ShellLeaf& leaf : shell.Leaves)
    {
      float values[512];
      nodes.EvaluateLeaf(leaf, values);
      EXPECT_TRUE(std::all_of(values, values + 512, [](float value) { return value == value; }))
        << strength;
    }
  }
}

}
