#include "Targets/NoShape.h"

#include "Targets/ParticleTarget.h"
#include "Targets/TargetOptions.h"

#include "vtkDataSet.h"

namespace activesurface
{

bool NoShape::Fits(vtkDataSet* data)
{
  return data->GetNumberOfPoints() == 0;
}

NoShape::NoShape(const InputData&) {}

std::unique_ptr<MovingTarget> NoShape::MakeTarget(
  const TargetFrames& frames, const TargetOptions& options) const
{
  return std::make_unique<ParticleTarget>(frames, options);
}

}
