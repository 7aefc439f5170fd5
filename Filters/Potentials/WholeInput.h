// Requests to an input of which all is needed, whatever piece of an output is asked for.

#ifndef WholeInput_h
#define WholeInput_h

#include "vtkActivePotentialsModule.h"

class vtkInformation;

namespace activesurface
{

// Piece 0 of 1 without ghosts and, of an image, its whole extent.
VTKACTIVEPOTENTIALS_EXPORT void RequestWhole(vtkInformation* input);

}

#endif
