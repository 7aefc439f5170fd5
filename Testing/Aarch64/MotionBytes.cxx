// Moves surfaces with every kind of motion, and prints a hash of each potential: the same lines on
// any processor. Run: MotionBytes

#include "Support/AnalyticShapes.h"

#include "Base/OpenVDB.h"
#include "NarrowBandGrid.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
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
  Motion Way;
};

std::vector<Scene> MakeScenes()
{
  const auto make = [&](const char* name, double attraction, double tension)
  {
    Scene scene = { name, Motion() };
    scene.Way.Attraction = attraction;
    scene.Way.Tension = tension;
    return scene;
  };
  std::vector<Scene> scenes = { make("tracking", 1.0, 0.0), make("tracking, tension", 1.0, .02),
    make("tension", 0.0, .1), make("penalties", 1.0, .05), make("exact volume", 1.0, .05),
    make("exact area", 0.0, .1), make("carried, weighted tension", 1.0, .02),
    make("walls", 1.0, .02) };
  scenes[3].Way.AreaControl = scenes[3].Way.VolumeControl = Control::Penalty;
  scenes[4].Way.VolumeControl = Control::Exact;
  scenes[5].Way.AreaControl = Control::Exact;
  scenes[6].Way.Transport = 1.0;
  scenes[6].Way.WeightedTension = true;
  scenes[7].Way.Box = { true, { -.6, .6, -.6, .6, -.6, .6 } };
  return scenes;
}

// Velocities are polynomials: libraries may differ in the last digit of a cosine.
Shape MakeFlowingRing()
{
  Shape ring = MakeTorus({ .01, .02, .013 }, .5, .22);
  ring.Velocity = [](const Point& x) { return Point{ .3 * x[1], .2 * x[0], .3 * x[2] * x[2] }; };
  ring.TensionWeight = [](const Point& x) { return .5 + .3 * x[0]; };
  return ring;
}

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

void Run(const Scene& scene)
{
  NarrowBand band(VoxelSizeOf(48));
  band.Start(0.0, Box, MakeStart());
  ShapeTarget target(MakeFlowingRing());
  const AdvanceReport report = band.Advance(.3, scene.Way, target);
  std::printf(
    "%s: %zu substeps, %016" PRIx64 "\n", scene.Name.c_str(), report.Substeps, HashOf(band));
}

}

int main()
{
  for (const Scene& scene : MakeScenes())
  {
    Run(scene);
  }
  return 0;
}
