// The time of an output, and the state of the surface that is attached to it: for writers of files.

#ifndef StateAttachment_h
#define StateAttachment_h

class vtkDataObject;

namespace activesurface
{

class SurfaceSimulation;

// Of a simulation at the requested time.
void AttachState(const SurfaceSimulation& simulation, vtkDataObject* data);

}

#endif
