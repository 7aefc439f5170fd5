// A surface as VTK data.

#ifndef SurfaceOutput_h
#define SurfaceOutput_h

class vtkImageData;
class vtkPolyData;

namespace activesurface
{

class NarrowBand;

// Triangles, with the point array "Normals" if wanted; valid and empty for an empty surface.
void FillSkin(const NarrowBand& band, bool normals, vtkPolyData* skin);

// The distances on an extent of the lattice, as scalars "Potential".
void FillPotential(const NarrowBand& band, const int extent[6], vtkImageData* potential);

}

#endif
