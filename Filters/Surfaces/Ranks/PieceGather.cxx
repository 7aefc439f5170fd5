#include "Ranks/PieceGather.h"

#include "AttachedData.h"
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

// The kind of those ranks that have anything.
PieceKind FindKind(const std::vector<InputPiece>& pieces, const std::string& what)
{
  PieceKind kind = PieceKind::Nothing;
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const PieceKind own = pieces[rank].Kind;
    if (kind == PieceKind::Nothing)
    {
      kind = own;
      first = rank;
    }
    else if (own != PieceKind::Nothing && own != kind)
    {
      throw std::invalid_argument(what + " is of one kind on rank " + std::to_string(first) +
        " and of another on rank " + std::to_string(rank) +
        "; particles, meshes and skeletons, and images cannot be pieces of one input.");
    }
  }
  return kind;
}

}

vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what)
{
  std::vector<InputPiece> pieces;
  for (const Bytes& bytes : ranks.Exchange(PackPiece(own)))
  {
    pieces.push_back(UnpackPiece(bytes));
  }
  const PieceKind kind = FindKind(pieces, what);
  std::vector<vtkDataSet*> parts(pieces.size());
  std::transform(pieces.begin(), pieces.end(), parts.begin(),
    [](const InputPiece& piece) { return piece.Data.Get(); });
  switch (kind)
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
      Attach(whole->GetInformation(), GetAttachedGrid((*first)->GetInformation()));
      return whole;
    }
    default:
      return vtkSmartPointer<vtkPolyData>::New();
  }
}

}
