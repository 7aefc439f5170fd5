/** The kinds of input, and the choice of the kind for a data set. */
#ifndef InputKinds_h
#define InputKinds_h

#include "Targets/InputData.h"

#include <memory>

namespace activesurface
{

class InputShape;

/**
 * VTK classes that both input ports accept, and further classes that port 0 accepts. AsDataSet
 * converts trees and tables to a data set.
 */
constexpr const char* InputTypes[] = { "vtkPointSet", "vtkImageData", "vtkDataObjectTree" };
constexpr const char* MoreTargetTypes[] = { "vtkTable" };

/**
 * Returns a shape of the kind of the data. Throws std::invalid_argument for data that cannot be a
 * target, and for missing or unsuitable arrays.
 */
std::unique_ptr<InputShape> MakeInputShape(const InputData& input);

}

#endif
