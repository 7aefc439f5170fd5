// A surface as VTK data.

#ifndef SurfaceOutput_h
#define SurfaceOutput_h

#include <array>
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

// Makes points that are relative to an origin world coordinates, in double precision; nothing for
// an origin of zero.
void MoveToWorld(const std::array<double, 3>& origin, vtkPolyData* skin);

// The distances on an extent of the lattice, as scalars "Potential". origin: position of node 0.
void FillPotential(const NarrowBand& band, const int extent[6], const std::array<double, 3>& origin,
  vtkImageData* potential);

// One row each, one column for each member, by its name. Of a table that is empty.
void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table);

}

#endif
