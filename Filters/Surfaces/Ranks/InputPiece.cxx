#include "Ranks/InputPiece.h"

#include "Input/AttachedData.h"
#include "Ranks/WholeOfPieces.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtentTranslator.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>
#include <string>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

namespace
{

bool IsDuplicate(unsigned char ghost)
{
  return (ghost & vtkDataSetAttributes::DUPLICATEPOINT) != 0;
}

// Returns true for a wanted array that has a name and one tuple for each point, and is not the
// ghost array.
bool IsSent(vtkAbstractArray* array, const PieceArrays& arrays, vtkIdType points)
{
  const auto& chosen = arrays.Chosen;
  const std::string name = array->GetName() ? array->GetName() : "";
  const bool isWanted =
    arrays.All || std::find(chosen.begin(), chosen.end(), array) != chosen.end();
  return isWanted && !name.empty() && name != vtkDataSetAttributes::GhostArrayName() &&
    array->GetNumberOfTuples() == points;
}

void RemoveUnsent(const PieceArrays& arrays, vtkPointData* data, vtkIdType points)
{
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (!IsSent(data->GetAbstractArray(i), arrays, points))
    {
      data->RemoveArray(i);
    }
  }
}

// Returns the selected points with their arrays, and one vertex cell if `points` has cells.
vtkSmartPointer<vtkPolyData> SelectPoints(vtkPolyData* points, vtkIdList* selected)
{
  const vtkIdType count = selected->GetNumberOfIds();
  auto some = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> places;
  places->SetDataType(points->GetPoints()->GetDataType());
  points->GetPoints()->GetPoints(selected, places);
  some->SetPoints(places);
  vtkNew<vtkIdList> order;
  order->SetNumberOfIds(count);
  std::iota(order->begin(), order->end(), vtkIdType(0));
  some->GetPointData()->CopyAllOn();
  some->GetPointData()->CopyAllocate(points->GetPointData(), count);
  some->GetPointData()->CopyData(points->GetPointData(), selected, order);
  if (points->GetNumberOfCells() > 0 && count > 0)
  {
    MakeOneCell(some);
  }
  return some;
}

// Removes duplicate points, which another rank owns.
void RemoveDuplicates(vtkUnsignedCharArray* ghosts, vtkPolyData* points)
{
  vtkNew<vtkIdList> kept;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    if (!IsDuplicate(ghosts->GetValue(i)))
    {
      kept->InsertNextId(i);
    }
  }
  if (kept->GetNumberOfIds() == points->GetNumberOfPoints())
  {
    return;
  }
  points->ShallowCopy(SelectPoints(points, kept));
}

}

void RequestPiece(vtkInformation* input, int rank, int size)
{
  input->Set(SDDP::UPDATE_PIECE_NUMBER(), rank);
  input->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), size);
  input->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (input->Has(SDDP::WHOLE_EXTENT()))
  {
    int extent[6];
    vtkNew<vtkExtentTranslator> translator;
    translator->PieceToExtentThreadSafe(
      rank, size, 0, input->Get(SDDP::WHOLE_EXTENT()), extent, vtkExtentTranslator::BLOCK_MODE, 0);
    input->Set(SDDP::UPDATE_EXTENT(), extent, 6);
  }
}

InputPiece MakeParticlePiece(vtkPointSet* points, const PieceArrays& arrays)
{
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->SetPoints(points->GetPoints());
  piece->GetPointData()->ShallowCopy(points->GetPointData());
  RemoveUnsent(arrays, piece->GetPointData(), points->GetNumberOfPoints());
  if (auto ghosts = points->GetPointGhostArray())
  {
    RemoveDuplicates(ghosts, piece);
  }
  if (points->GetNumberOfCells() > 0)
  {
    MakeOneCell(piece);
  }
  return piece->GetNumberOfPoints() > 0 ? InputPiece{ PieceKind::Particles, piece } : InputPiece();
}

InputPiece MakeCellPiece(vtkPolyData* cells, const PieceArrays& arrays)
{
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  if (cells->GetCellGhostArray())
  {
    piece->DeepCopy(cells); // RemoveGhostCells must not change the input's cells
    piece->RemoveGhostCells();
  }
  else
  {
    piece->ShallowCopy(cells);
  }
  PieceArrays copies{ arrays.All, {} };
  for (vtkAbstractArray* array : arrays.Chosen)
  {
    const char* name = array ? array->GetName() : nullptr;
    copies.Chosen.push_back(name ? piece->GetPointData()->GetAbstractArray(name) : nullptr);
  }
  RemoveUnsent(copies, piece->GetPointData(), piece->GetNumberOfPoints());
  piece->GetCellData()->Initialize();
  piece->SetVerts(nullptr);
  return { PieceKind::Cells, piece };
}

InputPiece MakeImagePiece(vtkImageData* image, vtkAbstractArray* values)
{
  auto piece = vtkSmartPointer<vtkImageData>::New();
  piece->CopyStructure(image);
  if (!values)
  {
    CopyAttachedGrid(image->GetInformation(), piece->GetInformation());
    return { PieceKind::GridImage, piece };
  }
  piece->GetPointData()->AddArray(values);
  if (values->GetName() && values == image->GetPointData()->GetScalars())
  {
    piece->GetPointData()->SetActiveScalars(values->GetName());
  }
  return { PieceKind::Image, piece };
}

}
