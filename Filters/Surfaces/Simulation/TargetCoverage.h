// The fraction of the target outside the skin.
//
// For particles and skeletons: the fraction of their points of positive strength that are outside
// by more than their own radius (ParticleModel.h). For other targets, and for inverted targets: the
// fraction of sample points of the inside that are outside the skin by more than a voxel. Sample
// points are a low-discrepancy sequence in the target's box; about 4096 or more are inside the
// target if the target fills at least 1/16 of the box. A fraction of 1 % then has a standard
// deviation of at most 0.16 %, that of 4096 random points. Points beyond walls or in the obstacle
// do not count.

#ifndef TargetCoverage_h
#define TargetCoverage_h

#include "Base/Motion.h"
#include "Surface/PointsOutside.h"

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
  // Keeps references to the arguments.
  TargetCoverage(const SurfaceSettings& settings, const TargetBuilder& shapes);

  // Deletes the points, which depend on the settings and the inputs.
  void Clear();

  // Returns the fraction, in [0,1], for the target at a stored step; 0 without a target. Collective
  // if the band is a part.
  double FindOutside(const NarrowBand& band, const Motion& motion, int step);

private:
  bool IsStatic() const;
  const ParticleFrame* FindFrame(int step) const;
  std::vector<PointWithMargin> ListParticles(
    const ParticleFrame& frame, std::size_t first, std::size_t end) const;
  std::vector<PointWithMargin> FindInside(int step, double voxelSize) const;

  const SurfaceSettings& Settings;
  const TargetBuilder& Shapes;
  std::vector<PointWithMargin> Points; // of the target; kept if the target is static
  bool ArePointsKnown = false;
};

}

#endif
