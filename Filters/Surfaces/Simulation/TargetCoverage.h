// How much of the target is outside the skin.
//
// Of particles, and of the points of a skeleton, those count that are outside by more than their
// own radius (ParticleModel.h). Of other targets the inside is told by points that are spread
// evenly in its box (a low-discrepancy sequence, 4096 points inside at least where they are a
// sixteenth of the box): those count that are outside by more than a voxel. A share of 1 % is so
// known to .16 %, the standard deviation of as many points at random. What is beyond walls or in
// the obstacle does not count.

#ifndef TargetCoverage_h
#define TargetCoverage_h

#include "Motion.h"
#include "PointsOutside.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class NarrowBand;
class TargetBuilder;
struct ParticleFrame;
struct SurfaceSettings;

class TargetCoverage
{
public:
  // Both are the caller's.
  TargetCoverage(const SurfaceSettings& settings, const TargetBuilder& shapes);

  // Comes when the settings or the inputs have changed.
  void Clear();

  // The share, in [0,1], of the target at a step that is held; 0 where there is no target.
  double FindOutside(const NarrowBand& band, const Motion& motion, int step);

private:
  bool IsStatic() const;
  const ParticleFrame* FindFrame(int step) const;
  std::vector<PointWithMargin> ListParticles(
    const ParticleFrame& frame, std::size_t first, std::size_t end) const;
  std::vector<PointWithMargin> FindInside(int step, double voxelSize) const;

  const SurfaceSettings& Settings;
  const TargetBuilder& Shapes;
  std::vector<PointWithMargin> Points; // of a target that stands still
  bool ArePointsKnown = false;
};

}

#endif
