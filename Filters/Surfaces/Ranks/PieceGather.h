// What all ranks have of an input together.
//
// A rank asks for its own piece, and sends what is needed of it to all others; each rank puts the
// pieces together to the same whole. What two pieces share at their border is in the whole once:
// ghosts are left out, equal points of meshes are merged later (see MeshTriangles.h), and nodes of
// images have one place.

#ifndef PieceGather_h
#define PieceGather_h

#include "Agreement.h"
#include "Ranks/InputPiece.h"

#include <string>

namespace activesurface
{

// A round of the ranks: each one's own piece comes in, the whole goes out, the same on each rank;
// an empty vtkPolyData if no rank has anything. `what` is how errors call the input. Throws
// std::invalid_argument for pieces that do not fit together, with the same sentence on each rank.
vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what);

}

#endif
