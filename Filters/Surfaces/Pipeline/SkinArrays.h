// The point arrays that the skin has besides its points and normals.

#ifndef SkinArrays_h
#define SkinArrays_h

#include "Pipeline/SurfaceProperties.h"

class vtkFloatArray;
class vtkPolyData;

namespace activesurface
{

// Whether one of them needs the outward normals.
bool NeedNormals(const OutputProperties& properties);

// From a simulation at the requested time, whose skin has its points. normals: at these points;
// empty if nothing needs them.
void AddSkinArrays(const OutputProperties& properties, const SurfaceSimulation& simulation,
  const vtkFloatArray* normals, vtkPolyData* skin);

}

#endif
