// The skin shared out to the ranks of a parallel program.

#ifndef SkinShare_h
#define SkinShare_h

#include "Pipeline/OutputShare.h"

#include "vtkSmartPointer.h"

class vtkPointData;
class vtkPolyData;

namespace activesurface
{

class NarrowBand;

// Leaves this rank's triangles of a skin, with their points and the array "GlobalPointIds", the
// points' numbers in the whole: points at a border are on both sides of it, with the same bytes.
// Returns the arrays of the whole on rank 0, for writers, if the band is whole; else null. Does
// nothing if the share is all.
vtkSmartPointer<vtkPointData> KeepShare(
  const NarrowBand& band, const OutputShare& share, vtkPolyData* skin);

}

#endif
