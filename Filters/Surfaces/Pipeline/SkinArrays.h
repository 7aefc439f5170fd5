// The point arrays that the skin has besides its points and normals.

#ifndef SkinArrays_h
#define SkinArrays_h

#include "Pipeline/SurfaceProperties.h"

#include "vtkSmartPointer.h"

class vtkFloatArray;
class vtkPolyData;

namespace activesurface
{

// Whether one of them needs the outward normals, or the speeds of the skin's vertices.
bool NeedNormals(const OutputProperties& properties);
bool NeedSpeeds(const OutputProperties& properties);

// "MeanCurvature", of the skin of a band.
vtkSmartPointer<vtkFloatArray> MakeCurvature(const NarrowBand& band);

// From a simulation at the requested time, whose skin has its points. normals: at these points;
// empty if nothing needs them.
void AddSkinArrays(const OutputProperties& properties, const SurfaceSimulation& simulation,
  const vtkFloatArray* normals, vtkPolyData* skin);

}

#endif
