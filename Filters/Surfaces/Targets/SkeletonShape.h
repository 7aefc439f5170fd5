/** Lines: a skeleton of segments (vtkSkeletonPotential). */
#ifndef SkeletonShape_h
#define SkeletonShape_h

#include "Frames/ParticleFrame.h"
#include "Targets/FunctionShape.h"
#include "Targets/InputData.h"

namespace activesurface
{

class SkeletonShape : public FunctionShape
{
public:
  static bool Fits(vtkDataSet* data);

  /** Throws std::invalid_argument for unsuitable arrays. */
  explicit SkeletonShape(const InputData& input);

  const char* GetName() const override { return "a skeleton of lines"; }
  bool IsEmpty() const override { return this->Points.Particles.empty(); }
  const ParticleFrame* GetPoints() const override { return &this->Points; }

  /** Makes the function at the first call, because the function needs no voxels. */
  std::string Prepare(const TargetOptions& options, const Warnings& messages) override;
  void AddBounds(
    const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const override;
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const TargetOptions& options) const override;

protected:
  bool KnowsParts() const override { return false; }
  void MoveBy(const double offset[3]) override;

private:
  ParticleFrame Points;
};

}

#endif
