// Moving particles as a target. F is either a sum of kernels, threshold - sum of strength *
// kernel(distance / radius), or the potential of ellipsoids (ParticlePotential.h).
//
// Outside all supports F is constant with gradient zero. There a target with Normalize attracts a
// skin with the constant speed that applies at the distance Reach.

#ifndef ParticleTarget_h
#define ParticleTarget_h

#include "Base/NodeTarget.h"
#include "Index/Skeleton.h"
#include "ParticleNodes.h"
#include "ParticlePotential.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetFrames.h"

#include <vector>

namespace activesurface
{

class ParticleTarget
  : public MovingTarget
  , public NodeTarget
{
public:
  // The caller owns the frames, which must contain the steps that MoveAlong uses.
  ParticleTarget(const TargetFrames& frames, const TargetOptions& options);

  // Options of the node scheme for particles of one radius.
  static NodeParticleOptions GetNodeOptions(const TargetOptions& options, double voxelSize);

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
    return static_cast<float>(this->GetOptions().NoiseAtNodes / this->VoxelSize);
  }
  // Returns half of the particles' spacing [voxels]: no particle fits into a narrower gap between
  // wall and surface.
  float GetWallGap() const override
  {
    return static_cast<float>(0.5 * this->GetOptions().Spacing / this->VoxelSize);
  }
  bool HasRegions() const override { return true; }
  bool IsWithinRegions() const override { return true; }
  std::size_t CountRegionSources() const override { return this->Now.size(); }
  // Visits the support of each particle of positive strength, because the supports cover all parts,
  // and a part usually contains the centre of a support. Also visits two points outside each such
  // particle at the edge of a body, where a hollow may be; for a sum of kernels, only with
  // OpensHollows.
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override;

protected:
  void Place(int step, double fraction) override;
  void Finish() override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  bool IsSum() const { return this->GetOptions().Model == ParticleModel::Sum; }
  // Returns half of the spacing, the own radius of all particles of a step and the next one
  // [length]; 0 if particles have radii from an array. Sets the ratio of support radius to own
  // radius.
  double FindOwnRadius(int step, double& reachPerRadius) const;
  // Value of the sum of kernels on the target's surface.
  double GetLevel() const { return this->GetOptions().Threshold - this->GetOptions().IsoValue; }

  const TargetFrames& Frames;

  // Data of explicit substeps.
  std::vector<SkeletonVertex> Now;
  Skeleton Elements;      // of a sum of kernels
  ParticlePotential Body; // of ellipsoids; for a sum of kernels only to find hollows

  // Data of the node scheme.
  double VoxelSize = 1.0;
  ParticleNodes Nodes;
  std::vector<SkeletonVertex> AtNodes; // of a sum of kernels
  Skeleton ElementsAtNodes;
};

}

#endif
