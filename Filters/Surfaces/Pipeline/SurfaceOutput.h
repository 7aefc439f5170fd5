// A surface as VTK data.

#ifndef SurfaceOutput_h
#define SurfaceOutput_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkFloatArray;
class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace activesurface
{

class NarrowBand;
struct HistoryRow;

// Which point arrays the skin has besides.
struct SkinArrays
{
  bool Normals = true;
  const std::vector<float>* Curvatures = nullptr; // "MeanCurvature", if not null
  const std::vector<float>* Speeds = nullptr;     // along the normals: "Velocity", if not null
};

// Triangles; valid and empty for an empty surface. Returns the outward normals, whether the skin
// has them or not; empty if nothing needs them.
vtkSmartPointer<vtkFloatArray> FillSkin(
  const NarrowBand& band, const SkinArrays& arrays, vtkPolyData* skin);

// The distances on an extent of the lattice, as scalars "Potential".
void FillPotential(const NarrowBand& band, const int extent[6], vtkImageData* potential);

// One row each, one column for each member, by its name.
void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table);

}

#endif
