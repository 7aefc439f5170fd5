#include "Pipeline/SkinShare.h"

#include "NarrowBand.h"
#include "Skin.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <vector>

namespace activesurface
{

namespace
{

struct Triangles
{
  vtkIdType First;
  vtkIdType Last; // not included
};

// The points of the triangles, in the order of the whole; and of each point of the whole its place
// among them, or -1.
struct UsedPoints
{
  vtkNew<vtkIdList> Points;
  std::vector<vtkIdType> Places;

  UsedPoints(vtkPolyData* skin, const Triangles& triangles)
    : Places(static_cast<std::size_t>(skin->GetNumberOfPoints()), -1)
  {
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = triangles.First; i < triangles.Last; ++i)
    {
      skin->GetPolys()->GetCellAtId(i, corners);
      for (vtkIdType corner : *corners)
      {
        this->Places[static_cast<std::size_t>(corner)] = 0;
      }
    }
    for (std::size_t i = 0; i < this->Places.size(); ++i)
    {
      if (this->Places[i] == 0)
      {
        this->Places[i] = this->Points->GetNumberOfIds();
        this->Points->InsertNextId(static_cast<vtkIdType>(i));
      }
    }
  }
};

vtkSmartPointer<vtkCellArray> Renumber(
  vtkCellArray* whole, const Triangles& triangles, const std::vector<vtkIdType>& places)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = triangles.First; i < triangles.Last; ++i)
  {
    whole->GetCellAtId(i, corners);
    for (vtkIdType& corner : *corners)
    {
      corner = places[static_cast<std::size_t>(corner)];
    }
    cells->InsertNextCell(corners);
  }
  return cells;
}

void AddGlobalIds(vtkIdList* numbers, vtkPointData* arrays)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalPointIds");
  ids->SetNumberOfValues(numbers->GetNumberOfIds());
  for (vtkIdType i = 0; i < numbers->GetNumberOfIds(); ++i)
  {
    ids->SetValue(i, numbers->GetId(i));
  }
  arrays->SetGlobalIds(ids);
}

// The arrays of the whole at these points.
vtkSmartPointer<vtkPointData> CopyArrays(vtkPointData* whole, vtkIdList* points)
{
  vtkNew<vtkIdList> order;
  order->SetNumberOfIds(points->GetNumberOfIds());
  for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
  {
    order->SetId(i, i);
  }
  auto arrays = vtkSmartPointer<vtkPointData>::New();
  arrays->CopyAllOn();
  arrays->CopyAllocate(whole, points->GetNumberOfIds());
  arrays->CopyData(whole, points, order);
  AddGlobalIds(points, arrays);
  return arrays;
}

void KeepTriangles(const Triangles& triangles, vtkPolyData* skin)
{
  const UsedPoints used(skin, triangles);
  vtkNew<vtkPoints> points;
  points->SetDataType(skin->GetPoints()->GetDataType());
  skin->GetPoints()->GetPoints(used.Points, points);
  const auto cells = Renumber(skin->GetPolys(), triangles, used.Places);
  const auto arrays = CopyArrays(skin->GetPointData(), used.Points);
  skin->SetPoints(points);
  skin->SetPolys(cells);
  skin->GetPointData()->ShallowCopy(arrays);
}

}

vtkSmartPointer<vtkPointData> KeepShare(
  const NarrowBand& band, const OutputShare& share, vtkPolyData* skin)
{
  if (share.IsAll())
  {
    return nullptr;
  }
  vtkSmartPointer<vtkPointData> whole;
  if (share.Rank == 0)
  {
    whole = vtkSmartPointer<vtkPointData>::New();
    whole->ShallowCopy(skin->GetPointData());
  }
  const std::vector<std::size_t> first = Skin(band).ShareTriangles(share.Size);
  const auto rank = static_cast<std::size_t>(share.Rank);
  KeepTriangles(
    { static_cast<vtkIdType>(first[rank]), static_cast<vtkIdType>(first[rank + 1]) }, skin);
  return whole;
}

}
