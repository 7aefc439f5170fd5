#include "Pipeline/GivenShapes.h"

#include "Ranks/Agreement.h"
#include "Simulation/SurfaceSettings.h"

#include <stdexcept>

namespace activesurface
{

void CheckShapes(const SurfaceInputs& functions, const GivenShapes& given)
{
  const bool isFunction = functions.TargetFunction != nullptr;
  if (isFunction && given.TargetInput)
  {
    throw std::invalid_argument("There are two targets, TargetFunction and the input of port 0; "
                                "set TargetFunction to none or disconnect the input.");
  }
  if (!isFunction && !given.TargetInput)
  {
    throw std::invalid_argument(
      "There is no target; set TargetFunction, or connect particles, a skeleton of lines, a closed "
      "mesh or an image to input port 0.");
  }
  if (functions.InitialFunction && given.InitialInput)
  {
    throw std::invalid_argument("There are two initial shapes, InitialFunction and the input of "
                                "port 1; set InitialFunction to none or disconnect the input.");
  }
  if (given.TargetIsComposite)
  {
    throw RankError("The input is a composite data set of levels, which cannot be a "
                    "target; make one image of it (vtkResampleToImage).");
  }
  if (given.InitialIsComposite)
  {
    throw RankError("The input of port 1 is a composite data set, which is no initial "
                    "shape; extract or merge its blocks to one mesh or image.");
  }
}

}
