// Fits of the node scheme, for eight particles at once in single precision, compared with those of
// vtkSkeletonPotential, one by one in double precision.

#include "Support/ParticlesAtRest.h"
#include "Support/SkeletonShapes.h"

#include "Nodes/LaneMatrix.h"
#include "ParticleNodes.h"
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

vtkSmartPointer<vtkSkeletonPotential> MakeReference(const std::vector<SkeletonVertex>& particles)
{
  SkeletonBuilder shape;
  for (const SkeletonVertex& particle : particles)
  {
    const double* x = particle.Position;
    shape.Add({ x[0], x[1], x[2] }, particle.Radius, 1.0);
  }
  auto potential = vtkSmartPointer<vtkSkeletonPotential>::New();
  shape.GiveTo(potential);
  potential->SetParticleModelToAnisotropic();
  potential->SetParticleSpacing(2.0 * R);
  return potential;
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
          // Some matrices have a row of zeros, as for a sheet, or a double eigenvalue.
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

// Visits nodes at the faces of a block, at a distance from its edges that exceeds the kernel's
// dependence. Particles have many neighbours there and the full kernel radius, and both potentials
// use the same model.
template <class Visit>
void ForEachSumAtFaces(int side, Visit&& visit)
{
  const std::vector<SkeletonVertex> particles = MakeBlock(side);
  const vtkSmartPointer<vtkSkeletonPotential> reference = MakeReference(particles);
  ParticleNodes nodes;
  Build(particles, nodes);
  Shell shell;
  nodes.FindShell(false, shell);
  const double last = 2.0 * R * (side - 1), margin = 13.0 * R;
  const auto isBetween = [last](double place, double off)
  { return place > off && place < last - off; };
  for (const ShellLeaf& leaf : shell.Leaves)
  {
    float values[512];
    nodes.EvaluateLeaf(leaf, values);
    for (int n = 0; n < 512; n += 3)
    {
      const Point x = { Voxel * (leaf.Origin[0] + (n >> 6)),
        Voxel * (leaf.Origin[1] + (n >> 3 & 7)), Voxel * (leaf.Origin[2] + (n & 7)) };
      const auto within =
        std::count_if(x.begin(), x.end(), [&](double place) { return isBetween(place, margin); });
      // Three and a half voxels below the skin, which lies R outside the outermost particles.
      const bool isDeep = std::all_of(
        x.begin(), x.end(), [&](double place) { return isBetween(place, 3.5 * Voxel - R); });
      if (((leaf.Rows >> (n >> 3)) & 1) && within >= 2 && !isDeep)
      {
        visit(values[n], 2.0 * (0.5 - ValueAt(reference, x)));
      }
    }
  }
}

}

TEST(TestNodeFits, ABlockHasTheSumsOfDoubles)
{
  int compared = 0;
  ForEachSumAtFaces(20,
    [&compared](float value, double sum)
    {
      if (sum > 0.05 && sum < 8.0)
      {
        EXPECT_NEAR(value, 1.0 - std::sqrt(std::sqrt(sum)), 1e-4) << sum;
        ++compared;
      }
    });
  EXPECT_GT(compared, 300);
}

// Particles deep in a body have no fits: none of their kernels reaches the band around the skin.
TEST(TestNodeFits, ParticlesDeepInABodyAreNotMissed)
{
  double largest = 0.0;
  ForEachSumAtFaces(24,
    [&largest](float value, double sum)
    { largest = std::max(largest, std::fabs(value - 1.0 + std::sqrt(std::sqrt(sum)))); });
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
    // A ball is larger by 0.155 / r of its radius, in voxels, and its kernel is shorter.
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

}
