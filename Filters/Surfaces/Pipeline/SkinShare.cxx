#include "Pipeline/SkinShare.h"

#include "NarrowBand.h"
#include "Surface/Skin.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <vector>

namespace activesurface
{

namespace
{

using Ranges = std::vector<Skin::TriangleRange>;

// Calls visit(triangle) for each triangle of the ranges.
template <class Visit>
void ForEachTriangle(const Ranges& ranges, Visit&& visit)
{
  for (const Skin::TriangleRange& range : ranges)
  {
    for (std::size_t i = range.First; i < range.Last; ++i)
    {
      visit(static_cast<vtkIdType>(i));
    }
  }
}

// Points of the triangles in their order, and for each point of the skin its index among them, or
// -1.
struct UsedPoints
{
  vtkNew<vtkIdList> Points;
  std::vector<vtkIdType> Places;

  UsedPoints(vtkPolyData* skin, const Ranges& ranges)
    : Places(static_cast<std::size_t>(skin->GetNumberOfPoints()), -1)
  {
    vtkNew<vtkIdList> corners;
    ForEachTriangle(ranges,
      [&](vtkIdType i)
      {
        skin->GetPolys()->GetCellAtId(i, corners);
        for (vtkIdType corner : *corners)
        {
          this->Places[static_cast<std::size_t>(corner)] = 0;
        }
      });
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
  vtkCellArray* whole, const Ranges& ranges, const std::vector<vtkIdType>& places)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> corners;
  ForEachTriangle(ranges,
    [&](vtkIdType i)
    {
      whole->GetCellAtId(i, corners);
      for (vtkIdType& corner : *corners)
      {
        corner = places[static_cast<std::size_t>(corner)];
      }
      cells->InsertNextCell(corners);
    });
  return cells;
}

// numbers: for each point of `skin`, its index in the skin of all ranks.
void AddGlobalIds(vtkIdList* points, const std::vector<std::int64_t>& numbers, vtkPointData* arrays)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalPointIds");
  ids->SetNumberOfValues(points->GetNumberOfIds());
  for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
  {
    ids->SetValue(i, static_cast<vtkIdType>(numbers[static_cast<std::size_t>(points->GetId(i))]));
  }
  arrays->SetGlobalIds(ids);
}

// Returns the arrays at these points.
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
  return arrays;
}

void KeepTriangles(
  const Ranges& ranges, const std::vector<std::int64_t>& numbers, vtkPolyData* skin)
{
  const UsedPoints used(skin, ranges);
  vtkNew<vtkPoints> points;
  points->SetDataType(skin->GetPoints()->GetDataType());
  skin->GetPoints()->GetPoints(used.Points, points);
  const auto cells = Renumber(skin->GetPolys(), ranges, used.Places);
  const auto arrays = CopyArrays(skin->GetPointData(), used.Points);
  AddGlobalIds(used.Points, numbers, arrays);
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
  if (share.Rank == 0 && !band.GetPart())
  {
    whole = vtkSmartPointer<vtkPointData>::New();
    whole->ShallowCopy(skin->GetPointData());
  }
  const Skin triangles(band);
  KeepTriangles(triangles.ListTriangles(share.Rank, share.Size), triangles.NumberVertices(), skin);
  return whole;
}

}
