/**
 * Targets that report the regions of their surface.
 */
#ifndef RegionTargets_h
#define RegionTargets_h

#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace activesurface
{
inline TargetRegion RegionAround(const Ball& ball, RegionSeeds seeds)
{
  TargetRegion region;
  region.Seeds = seeds;
  for (int axis = 0; axis < 3; ++axis)
  {
    region.Bounds[2 * axis] = ball.Centre[axis] - ball.Radius;
    region.Bounds[2 * axis + 1] = ball.Centre[axis] + ball.Radius;
  }
  return region;
}

/** A shape with regions, both functions of time. */
class RegionTarget : public ShapeTarget
{
public:
  using Regions = std::function<std::vector<TargetRegion>(double)>;

  RegionTarget(const Trajectory& shape, const Regions& regions)
    : ShapeTarget(shape)
    , RegionsOf(regions)
  {
  }

  void MoveTo(double time) override
  {
    ShapeTarget::MoveTo(time);
    this->Current = this->RegionsOf(time);
  }
  bool HasRegions() const override { return true; }
  std::size_t CountRegionSources() const override { return this->Current.size(); }
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override
  {
    std::for_each(this->Current.data() + first, this->Current.data() + end, visit);
  }

private:
  Regions RegionsOf;
  std::vector<TargetRegion> Current;
};

inline RegionTarget MakeStanding(const Shape& shape, const std::vector<TargetRegion>& regions)
{
  return { [shape](double) { return shape; }, [regions](double) { return regions; } };
}

/** Balls as a function of time, each with its region. */
inline RegionTarget MakeMovingBalls(const std::function<std::vector<Ball>(double)>& balls,
  RegionSeeds seeds = RegionSeeds::PartAtCentre)
{
  return { [balls](double time) { return MakeBalls(balls(time)); },
    [balls, seeds](double time)
    {
      std::vector<TargetRegion> regions;
      for (const Ball& ball : balls(time))
      {
        regions.push_back(RegionAround(ball, seeds));
      }
      return regions;
    } };
}

inline RegionTarget MakeStandingBalls(const std::vector<Ball>& balls)
{
  return MakeMovingBalls([balls](double) { return balls; });
}

inline Motion MakeCreating(double attraction = 1.0)
{
  Motion motion;
  motion.Attraction = attraction;
  motion.CreateParts = true;
  return motion;
}

inline void CheckSound(const NarrowBand& band, const Topology& expected)
{
  const Mesh mesh = Polygonise(band);
  const MeshDefects defects = FindDefects(mesh);
  EXPECT_EQ(defects.Edges + defects.Vertices + defects.Unused, 0u);
  const Topology topology = GetTopology(mesh);
  EXPECT_EQ(topology.Components, expected.Components) << "bodies";
  EXPECT_EQ(topology.Voids, expected.Voids) << "voids";
  EXPECT_EQ(topology.EulerCharacteristic, expected.EulerCharacteristic) << "Euler number";
}

/** Scene of TestNewParts and TestNewPartsRules. */
namespace twoballs
{
constexpr int Nodes = 48;
constexpr double H = VoxelSizeOf(Nodes);

constexpr Ball Left = { { -0.45, 0.013, 0.007 }, 0.3 };
constexpr Ball Right = { { 0.45, 0.021, -0.013 }, 0.25 };

inline std::unique_ptr<NarrowBand> StartWith(const Shape& shape, int threads = 0)
{
  auto band = std::make_unique<NarrowBand>(H);
  band->SetNumberOfThreads(threads);
  StartOn(*band, shape);
  return band;
}
}

}

#endif
