// Pieces put together, in the order of the ranks.

#ifndef WholeOfPieces_h
#define WholeOfPieces_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace activesurface
{

// A vertex of all points: the sign that particles had cells.
void MakeOneCell(vtkPolyData* points);

// Of one kind, null where a rank has nothing, at least one not null. Point arrays that a piece does
// not have are left out. Throw std::invalid_argument for pieces that do not fit.
vtkSmartPointer<vtkDataSet> AppendPieces(
  const std::vector<vtkDataSet*>& pieces, const std::string& what);
vtkSmartPointer<vtkDataSet> AssembleImage(
  const std::vector<vtkDataSet*>& pieces, const std::string& what);

}

#endif
