/** An image: its samples or its attached grid (vtkGridPotential). */
#ifndef ImageShape_h
#define ImageShape_h

#include "Grid/LabelSamples.h"
#include "Targets/FunctionShape.h"
#include "Targets/InputData.h"

namespace activesurface
{

class ImageShape : public FunctionShape
{
public:
  static bool Fits(vtkDataSet* data);

  /** Throws std::invalid_argument for unsuitable values. */
  explicit ImageShape(const InputData& input);

  const char* GetName() const override { return "an image"; }
  bool CanStart() const override { return true; }

  /**
   * Makes the function. Uses the level and side of the options; at level 0, those of FindUsualLevel
   * (ImageShape.cxx).
   */
  std::string Prepare(const TargetOptions& options, const Warnings& messages) override;
  std::string DescribeThinParts(const TargetOptions& options) const override;
  void AddBounds(
    const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const override;
  double GetPixel() const override;
  const LabelFacts* GetLabel() const override { return this->IsLabel ? &this->Label : nullptr; }
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const TargetOptions& options) const override;

private:
  bool PrepareLabel(double level);

  bool IsLabel = false;
  LabelFacts Label;
};

}

#endif
