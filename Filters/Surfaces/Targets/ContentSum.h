// Checksums of data sets, to detect a change of a time step that is read again.

#ifndef ContentSum_h
#define ContentSum_h

#include <cstdint>

class vtkDataSet;

namespace activesurface
{

// Returns a checksum of points, numeric point arrays, the cells of a vtkPolyData except vertices,
// and the extent, origin and spacing of an image. The result does not depend on the order of the
// points if there are neither such cells nor an image.
std::uint64_t SumContent(vtkDataSet* data);

}

#endif
