// Converts a surface to VTK data.

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

// Writes the triangles of the skin. For an empty surface the output is empty but valid. Fills the
// outward normals at the points unless `normals` is null.
void FillSkin(const NarrowBand& band, vtkFloatArray* normals, vtkPolyData* skin);

// Converts points relative to an origin to world coordinates in double precision. Changes nothing
// if the origin is zero.
void MoveToWorld(const std::array<double, 3>& origin, vtkPolyData* skin);

// Writes distances on an extent of the lattice as scalars "Potential". origin: position of node 0.
void FillPotential(const NarrowBand& band, const int extent[6], const std::array<double, 3>& origin,
  vtkImageData* potential);

// Fills an empty table: one row for each history row, one column for each member, with its name.
void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table);

}

#endif
