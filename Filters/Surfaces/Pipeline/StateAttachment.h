// Attaches the time and the surface's state to an output, for file writers.

#ifndef StateAttachment_h
#define StateAttachment_h

class vtkDataObject;
class vtkPointData;

namespace activesurface
{

class SurfaceSimulation;
struct OutputProperties;

// The simulation must be at the requested time. arrays: the arrays of the whole skin if `data` has
// only this rank's part; else null.
void AttachState(const OutputProperties& properties, const SurfaceSimulation& simulation,
  vtkDataObject* data, vtkPointData* arrays);

}

#endif
