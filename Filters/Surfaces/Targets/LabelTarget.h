// Images of labels as a target of the node scheme. Near a label's surface, within FindFreedom, the
// skin is not attracted (NodeFreedom).

#ifndef LabelTarget_h
#define LabelTarget_h

#include "Base/NodeTarget.h"
#include "Targets/BlendedTarget.h"

namespace activesurface
{

class LabelTarget
  : public BlendedTarget
  , public NodeTarget
{
public:
  using BlendedTarget::BlendedTarget;

  // Returns the distance from a label's surface within which the skin is not attracted [pixels]:
  // TargetNoise / leastPixel, or 0.47 if TargetNoise is automatic. leastPixel: shortest side of the
  // pixels [length].
  static double FindFreedom(const TargetOptions& options, double leastPixel);

  NodeTarget* GetNodes() override { return this; }
  void PlaceNodes(const NodeMotion& motion) override;
  void FindShell(bool wantsInside, Shell& shell) const override;
  bool IsInside(const NodeIndex& node) const override;
  void EvaluateLeaf(const ShellLeaf& leaf, float* values) const override;
  void FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const override;
  float GetNoise() const override { return 0.f; }
  float GetWallGap() const override { return 0.f; }
  NodeFreedom GetFreedom() const override;

private:
  struct Block; // a cube of nodes
  void SampleLabel(
    const Shape& shape, std::size_t count, const double* points, double* distances) const;
  void SampleNodes(std::size_t count, const double* points, double* distances) const;
  double DistanceAt(const double (&node)[3]) const;
  bool IsUniform(const Block& block, double& distance) const;
  void Visit(const Block& block, bool wantsInside, Shell& shell) const;

  double FindUnit() const;
  double GetReach() const; // distance at which the potential of EvaluateLeaf is 1 [length]

  double VoxelSize = 1.0;
  double LeastPixel = 1.0, LargestPixel = 1.0; // of the two steps [length]
};

}

#endif
