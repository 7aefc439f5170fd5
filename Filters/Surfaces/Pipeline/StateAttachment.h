// The time of an output, and the state of the surface that is attached to it: for writers of files.

#ifndef StateAttachment_h
#define StateAttachment_h

class vtkDataObject;
class vtkPointData;

namespace activesurface
{

class SurfaceSimulation;
struct OutputProperties;

// Of a simulation at the requested time. arrays: those of all of the skin, where the data are a
// part of what this rank has; else null.
void AttachState(const OutputProperties& properties, const SurfaceSimulation& simulation,
  vtkDataObject* data, vtkPointData* arrays);

}

#endif
