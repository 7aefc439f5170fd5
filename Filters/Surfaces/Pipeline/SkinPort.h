// The skin of a filter, with all that its properties want of it.

#ifndef SkinPort_h
#define SkinPort_h

#include "Simulation/SurfaceSimulation.h"

class vtkActiveImplicitSurface;
class vtkPolyData;

namespace activesurface
{

class SurfaceInput;

SkinWishes ReadWishes(vtkActiveImplicitSurface* filter, const SurfaceInput& target);

// Of a simulation that is at its goal and was told the wishes.
void FillSkinPort(
  vtkActiveImplicitSurface* filter, SurfaceSimulation& simulation, vtkPolyData* skin);

}

#endif
