// Visits the cells of a vtkCellArray.

#ifndef EachCell_h
#define EachCell_h

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"

namespace activesurface
{

// Calls visit(list of point ids) for each cell; cells may be null.
template <class Visit>
void ForEachCell(vtkCellArray* cells, Visit visit)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cells && cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, ids);
    visit(ids.Get());
  }
}

}

#endif
