/** An input without points: the target is empty at that step. */
#ifndef NoShape_h
#define NoShape_h

#include "Targets/InputData.h"
#include "Targets/InputShape.h"

namespace activesurface
{

class NoShape : public InputShape
{
public:
  static bool Fits(vtkDataSet* data);

  NoShape() = default;
  explicit NoShape(const InputData& input);

  const char* GetName() const override { return "nothing"; }
  bool HasPoints() const override { return false; }
  bool IsEmpty() const override { return true; }

  /** Returns a ParticleTarget; this shape contributes no particles. */
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const TargetOptions& options) const override;
};

}

#endif
