/**
 * An input without points: there is no target at that step.
 */
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

  /** As of particles: it has none. */
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const ShapeOptions& options) const override;
};

}

#endif
