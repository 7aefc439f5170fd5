// Moving particles as a target. F is either a sum of kernels, threshold - sum of strength *
// kernel(distance / radius), or a model with neighbours (ParticlePotential.h).
//
// Outside all supports F is constant with gradient zero. There the target attracts a skin with the
// constant speed that belongs to its Reach.

#ifndef ParticleTarget_h
#define ParticleTarget_h

#include "NodeTarget.h"
#include "ParticleNodes.h"
#include "ParticlePotential.h"
#include "Skeleton.h"
#include "Targets/ChangedRegion.h"
#include "Targets/MovingTarget.h"
#include "Targets/PlacedChanges.h"
#include "Targets/ShapeOptions.h"
#include "Targets/TargetFrames.h"

#include <vector>

namespace activesurface
{

class ParticleTarget
  : public MovingTarget
  , public NodeTarget
{
public:
  // The caller owns the frames. They must contain the steps that MoveAlong uses.
  ParticleTarget(const TargetFrames& frames, const ShapeOptions& options);

  // Options of the node scheme for particles of one radius.
  static NodeParticleOptions GetNodeOptions(const ShapeOptions& options, double voxelSize);

  NodeTarget* GetNodes() override { return this; }
  void PlaceNodes(const NodeMotion& motion) override;
  void FindShell(bool wantsInside, Shell& shell) const override
  {
    this->Nodes.FindShell(wantsInside, shell);
  }
  bool IsInside(const NodeIndex& node) const override { return this->Nodes.IsInside(node); }
  void EvaluateLeaf(const ShellLeaf& leaf, float* values) const override;
  void FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const override
  {
    this->Nodes.FindMotion(leaf, motion);
  }
  float GetNoise() const override
  {
    return static_cast<float>(this->Options.NoiseAtNodes / this->VoxelSize);
  }
  bool HasRegions() const override { return true; }
  bool IsWithinRegions() const override { return true; }
  // Visits the support of each particle, as any part that the skin does not meet contains a
  // support. If there are fits, also visits two points outside each particle at the edge of a body,
  // where a hollow may be.
  std::size_t CountRegionSources() const override { return this->Now.Particles.size(); }
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override;

protected:
  void Place(int step, double fraction) override;
  void Finish() override;
  bool HasChangedIn(const double bounds[6]) const override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  bool IsSum() const { return this->Options.Model == ParticleModel::Sum; }
  ParticleTrack MakeTrack(int step, double fraction, bool needsFits) const;
  void FindFits(const ParticleFrame& frame) const;
  void BuildBody(const PlacedParticles& placed, Skeleton& elements, ParticlePotential& body) const;
  // Value of the sum of kernels at the skin.
  double GetLevel() const
  {
    return this->IsSum() ? this->Options.Threshold - this->Options.Level.IsoValue : 0.5;
  }
  void FindChanged();
  void NoteCells(double before, double now);

  const TargetFrames& Frames;
  const ShapeOptions Options;
  PlacedParticles Now;
  PlacedParticles Previous;
  std::vector<ChangedRegion::Box> ChangedSupports;
  ChangedRegion Changed;  // from Previous to Now
  Skeleton Elements;      // of a sum
  ParticlePotential Body; // of the other models

  // State of the node scheme.
  double VoxelSize = 1.0;
  PlacedParticles AtNodes;
  ParticleNodes Nodes;
  Skeleton ElementsAtNodes;      // of a sum
  ParticlePotential BodyAtNodes; // of the averaged centre
};

}

#endif
