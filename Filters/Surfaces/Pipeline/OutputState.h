// The time and the state of a surface, which its outputs carry: for writers of files.

#ifndef OutputState_h
#define OutputState_h

class vtkActiveImplicitSurface;
class vtkDataObject;

namespace activesurface
{

class SurfaceSimulation;

// Of a simulation at its goal.
void PublishState(
  vtkActiveImplicitSurface* filter, const SurfaceSimulation& simulation, vtkDataObject* data);

}

#endif
