// Particles that come as a table, or in blocks, as one point set.

#ifndef ParticleData_h
#define ParticleData_h

#include "vtkActivePotentialsModule.h"

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

class vtkDataObject;

namespace activesurface
{

// The data set that it is itself, or that is made of it:
// - of a vtkTable, points. Positions are its columns x, y and z, or a:0 a:1 a:2, a_0 ..., a_x ...,
//   or one column a of three numbers, where a is Points, Position, Coordinates or the like, in
//   upper or lower case. Other columns become point arrays, three that belong together one of
//   vectors.
// - of a vtkDataObjectTree (multi-block, partitioned), the points of all blocks in their order,
//   with the point arrays that all blocks with points have, of one type; where one block alone has
//   points, that block as it is.
// Null for any other class, and for levels of refinement (AMR). Throws std::invalid_argument for
// what is none of these.
VTKACTIVEPOTENTIALS_EXPORT vtkSmartPointer<vtkDataSet> AsDataSet(vtkDataObject* data);

// Whether it is AMR: a vtkDataObjectTree since VTK 9.6, but its blocks overlap.
VTKACTIVEPOTENTIALS_EXPORT bool HasLevels(vtkDataObject* data);

}

#endif
