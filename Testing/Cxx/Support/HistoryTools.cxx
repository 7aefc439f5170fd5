#include "Support/HistoryTools.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

void Append(vtkDataArray* array, std::vector<float>& values)
{
  for (vtkIdType i = 0; array && i < 3 * array->GetNumberOfTuples(); ++i)
  {
    values.push_back(static_cast<float>(array->GetComponent(i / 3, static_cast<int>(i % 3))));
  }
}

}

Mesh GetMesh(vtkPolyData* triangles)
{
  Mesh mesh;
  Append(triangles->GetPoints() ? triangles->GetPoints()->GetData() : nullptr, mesh.Points);
  Append(triangles->GetPointData()->GetNormals(), mesh.Normals);
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i)
  {
    triangles->GetCellPoints(i, corners);
    mesh.Corners.insert(mesh.Corners.end(), corners->begin(), corners->end());
  }
  return mesh;
}

std::size_t CountDefects(const Mesh& mesh)
{
  const MeshDefects defects = FindDefects(mesh);
  return defects.Edges + defects.Vertices + defects.Unused;
}

std::string DescribeTopology(const Mesh& mesh)
{
  const Topology topology = GetTopology(mesh);
  std::ostringstream text;
  text << topology.Components << " " << topology.Voids << " " << topology.EulerCharacteristic;
  return text.str();
}

std::string DescribeTopology(vtkActiveImplicitSurface* filter, int row)
{
  std::ostringstream text;
  text << GetNumber(filter, row, "Components") << " " << GetNumber(filter, row, "Voids") << " "
       << GetNumber(filter, row, "EulerCharacteristic");
  return text.str();
}

int CountRows(vtkActiveImplicitSurface* filter)
{
  return static_cast<int>(filter->GetHistory()->GetNumberOfRows());
}

double GetNumber(vtkActiveImplicitSurface* filter, int row, const char* column)
{
  vtkTable* history = filter->GetHistory();
  if (!history->GetColumnByName(column) || row < 0 || row >= history->GetNumberOfRows())
  {
    throw std::out_of_range(std::string("The history has no such row, or no column ") + column);
  }
  return history->GetValueByName(row, column).ToDouble();
}

std::string GetLastEvent(vtkActiveImplicitSurface* filter)
{
  vtkTable* history = filter->GetHistory();
  const vtkIdType last = history->GetNumberOfRows() - 1;
  return last < 0 ? "no row" : history->GetValueByName(last, "Event").ToString();
}

std::string GetHistoryText(vtkActiveImplicitSurface* filter, int end)
{
  vtkTable* history = filter->GetHistory();
  std::ostringstream text;
  text.precision(17);
  for (int row = 0; row < std::min(end, CountRows(filter)); ++row)
  {
    for (vtkIdType column = 0; column < history->GetNumberOfColumns(); ++column)
    {
      const vtkVariant value = history->GetValue(row, column);
      text << history->GetColumnName(column) << " ";
      value.IsString() ? text << value.ToString() : text << value.ToDouble();
      text << "\n";
    }
  }
  return text.str();
}

}
