/** Particles: points without cells, or with vertices only (ParticleTarget.h). */
#ifndef ParticleShape_h
#define ParticleShape_h

#include "Frames/ParticleFrame.h"
#include "Targets/InputData.h"
#include "Targets/InputShape.h"

#include <utility>

namespace activesurface
{

class ParticleShape : public InputShape
{
public:
  static bool Fits(vtkDataSet* data);

  /** Throws std::invalid_argument for cells other than vertices, and for unsuitable arrays. */
  explicit ParticleShape(const InputData& input);
  explicit ParticleShape(ParticleFrame particles, const ParticleArrays& kept = ParticleArrays(),
    bool hasVertices = false);

  /** Moves the particles out; this shape is empty afterwards. */
  ParticleFrame ReleaseParticles() { return std::move(this->Particles); }

  /** Returns a shape of other particles of the same input, relative to the same origin. */
  std::shared_ptr<ParticleShape> MakeOther(ParticleFrame particles) const;

  const char* GetName() const override { return "particles"; }
  bool IsEmpty() const override { return this->Particles.CountAllParticles() == 0; }
  bool HasCells() const override { return this->HasVertices; }

  std::string Prepare(const TargetOptions& options, const Warnings& messages) override;
  void AddBounds(
    const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const override;
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const TargetOptions& options) const override;

  const ParticleFrame* GetParticles() const override { return &this->Particles; }
  bool HasArrays(const ParticleArrays& arrays) const override { return this->Kept == arrays; }

protected:
  void MoveBy(const double offset[3]) override { this->Particles.MoveBy(offset); }

private:
  void LimitStrengths(const TargetOptions& options, const Warnings& messages);

  ParticleFrame Particles;
  ParticleArrays Kept;
  bool HasVertices = false;
};

}

#endif
