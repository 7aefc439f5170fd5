// Point arrays of the skin other than the normals.

#ifndef SkinArrays_h
#define SkinArrays_h

#include "Pipeline/SurfaceProperties.h"

#include "vtkSmartPointer.h"

class vtkFloatArray;
class vtkPolyData;

namespace activesurface
{

// Return true if a requested array needs the outward normals, or the speeds of the skin's vertices.
bool NeedNormals(const OutputProperties& properties);
bool NeedSpeeds(const OutputProperties& properties);

// Returns the array "MeanCurvature" of a band's skin.
vtkSmartPointer<vtkFloatArray> MakeCurvature(const NarrowBand& band);

// Adds the requested arrays. The simulation must be at the requested time, and `skin` must have its
// points. normals: outward normals at the points; used only if NeedNormals returns true.
void AddSkinArrays(const OutputProperties& properties, const SurfaceSimulation& simulation,
  const vtkFloatArray* normals, vtkPolyData* skin);

}

#endif
