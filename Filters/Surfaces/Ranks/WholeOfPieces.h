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

// Join pieces of one kind. A piece is null if its rank has no data; at least one is not null. Of
// the first piece's point arrays, AppendPieces omits those that another piece lacks; AssembleImage
// throws for such arrays. Other arrays are omitted. Both functions throw std::invalid_argument for
// incompatible pieces.
vtkSmartPointer<vtkDataSet> AppendPieces(
  const std::vector<vtkDataSet*>& pieces, const std::string& what);
vtkSmartPointer<vtkDataSet> AssembleImage(
  const std::vector<vtkDataSet*>& pieces, const std::string& what);

}

#endif
