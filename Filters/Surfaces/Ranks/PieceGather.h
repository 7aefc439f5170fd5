// Gathers the pieces of an input from all ranks; see InputPiece.h.

#ifndef PieceGather_h
#define PieceGather_h

#include "Ranks/Agreement.h"
#include "Ranks/InputPiece.h"

#include <cstdint>
#include <string>

namespace activesurface
{

// Facts of one rank's piece of an input. HasCells and Points are set for particles only.
struct PieceFacts
{
  PieceKind Kind = PieceKind::Nothing;
  bool HasCells = false;
  std::uint64_t Points = 0;
  std::uint64_t Content = 0; // checksum
};

// Facts of the whole input.
struct AllPieces
{
  PieceKind Kind = PieceKind::Nothing; // Nothing if no rank has data
  bool HaveCells = false;
  std::uint64_t Points = 0;
  std::uint64_t PointsBefore = 0; // points in the pieces of lower ranks
  std::uint64_t Content = 0;
};

// Combines the facts of all pieces. Throws std::invalid_argument, with the same message on each
// rank, for pieces of several kinds. `what` names the input in messages. Collective.
AllPieces AgreeOnPieces(const Agreement& ranks, const PieceFacts& own, const std::string& what);

// Assembles the pieces of all ranks and returns the same whole on each rank; an empty vtkPolyData
// if no rank has data. `what` names the input in messages. Throws std::invalid_argument, with the
// same message on each rank, for incompatible pieces. Collective.
vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what);

}

#endif
