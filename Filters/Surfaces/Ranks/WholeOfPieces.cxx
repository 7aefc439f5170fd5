#include "Ranks/WholeOfPieces.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

namespace activesurface
{

namespace
{

using Pieces = std::vector<vtkDataSet*>;

vtkDataSet* FindFirst(const Pieces& pieces)
{
  return *std::find_if(pieces.begin(), pieces.end(), [](vtkDataSet* piece) { return piece; });
}

bool AreAlike(vtkAbstractArray* a, vtkAbstractArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

// Returns the pieces' arrays of this name, with null for a null piece; an empty list if a piece
// with data lacks the array.
std::vector<vtkAbstractArray*> FindArrays(
  const Pieces& pieces, const char* name, const std::string& what)
{
  vtkAbstractArray* first = nullptr;
  std::size_t firstRank = 0;
  std::vector<vtkAbstractArray*> arrays(pieces.size(), nullptr);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    if (!pieces[rank])
    {
      continue;
    }
    vtkAbstractArray* array = pieces[rank]->GetPointData()->GetAbstractArray(name);
    if (!array)
    {
      return {};
    }
    firstRank = first ? firstRank : rank;
    first = first ? first : array;
    if (!AreAlike(first, array))
    {
      throw std::invalid_argument(what + " has the array \"" + name +
        "\" with another type or number of components on rank " + std::to_string(rank) +
        " than on rank " + std::to_string(firstRank) + "; make both the same on all ranks.");
    }
    arrays[rank] = array;
  }
  return arrays;
}

vtkSmartPointer<vtkAbstractArray> MakeArray(vtkAbstractArray* like, vtkIdType tuples)
{
  vtkSmartPointer<vtkAbstractArray> array;
  array.TakeReference(like->NewInstance());
  array->SetName(like->GetName());
  array->SetNumberOfComponents(like->GetNumberOfComponents());
  array->SetNumberOfTuples(tuples);
  return array;
}

// Copies the active attributes of the first piece.
void CopyAttributes(vtkPointData* from, vtkPointData* to)
{
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* array = from->GetAbstractAttribute(type);
    if (array && to->HasArray(array->GetName()))
    {
      to->SetActiveAttribute(array->GetName(), type);
    }
  }
}

void AppendArrays(const Pieces& pieces, const std::string& what, vtkDataSet* whole)
{
  vtkPointData* reference = FindFirst(pieces)->GetPointData();
  for (int i = 0; i < reference->GetNumberOfArrays(); ++i)
  {
    const char* name = reference->GetAbstractArray(i)->GetName();
    vtkIdType begin = 0;
    vtkSmartPointer<vtkAbstractArray> array;
    for (vtkAbstractArray* part : FindArrays(pieces, name, what))
    {
      if (part)
      {
        array = array ? array : MakeArray(part, whole->GetNumberOfPoints());
        array->InsertTuples(begin, part->GetNumberOfTuples(), 0, part);
        begin += part->GetNumberOfTuples();
      }
    }
    if (array)
    {
      whole->GetPointData()->AddArray(array);
    }
  }
  CopyAttributes(reference, whole->GetPointData());
}

// Joins the points, in double precision if one piece has double precision.
vtkSmartPointer<vtkPoints> AppendPoints(const Pieces& pieces)
{
  vtkIdType count = 0;
  bool isDouble = false;
  for (vtkDataSet* piece : pieces)
  {
    if (piece)
    {
      count += piece->GetNumberOfPoints();
      isDouble =
        isDouble || vtkPointSet::SafeDownCast(piece)->GetPoints()->GetDataType() == VTK_DOUBLE;
    }
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(isDouble ? VTK_DOUBLE : VTK_FLOAT);
  points->SetNumberOfPoints(count);
  vtkIdType next = 0;
  for (vtkDataSet* piece : pieces)
  {
    for (vtkIdType i = 0; piece && i < piece->GetNumberOfPoints(); ++i)
    {
      points->SetPoint(next++, piece->GetPoint(i));
    }
  }
  return points;
}

vtkSmartPointer<vtkCellArray> AppendCells(const Pieces& pieces, vtkCellArray* (vtkPolyData::*get)())
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  vtkIdType before = 0;
  for (vtkDataSet* piece : pieces)
  {
    if (piece)
    {
      cells->Append((vtkPolyData::SafeDownCast(piece)->*get)(), before);
      before += piece->GetNumberOfPoints();
    }
  }
  return cells;
}

bool AreOnOneLattice(vtkImageData* a, vtkImageData* b)
{
  const double* matrix = a->GetDirectionMatrix()->GetData();
  return std::equal(a->GetOrigin(), a->GetOrigin() + 3, b->GetOrigin()) &&
    std::equal(a->GetSpacing(), a->GetSpacing() + 3, b->GetSpacing()) &&
    std::equal(matrix, matrix + 9, b->GetDirectionMatrix()->GetData());
}

// Returns an image on the lattice of the pieces that contains all their extents. Skips null pieces.
vtkSmartPointer<vtkImageData> MakeWholeImage(const Pieces& pieces, const std::string& what)
{
  auto first = vtkImageData::SafeDownCast(FindFirst(pieces));
  int whole[6];
  first->GetExtent(whole);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    auto image = vtkImageData::SafeDownCast(pieces[rank]);
    if (image && !AreOnOneLattice(first, image))
    {
      throw std::invalid_argument(what +
        ", an image, has another origin, spacing or direction on rank " + std::to_string(rank) +
        " than on a lower rank; place all pieces on one lattice.");
    }
    for (int axis = 0; image && axis < 3; ++axis)
    {
      const int* extent = image->GetExtent();
      whole[2 * axis] = std::min(whole[2 * axis], extent[2 * axis]);
      whole[2 * axis + 1] = std::max(whole[2 * axis + 1], extent[2 * axis + 1]);
    }
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(first);
  image->SetExtent(whole);
  return image;
}

// Copies the values of a piece row by row and marks the copied nodes in isKnown.
void CopyRows(vtkImageData* piece, vtkAbstractArray* from, vtkImageData* whole,
  vtkAbstractArray* to, std::vector<char>& isKnown)
{
  const int* extent = piece->GetExtent();
  const vtkIdType length = extent[1] - extent[0] + 1;
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int y = extent[2]; y <= extent[3]; ++y)
    {
      int first[3] = { extent[0], y, z };
      const vtkIdType place = whole->ComputePointId(first);
      to->InsertTuples(place, length, piece->ComputePointId(first), from);
      std::fill_n(isKnown.begin() + place, length, char(1));
    }
  }
}

}

