// Moves surfaces with every kind of motion, and prints a hash of each potential. The output is the
// same on any processor. Run: MotionBytes

#include "Support/AnalyticShapes.h"

#include "Base/NodeTarget.h"
#include "Base/OpenVDB.h"
#include "NarrowBandGrid.h"
#include "ParticleNodes.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{

/** FNV-1a hash. */
class Hash
{
public:
  template <class Value>
  void Add(const Value& value)
  {
    unsigned char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    for (const unsigned char byte : bytes)
    {
      this->Sum = (this->Sum ^ byte) * 1099511628211u;
    }
  }
  std::uint64_t Get() const { return this->Sum; }

private:
  std::uint64_t Sum = 14695981039346656037u;
};

std::uint64_t HashOf(const NarrowBand& band)
{
  Hash hash;
  const auto grid = GetPotential(band);
  for (auto value = grid->tree().cbeginValueOn(); value; ++value)
  {
    const openvdb::Coord at = value.getCoord();
    hash.Add(at.x());
    hash.Add(at.y());
    hash.Add(at.z());
    hash.Add(*value);
  }
  return hash.Get();
}

struct Scene
{
  std::string Name;
  Motion Parameters;
};

Scene Make(const char* name, double attraction, double tension)
{
  Scene scene = { name, Motion() };
  scene.Parameters.Attraction = attraction;
  scene.Parameters.Tension = tension;
  return scene;
}

std::vector<Scene> MakeExplicitScenes()
{
  std::vector<Scene> scenes = { Make("tracking", 1.0, 0.0), Make("tracking, tension", 1.0, .02),
    Make("tension", 0.0, .1), Make("penalties", 1.0, .05), Make("exact volume", 1.0, .05),
    Make("exact area", 0.0, .1), Make("walls", 1.0, .02) };
  scenes[3].Parameters.AreaControl = scenes[3].Parameters.VolumeControl = Control::Penalty;
  scenes[4].Parameters.VolumeControl = Control::Exact;
  scenes[5].Parameters.AreaControl = Control::Exact;
  scenes[6].Parameters.Box = { true, { -.6, .6, -.6, .6, -.6, .6 } };
  return scenes;
}

// Scenes of the node scheme, with frames of 0.1.
std::vector<Scene> MakeNodeScenes()
{
  std::vector<Scene> scenes = { Make("particles", 60.0, .2), Make("particles, coarse", 60.0, 0.0),
    Make("particles, weighted tension", 60.0, .5), Make("particles, walls", 60.0, .2),
    Make("particles, exact volume", 60.0, .2) };
  for (Scene& scene : scenes)
  {
    scene.Parameters.Integration = TimeIntegration::Nodes;
    scene.Parameters.Transport = 1.0;
  }
  scenes[2].Parameters.WeightedTension = true;
  scenes[3].Parameters.Box = { true, { -.42, .42, -.42, .42, -.42, .42 } };
  scenes[4].Parameters.VolumeControl = Control::Exact;
  return scenes;
}

constexpr double OwnRadius = .05;

// A block of particles and some drops around it, in a flow whose velocity is linear in the
// position.
class FlowingParticles final : public NodeParticles
{
public:
  explicit FlowingParticles(double time)
  {
    std::mt19937 random(11);
    const auto between = [&random](double low, double high)
    { return low + (high - low) * (static_cast<double>(random()) / 4294967296.0); };
    for (int n = 0; n < 6 * 6 * 6 + 40; ++n)
    {
      const double cell[3] = { n / 36 - 2.5, n / 6 % 6 - 2.5, n % 6 - 2.5 };
      SkeletonVertex particle;
      for (int axis = 0; axis < 3; ++axis)
      {
        particle.Position[axis] =
          n < 216 ? OwnRadius * (2.0 * cell[axis] + between(-.4, .4)) : between(-.7, .7);
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        particle.Position[axis] += time * Speed * particle.Position[(axis + 1) % 3];
      }
      particle.Radius = 4.5 * OwnRadius;
      particle.Strength = 1.0;
      this->All.push_back(particle);
    }
  }

  std::size_t Size() const override { return this->All.size(); }
  SkeletonVertex Get(std::size_t n) const override { return this->All[n]; }
  bool FindVelocity(std::size_t n, double (&velocity)[3]) const override
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      velocity[axis] = Speed * this->All[n].Position[(axis + 1) % 3];
    }
    return true;
  }

private:
  static constexpr double Speed = .6;
  std::vector<SkeletonVertex> All;
};

class ParticleTarget final
  : public Target
  , public NodeTarget
{
public:
  void Evaluate(std::size_t, const double*, const TargetResults&) const override {}
  NodeTarget* GetNodes() override { return this; }

  void PlaceNodes(const NodeMotion& motion) override
  {
    NodeParticleOptions options;
    options.VoxelSize = motion.VoxelSize;
    options.OwnRadius = OwnRadius;
    options.HasVelocities = options.HasNoise = true;
    options.Duration = motion.Transport * (motion.End - motion.Begin);
    this->Nodes.Build(FlowingParticles(motion.End), options);
  }
  void FindShell(bool wantsInside, Shell& shell) const override
  {
    this->Nodes.FindShell(wantsInside, shell);
  }
  bool IsInside(const NodeIndex& node) const override { return this->Nodes.IsInside(node); }
  void EvaluateLeaf(const ShellLeaf& leaf, float* values) const override
  {
    this->Nodes.EvaluateLeaf(leaf, values);
  }
  void FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const override
  {
    this->Nodes.FindMotion(leaf, motion);
  }
  float GetNoise() const override { return .3f; }
  float GetWallGap() const override { return 1.f; }

private:
  ParticleNodes Nodes;
};

// The start uses regions. Dense starts call sweeps in OpenVDB's library, which a compiler may have
// built with fused multiply-adds.
InitialFunction MakeStart()
{
  InitialFunction function = MakeInitialFunction(MakeSixMetaballs());
  TargetRegion region;
  std::copy_n(Box, 6, region.Bounds);
  function.ForEachRegion = [region](const RegionVisitor& visit) { visit(region); };
  return function;
}

void Print(const Scene& scene, const AdvanceReport& report, const NarrowBand& band)
{
  std::printf("%s: %zu substeps, %zu evaluations, %016" PRIx64 "\n", scene.Name.c_str(),
    report.Substeps, report.TargetEvaluations, HashOf(band));
}

void RunExplicitly(const Scene& scene)
{
  NarrowBand band(VoxelSizeOf(48));
  band.Start(0.0, Box, MakeStart());
  ShapeTarget target(MakeTorus({ .01, .02, .013 }, .5, .22));
  Print(scene, band.Advance(.3, scene.Parameters, target), band);
}

void RunOnNodes(const Scene& scene)
{
  constexpr double dt = .1;
  NarrowBand band(scene.Parameters.Tension > 0.0 ? .5 * OwnRadius : OwnRadius);
  ParticleTarget target;
  band.StartOnNodes(0.0, Box, scene.Parameters, dt, target);
  for (int frame = 1; frame < 3; ++frame)
  {
    Print(scene, band.Advance(frame * dt, scene.Parameters, target), band);
  }
}

}

int main()
{
  for (const Scene& scene : MakeExplicitScenes())
  {
    RunExplicitly(scene);
  }
  for (const Scene& scene : MakeNodeScenes())
  {
    RunOnNodes(scene);
  }
  return 0;
}
