/** An image: its samples or its attached grid (vtkGridPotential). */
#ifndef ImageShape_h
#define ImageShape_h

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
   * Makes the function. Uses the level and side of the options, unless the level is 0. In this case
   * chooses the level and side that suit the values (ImageShape.cxx).
   */
  std::string Prepare(ShapePreparation& preparation) override;
  std::string DescribeThinParts(const ShapeOptions& options) const override;
  void AddBounds(
    const ShapeOptions& options, vtkBoundingBox& shapes, vtkBoundingBox& images) const override;
  double GetPixel() const override;
  std::unique_ptr<MovingTarget> MakeTarget(
    const TargetFrames& frames, const ShapeOptions& options) const override;
};

}

#endif
