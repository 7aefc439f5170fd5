// The shell of particles contains all nodes near their skin. All other nodes are inside where
// ParticleNodes::IsInside returns true, otherwise outside.

#include "Support/ParticlesAtRest.h"
#include "Support/SkeletonShapes.h"
#include "Support/Throws.h"

#include "ParticleNodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

using namespace activesurface;

namespace TestParticleShell
{

namespace
{

constexpr double R = 0.1; // a particle's own radius

using Cloud = std::vector<SkeletonVertex>;

void Add(Cloud& cloud, double x, double y, double z)
{
  SkeletonVertex particle;
  particle.Position[0] = 2.0 * R * x;
  particle.Position[1] = 2.0 * R * y;
  particle.Position[2] = 2.0 * R * z;
  particle.Radius = 4.5 * R;
  particle.Strength = 1.0;
  cloud.push_back(particle);
}

// A block with or without its middle, as in a fluid: each particle is displaced by up to a quarter
// of the spacing.
Cloud MakeBlock(int side, bool isHollow)
{
  Random random(3);
  Cloud cloud;
  for (int n = 0; n < side * side * side; ++n)
  {
    const int at[3] = { n / side / side, n / side % side, n % side };
    const auto isMiddle = [side](int i) { return i > 0 && i < side - 1; };
    double off[3];
    for (double& component : off)
    {
      component = random.Between(-0.25, 0.25);
    }
    if (!isHollow || !(isMiddle(at[0]) && isMiddle(at[1]) && isMiddle(at[2])))
    {
      Add(cloud, at[0] + off[0], at[1] + off[1], at[2] + off[2]);
    }
  }
  return cloud;
}

// Drops, pairs and clumps.
Cloud MakeSpray(int count)
{
  Random random(7);
  Cloud cloud;
  for (int n = 0; n < count; ++n)
  {
    Add(cloud, random.Between(0.0, 8.0), random.Between(0.0, 8.0), random.Between(0.0, 8.0));
  }
  return cloud;
}

// The target at all nodes around the particles, and the nodes that the shell contains.
class Field
{
public:
  static constexpr int Side = 128; // nodes
  static constexpr int First = -32;

  Field(const Cloud& cloud, double voxelSize)
    : Values(Side * Side * Side)
    , InShell(Side * Side * Side, false)
  {
    NodeParticleOptions options;
    options.VoxelSize = voxelSize;
    options.OwnRadius = R;
    this->Nodes.Build(ParticlesAtRest(cloud), options);
    this->Nodes.FindShell(false, this->Near);
    for (int x = First; x < First + Side; x += 8)
    {
      for (int y = First; y < First + Side; y += 8)
      {
        for (int z = First; z < First + Side; z += 8)
        {
          this->Fill({ { x, y, z }, ~std::uint64_t(0), 0 }, this->Values);
        }
      }
    }
    for (const ShellLeaf& leaf : this->Near.Leaves)
    {
      this->Mark(leaf);
    }
  }

  static std::size_t At(int x, int y, int z)
  {
    return (static_cast<std::size_t>(x - First) * Side + (y - First)) * Side + (z - First);
  }
  float operator()(int x, int y, int z) const { return this->Values[At(x, y, z)]; }
  bool IsInShell(int x, int y, int z) const { return this->InShell[At(x, y, z)]; }
  bool IsInside(int x, int y, int z) const { return this->Nodes.IsInside({ x, y, z }); }

  // Calls the function for the outside nodes within a distance [voxels].
  template <class Function>
  void ForEachOutsideNear(int x, int y, int z, double distance, Function&& function) const
  {
    const int reach = static_cast<int>(distance);
    for (int n = 0; n < (2 * reach + 1) * (2 * reach + 1) * (2 * reach + 1); ++n)
    {
      const int side = 2 * reach + 1;
      const int dx = n / side / side - reach, dy = n / side % side - reach, dz = n % side - reach;
      if (dx * dx + dy * dy + dz * dz < distance * distance &&
        (*this)(x + dx, y + dy, z + dz) >= 0.f)
      {
        function(x + dx, y + dy, z + dz);
      }
    }
  }

