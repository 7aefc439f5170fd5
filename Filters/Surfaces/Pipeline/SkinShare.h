// Distributes the skin over the ranks of a parallel program.

#ifndef SkinShare_h
#define SkinShare_h

#include "Pipeline/OutputShare.h"

#include "vtkSmartPointer.h"

class vtkPointData;
class vtkPolyData;

namespace activesurface
{

class NarrowBand;

// Reduces a skin to this rank's triangles and their points, and adds the array "GlobalPointIds"
// with the point indices in the whole skin. Points at the border of two parts are in both, bitwise
// identical. Returns the arrays of the whole skin on rank 0, for writers, if the band is whole;
// else null. Changes nothing in a program of one process.
vtkSmartPointer<vtkPointData> KeepShare(
  const NarrowBand& band, const OutputShare& share, vtkPolyData* skin);

}

#endif
