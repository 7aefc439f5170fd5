// The columns of a table of particles: which are positions, and which are vectors.

#ifndef TableColumns_h
#define TableColumns_h

#include "vtkSmartPointer.h"

class vtkPolyData;
class vtkTable;

namespace activesurface
{

// The rows as points, and the other columns as point arrays. Throws std::invalid_argument for a
// table without positions.
vtkSmartPointer<vtkPolyData> MakePoints(vtkTable* table);

}

#endif
