// Point sets and meshes of arbitrary points, cells and arrays: cells of absent points, cells
// without points, arrays of any type and of a wrong length.

#ifndef FuzzData_h
#define FuzzData_h

#include "FuzzInput.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace activesurface
{

constexpr int MostPoints = 24, MostCells = 12, MostCorners = 6;
constexpr const char* ArrayNames[] = { "size", "id", "weight", "velocity" };
// Centre of shapes of size 4. A shape across the origin would allocate eight of OpenVDB's largest
// nodes instead of one, which makes an execution three times as long.
constexpr double Center = 16;

inline void AddPoints(FuzzInput& input, vtkPolyData* data)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(input.Below(2) == 0 ? VTK_FLOAT : VTK_DOUBLE);
  const int count = input.Below(MostPoints);
  for (int i = 0; i < count; ++i)
  {
    const double x = input.TakeNumber(), y = input.TakeNumber(), z = input.TakeNumber();
    points->InsertNextPoint(Center + x, Center + y, Center + z);
  }
  data->SetPoints(points);
}

inline vtkSmartPointer<vtkCellArray> MakeCells(FuzzInput& input, int points)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const int count = input.Below(MostCells);
  for (int i = 0; i < count; ++i)
  {
    const int corners = input.Below(MostCorners);
    cells->InsertNextCell(corners);
    for (int corner = 0; corner < corners; ++corner)
    {
      const bool isAny = input.Below(16) == 0;
      cells->InsertCellPoint(
        isAny || points == 0 ? input.Take<std::int32_t>() : input.Below(points));
    }
  }
  return cells;
}

// Adds an array of this name, of any type, often of a wrong number of tuples or components.
inline void AddArray(FuzzInput& input, const char* name, int points, vtkPolyData* data)
{
  constexpr int types[] = { VTK_FLOAT, VTK_DOUBLE, VTK_INT, VTK_ID_TYPE, VTK_UNSIGNED_CHAR,
    VTK_LONG_LONG };
  const auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(types[input.Below(6)]));
  array->SetName(name);
  array->SetNumberOfComponents(input.Below(8) == 0 ? 3 : 1);
  array->SetNumberOfTuples(input.Below(8) == 0 ? input.Below(MostPoints) : points);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      const double number = input.TakeNumber();
      // Integer arrays get integers: other values may not be representable. The integers are
      // small: as a radius, 100 would make the search of leaves take a hundred milliseconds.
      const bool isFloating =
        array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
      array->SetComponent(i, component, isFloating ? number : input.Below(8));
    }
  }
  data->GetPointData()->AddArray(array);
}

inline vtkSmartPointer<vtkPolyData> MakeData(FuzzInput& input)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  AddPoints(input, data);
  const int points = static_cast<int>(data->GetNumberOfPoints());
  const int kinds = input.Below(16);
  if (kinds & 1)
  {
    data->SetPolys(MakeCells(input, points));
  }
  if (kinds & 2)
  {
    data->SetLines(MakeCells(input, points));
  }
  if (kinds & 4)
  {
    data->SetStrips(MakeCells(input, points));
  }
  if (kinds & 8)
  {
    data->SetVerts(MakeCells(input, points));
  }
  for (const char* name : ArrayNames)
  {
    if (input.Below(2) == 0)
    {
      AddArray(input, name, points, data);
    }
  }
  return data;
}

}

#endif
