// Joins pieces in the order of the ranks.

#ifndef WholeOfPieces_h
#define WholeOfPieces_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace activesurface
{

// Gives the points one vertex cell, on point 0: a mark that the particles had cells.
void MakeOneCell(vtkPolyData* points);

// Join pieces of one kind. A piece is null if its rank has no data; at least one is not null.
// AppendPieces omits point arrays that are missing in a piece; AssembleImage throws for such
// arrays. Both functions throw std::invalid_argument for incompatible pieces.
vtkSmartPointer<vtkDataSet> AppendPieces(
  const std::vector<vtkDataSet*>& pieces, const std::string& what);
vtkSmartPointer<vtkDataSet> AssembleImage(
  const std::vector<vtkDataSet*>& pieces, const std::string& what);

}

#endif
