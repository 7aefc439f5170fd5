// Requests the whole of an input, for any requested piece of an output.

#ifndef WholeInput_h
#define WholeInput_h

#include "vtkActiveShapesModule.h"

class vtkInformation;

namespace activesurface
{

// Requests piece 0 of 1 without ghosts and, of an image, its whole extent.
VTKACTIVESHAPES_EXPORT void RequestWhole(vtkInformation* input);

}

#endif
