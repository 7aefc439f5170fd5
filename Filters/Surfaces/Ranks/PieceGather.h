// What all ranks have of an input together; see InputPiece.h.

#ifndef PieceGather_h
#define PieceGather_h

#include "Agreement.h"
#include "Ranks/InputPiece.h"

#include <string>

namespace activesurface
{

// A round of the ranks: what kind their pieces are of; Nothing if none has anything. Throws
// std::invalid_argument for pieces of several kinds, with the same sentence on each rank.
PieceKind AgreeOnKind(Agreement& ranks, PieceKind own, const std::string& what);

// A round of the ranks: each one's own piece comes in, the whole goes out, the same on each rank;
// an empty vtkPolyData if no rank has anything. `what` is how errors call the input. Throws
// std::invalid_argument for pieces that do not fit together, with the same sentence on each rank.
vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what);

}

#endif
