// Moving particles as a target, by a sum of kernels, F = threshold - sum of strength *
// kernel(distance / radius), or by a model that looks at their neighbours, see ParticlePotential.h.
//
// Outside all reaches F is constant, without a gradient: a skin out there is attracted with the
// constant speed that belongs to the target's reach.

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
  // The frames are the caller's, and have to hold what MoveAlong asks for, with fits if the options
  // want them.
  ParticleTarget(const TargetFrames& frames, const ShapeOptions& options);

  // For particles of one radius.
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
  // The reach of each particle, as a part that no skin reaches has one inside; and, if there are
  // fits, a place beside each at the edge of a body, as hollows have such edges.
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
  // Level of the sum of kernels at the skin.
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
