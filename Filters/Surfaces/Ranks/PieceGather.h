// What all ranks have of an input together; see InputPiece.h.

#ifndef PieceGather_h
#define PieceGather_h

#include "Agreement.h"
#include "Ranks/InputPiece.h"

#include <cstdint>
#include <string>

namespace activesurface
{

// Facts of a rank's piece of an input.
struct PieceFacts
{
  PieceKind Kind = PieceKind::Nothing;
  bool HasCells = false;
  std::uint64_t Points = 0;
  std::uint64_t Content = 0; // checksum
};

// What all pieces are together.
struct AllPieces
{
  PieceKind Kind = PieceKind::Nothing; // if none has anything
  bool HaveCells = false;
  std::uint64_t Points = 0;
  std::uint64_t PointsBefore = 0; // of lower ranks
  std::uint64_t Content = 0;
};

// A round of the ranks. Throws std::invalid_argument for pieces of several kinds, with the same
// sentence on each rank.
AllPieces AgreeOnPieces(const Agreement& ranks, const PieceFacts& own, const std::string& what);

// A round of the ranks: each one's own piece comes in, the whole goes out, the same on each rank;
// an empty vtkPolyData if no rank has anything. `what` is how errors call the input. Throws
// std::invalid_argument for pieces that do not fit together, with the same sentence on each rank.
vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what);

}

#endif
