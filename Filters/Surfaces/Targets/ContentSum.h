// Checksums of data sets, to find out whether a time step that is read again has changed.

#ifndef ContentSum_h
#define ContentSum_h

#include <cstdint>

class vtkDataSet;

namespace activesurface
{

class Agreement;
class InputShape;

// Points, point arrays, and the cells of a vtkPolyData. Of points without other cells than vertices
// their order does not matter: the sum of all is the sum of those of the pieces, modulo 2^64.
std::uint64_t SumContent(vtkDataSet* data);

// True if two shapes were made of the same data; on several ranks, of all their pieces. Collective.
bool HaveSameContent(const InputShape& one, const InputShape& other, Agreement* ranks);

}

#endif
