// Converts particles in a table or in blocks to one point set.

#ifndef ParticleData_h
#define ParticleData_h

#include "vtkActiveParticlesModule.h"

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

class vtkDataObject;

namespace activesurface
{

// Returns a vtkDataSet unchanged. Makes a data set from two other classes:
// - Rows of a vtkTable become points. Positions are the columns x, y and z, or a:0 a:1 a:2, a_0
//   ..., a_x ..., or one column a of three numbers. Here a is Points, Position, Coordinates or a
//   similar name, in upper or lower case. Other columns become point arrays; three columns of one
//   vector become one array.
// - The points of all blocks of a vtkDataObjectTree (multi-block, partitioned) are joined in order.
//   A point array is kept if all blocks with points have an array of the same name, type and number
//   of components. If only one block has points, the result is that block; if no block has points,
//   an empty vtkPolyData.
// Returns null for any other class and for adaptive mesh refinement (AMR). Throws
// std::invalid_argument for a table without numeric positions, for a block that is neither data set
// nor table, or if one of several blocks with points does not consist of particles.
VTKACTIVEPARTICLES_EXPORT vtkSmartPointer<vtkDataSet> AsDataSet(vtkDataObject* data);

// Returns true for AMR, whose blocks may overlap. AMR is a vtkDataObjectTree since VTK 9.6.
VTKACTIVEPARTICLES_EXPORT bool HasLevels(vtkDataObject* data);

}

#endif
