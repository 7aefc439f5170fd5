// A surface as VTK data.

#ifndef SurfaceOutput_h
#define SurfaceOutput_h

#include <vector>

class vtkFloatArray;
class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace activesurface
{

class NarrowBand;
struct HistoryRow;

// Triangles; valid and empty for an empty surface. Fills the outward normals at the points, unless
// they are null.
void FillSkin(const NarrowBand& band, vtkFloatArray* normals, vtkPolyData* skin);

// The distances on an extent of the lattice, as scalars "Potential".
void FillPotential(const NarrowBand& band, const int extent[6], vtkImageData* potential);

// One row each, one column for each member, by its name. Of a table that is empty.
void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table);

}

#endif
