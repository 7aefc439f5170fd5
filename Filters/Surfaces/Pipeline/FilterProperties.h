// The properties of a vtkActiveImplicitSurface as settings.

#ifndef FilterProperties_h
#define FilterProperties_h

#include "Simulation/SurfaceSettings.h"

class vtkActiveImplicitSurface;

namespace activesurface
{

// All but what depends on the inputs: InputMoves, Arrays, HasInitialInput, their stamps, and Steps.
SurfaceSettings ReadProperties(vtkActiveImplicitSurface* filter);

}

#endif