  template <class Function>
  static void ForEachNode(Function&& function)
  {
    for (int x = First + 1; x < First + Side - 1; ++x)
    {
      for (int y = First + 1; y < First + Side - 1; ++y)
      {
        for (int z = First + 1; z < First + Side - 1; ++z)
        {
          function(x, y, z);
        }
      }
    }
  }

private:
  void Fill(const ShellLeaf& leaf, std::vector<float>& values) const
  {
    float own[512];
    this->Nodes.EvaluateLeaf(leaf, own);
    for (int n = 0; n < 512; ++n)
    {
      values[At(leaf.Origin[0] + (n >> 6), leaf.Origin[1] + (n >> 3 & 7),
        leaf.Origin[2] + (n & 7))] = own[n];
    }
  }

  void Mark(const ShellLeaf& leaf)
  {
    for (int n = 0; n < 512; ++n)
    {
      if ((leaf.Rows >> (n >> 3)) & 1)
      {
        this->InShell[At(leaf.Origin[0] + (n >> 6), leaf.Origin[1] + (n >> 3 & 7),
          leaf.Origin[2] + (n & 7))] = true;
      }
    }
  }

  ParticleNodes Nodes;
  Shell Near;
  std::vector<float> Values;
  std::vector<bool> InShell;
};

// `band`: width around the inside nodes [voxels].
void Check(const Cloud& cloud, double voxelSize, double band)
{
  const Field field(cloud, voxelSize);
  int wrong = 0, missing = 0, crossed = 0;
  Field::ForEachNode(
    [&](int x, int y, int z)
    {
      const bool isInside = field(x, y, z) < 0.f;
      if (!field.IsInShell(x, y, z))
      {
        wrong += isInside != field.IsInside(x, y, z) ? 1 : 0;
      }
      if (isInside)
      {
        field.ForEachOutsideNear(x, y, z, band,
          [&](int i, int j, int k)
          {
            ++crossed;
            missing += field.IsInShell(i, j, k) ? 0 : 1;
          });
      }
    });
  EXPECT_GT(crossed, 0);
  EXPECT_EQ(wrong, 0) << "nodes on another side";
  EXPECT_EQ(missing, 0) << "nodes near the skin";
}

}

TEST(TestParticleShell, HoldsWhatIsNearTheSkin)
{
  for (const double voxelSize : { 2.0 * R, R, 0.5 * R })
  {
    SCOPED_TRACE(voxelSize / R);
    Cloud one;
    Add(one, 0.3, 0.1, 0.4);
    Check(one, voxelSize, 3.0);
    Cloud two = one;
    Add(two, 1.1, 0.2, 0.3);
    Check(two, voxelSize, 3.0);
    Check(MakeBlock(5, false), voxelSize, 3.0);
    Check(MakeBlock(6, true), voxelSize, 3.0);
    Check(MakeSpray(60), voxelSize, 3.0);
  }
}

// If cells are wider than leaves, leaves are listed cell by cell instead of block by block.
TEST(TestParticleShell, HoldsWhatIsNearTheSkinWithCellsWiderThanLeaves)
{
  Cloud cloud;
  Add(cloud, 0.3, 0.1, 0.4);
  Check(cloud, R / 6.0, 3.0);
  Add(cloud, 1.1, 0.2, 0.3);
  Check(cloud, R / 6.0, 3.0);
}

TEST(TestParticleShell, RefusesParticlesOfTooManyVoxels)
{
  Cloud cloud;
  Add(cloud, 0.0, 0.0, 0.0);
  for (const double voxelsPerRadius : { 1e3, 1e6, 1e12 })
  {
    NodeParticleOptions options;
    options.VoxelSize = R / voxelsPerRadius;
    options.OwnRadius = R;
    ParticleNodes nodes;
    nodes.Build(ParticlesAtRest(cloud), options);
    Shell shell;
    EXPECT_TRUE(
      Throws<std::runtime_error>([&] { nodes.FindShell(false, shell); }, "enlarge VoxelSize"));
  }
}

}