void MakeOneCell(vtkPolyData* points)
{
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(1));
  cells->InsertCellPoint(0);
  points->SetVerts(cells);
}

vtkSmartPointer<vtkDataSet> AppendPieces(const Pieces& pieces, const std::string& what)
{
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  whole->SetPoints(AppendPoints(pieces));
  whole->SetVerts(AppendCells(pieces, &vtkPolyData::GetVerts));
  whole->SetLines(AppendCells(pieces, &vtkPolyData::GetLines));
  whole->SetPolys(AppendCells(pieces, &vtkPolyData::GetPolys));
  whole->SetStrips(AppendCells(pieces, &vtkPolyData::GetStrips));
  AppendArrays(pieces, what, whole);
  return whole;
}

vtkSmartPointer<vtkDataSet> AssembleImage(const Pieces& pieces, const std::string& what)
{
  const vtkSmartPointer<vtkImageData> whole = MakeWholeImage(pieces, what);
  vtkPointData* reference = FindFirst(pieces)->GetPointData();
  for (int i = 0; i < reference->GetNumberOfArrays(); ++i)
  {
    const char* name = reference->GetAbstractArray(i)->GetName();
    const std::vector<vtkAbstractArray*> parts = FindArrays(pieces, name, what);
    if (parts.empty())
    {
      throw std::invalid_argument(what + ", an image, has the array \"" + name +
        "\" on some ranks but not on others; give all pieces an array of the same name.");
    }
    std::vector<char> isKnown(static_cast<std::size_t>(whole->GetNumberOfPoints()), char(0));
    const auto values = MakeArray(reference->GetAbstractArray(i), whole->GetNumberOfPoints());
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
    {
      if (parts[rank])
      {
        CopyRows(vtkImageData::SafeDownCast(pieces[rank]), parts[rank], whole, values, isKnown);
      }
    }
    if (std::find(isKnown.begin(), isKnown.end(), char(0)) != isKnown.end())
    {
      throw std::invalid_argument(what +
        ", an image, has points that are in no rank's piece; "
        "make pieces that fill the whole extent.");
    }
    whole->GetPointData()->AddArray(values);
  }
  CopyAttributes(reference, whole->GetPointData());
  return whole;
}

}
