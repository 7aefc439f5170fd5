#include "Ranks/PieceGather.h"

#include "Input/AttachedData.h"
#include "Ranks/PieceBytes.h"
#include "Ranks/WholeOfPieces.h"

#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Returns the kind of the pieces with data. Throws if two differ.
PieceKind FindKind(const std::vector<PieceKind>& kinds, const std::string& what)
{
  PieceKind kind = PieceKind::Nothing;
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < kinds.size(); ++rank)
  {
    if (kind == PieceKind::Nothing)
    {
      kind = kinds[rank];
      first = rank;
    }
    else if (kinds[rank] != PieceKind::Nothing && kinds[rank] != kind)
    {
      throw std::invalid_argument(what + " is of one kind on rank " + std::to_string(first) +
        " and of another on rank " + std::to_string(rank) +
        "; particles, meshes and skeletons, and images cannot be pieces of one input.");
    }
  }
  return kind;
}

}

AllPieces AgreeOnPieces(const Agreement& ranks, const PieceFacts& own, const std::string& what)
{
  AllPieces all;
  std::vector<PieceKind> kinds;
  for (const PieceFacts& facts : ranks.ExchangeValue(own))
  {
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ull;
    all.PointsBefore += static_cast<int>(kinds.size()) < ranks.GetRank() ? facts.Points : 0;
    all.Points += facts.Points;
    all.Content = (all.Content ^ facts.Content) * factor + facts.Points;
    all.HaveCells = all.HaveCells || facts.HasCells;
    kinds.push_back(facts.Kind);
  }
  all.Kind = FindKind(kinds, what);
  return all;
}

vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what)
{
  std::vector<InputPiece> pieces;
  for (const Bytes& bytes : ranks.Exchange(PackPiece(own)))
  {
    pieces.push_back(UnpackPiece(bytes));
  }
  std::vector<vtkDataSet*> parts;
  std::vector<PieceKind> kinds;
  for (const InputPiece& piece : pieces)
  {
    parts.push_back(piece.Data);
    kinds.push_back(piece.Kind);
  }
  switch (FindKind(kinds, what))
  {
    case PieceKind::Particles:
    case PieceKind::Cells:
      return AppendPieces(parts, what);
    case PieceKind::Image:
      return AssembleImage(parts, what);
    case PieceKind::GridImage:
    {
      vtkSmartPointer<vtkDataSet> whole = AssembleImage(parts, what);
      const auto first =
        std::find_if(parts.begin(), parts.end(), [](vtkDataSet* part) { return part; });
      CopyAttachedGrid((*first)->GetInformation(), whole->GetInformation());
      return whole;
    }
    default:
      return vtkSmartPointer<vtkPolyData>::New();
  }
}

}
