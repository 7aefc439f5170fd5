// Checksums of data sets, which detect whether a time step has changed when it is read again.

#ifndef ContentSum_h
#define ContentSum_h

#include <cstdint>

class vtkDataSet;

namespace activesurface
{

// Sums points, point arrays, the cells of a vtkPolyData except vertices, and the extent, origin and
// spacing of an image. The result does not depend on the order of the points if there are neither
// such cells nor an image.
std::uint64_t SumContent(vtkDataSet* data);

}

#endif
