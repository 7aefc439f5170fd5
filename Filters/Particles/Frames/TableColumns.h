// Finds positions and vectors among the columns of a table of particles.

#ifndef TableColumns_h
#define TableColumns_h

#include "vtkSmartPointer.h"

class vtkPolyData;
class vtkTable;

namespace activesurface
{

// Converts rows to points and the other columns to point arrays. Throws std::invalid_argument for a
// table without positions.
vtkSmartPointer<vtkPolyData> MakePoints(vtkTable* table);

}

#endif
