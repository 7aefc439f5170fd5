// Checksums of data sets, to find out whether a time step that is read again has changed.

#ifndef ContentSum_h
#define ContentSum_h

#include <cstdint>

class vtkDataSet;

namespace activesurface
{

// Points, point arrays, and the cells of a vtkPolyData. Of points without other cells than vertices
// their order does not matter.
std::uint64_t SumContent(vtkDataSet* data);

}

#endif
