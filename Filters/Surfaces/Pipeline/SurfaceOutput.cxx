#include "Pipeline/SurfaceOutput.h"

#include "NarrowBand.h"
#include "Simulation/SurfaceHistory.h"
#include "Surface/Skin.h"
#include "Surface/SkinDistance.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeInt64Array.h"

namespace activesurface
{

namespace
{

// Writes the triangles and returns their points in the array's precision.
template <class Array>
vtkSmartPointer<Array> WriteTriangles(const Skin& triangles, float* normals, std::int64_t* corners)
{
  auto coordinates = vtkSmartPointer<Array>::New();
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(triangles.GetNumberOfPoints()));
  triangles.Write(coordinates->GetPointer(0), normals, corners);
  return coordinates;
}

vtkSmartPointer<vtkCellArray> MakeCells(vtkTypeInt64Array* corners)
{
  const vtkIdType count = corners->GetNumberOfValues() / 3;
  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, corners);
  return cells;
}

template <class Array, class Value>
void AddColumn(
  vtkTable* table, const char* name, const std::vector<HistoryRow>& rows, Value HistoryRow::*member)
{
  vtkNew<Array> column;
  column->SetName(name);
  for (const HistoryRow& row : rows)
  {
    column->InsertNextValue(row.*member);
  }
  table->AddColumn(column);
}

}

void FillSkin(const NarrowBand& band, vtkFloatArray* normals, vtkPolyData* skin)
{
  const Skin triangles(band);
  vtkNew<vtkTypeInt64Array> corners;
  corners->SetNumberOfValues(3 * static_cast<vtkIdType>(triangles.GetNumberOfTriangles()));
  auto* corner = reinterpret_cast<std::int64_t*>(corners->GetPointer(0));
  float* normal = nullptr;
  if (normals)
  {
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(static_cast<vtkIdType>(triangles.GetNumberOfPoints()));
    normal = normals->GetPointer(0);
  }
  vtkSmartPointer<vtkDataArray> coordinates;
  if (triangles.NeedsDoublePrecision())
  {
    coordinates = WriteTriangles<vtkDoubleArray>(triangles, normal, corner);
  }
  else
  {
    coordinates = WriteTriangles<vtkFloatArray>(triangles, normal, corner);
  }
  vtkNew<vtkPoints> vertices;
  vertices->SetData(coordinates);
  skin->SetPoints(vertices);
  skin->SetPolys(MakeCells(corners));
}

void MoveToWorld(const std::array<double, 3>& origin, vtkPolyData* skin)
{
  if (origin == std::array<double, 3>{})
  {
    return;
  }
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->DeepCopy(skin->GetPoints()->GetData());
  for (vtkIdType i = 0; i < coordinates->GetNumberOfValues(); ++i)
  {
    coordinates->SetValue(i, coordinates->GetValue(i) + origin[i % 3]);
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  skin->SetPoints(points);
}

void FillPotential(const NarrowBand& band, const int extent[6], const std::array<double, 3>& origin,
  vtkImageData* potential)
{
  const double spacing = band.GetVoxelSize();
  potential->SetExtent(const_cast<int*>(extent));
  potential->SetOrigin(origin.data());
  potential->SetSpacing(spacing, spacing, spacing);
  vtkNew<vtkFloatArray> distances;
  distances->SetName("Potential");
  distances->SetNumberOfTuples(potential->GetNumberOfPoints());
  WriteDistances(band, extent, distances->GetPointer(0));
  potential->GetPointData()->SetScalars(distances);
}

void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table)
{
  AddColumn<vtkDoubleArray>(table, "Time", rows, &HistoryRow::Time);
  AddColumn<vtkIdTypeArray>(table, "Substeps", rows, &HistoryRow::Substeps);
  AddColumn<vtkDoubleArray>(table, "MaxSpeed", rows, &HistoryRow::MaxSpeed);
  AddColumn<vtkDoubleArray>(table, "Area", rows, &HistoryRow::Area);
  AddColumn<vtkDoubleArray>(table, "Volume", rows, &HistoryRow::Volume);
  AddColumn<vtkIdTypeArray>(table, "ActiveVoxels", rows, &HistoryRow::ActiveVoxels);
  AddColumn<vtkIdTypeArray>(table, "Components", rows, &HistoryRow::Components);
  AddColumn<vtkIdTypeArray>(table, "Voids", rows, &HistoryRow::Voids);
  AddColumn<vtkIdTypeArray>(table, "EulerCharacteristic", rows, &HistoryRow::EulerCharacteristic);
  AddColumn<vtkDoubleArray>(table, "Outside", rows, &HistoryRow::Outside);
  AddColumn<vtkStringArray>(table, "Event", rows, &HistoryRow::Event);
}

}
