/**
 * The kinds of input, and which of them a data set is.
 */
#ifndef InputKinds_h
#define InputKinds_h

#include "Targets/InputData.h"

#include <memory>

namespace activesurface
{

class InputShape;

/** The VTK classes of data that have a kind, and that the input ports take; of the others that
 * port 0 takes, AsDataSet makes one of these. */
constexpr const char* InputTypes[] = { "vtkPointSet", "vtkImageData", "vtkDataObjectTree" };
constexpr const char* MoreTargetTypes[] = { "vtkTable" };

/**
 * Throws std::invalid_argument for data that cannot be a target, and for arrays that are missing or
 * unfit.
 */
std::unique_ptr<InputShape> MakeInputShape(const InputData& input);

}

#endif
