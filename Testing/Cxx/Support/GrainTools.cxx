#include "Support/GrainTools.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSphere.h"
#include "vtkStringArray.h"

#include <cmath>
#include <random>

namespace activesurface
{

std::vector<Grain> MakeBlob(double x)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(-0.4, 0.4);
  std::vector<Grain> grains;
  while (grains.size() < 60)
  {
    const Grain grain = { between(random), between(random), between(random),
      static_cast<int>(grains.size()), 20.0 + 100.0 * between(random) };
    if (std::hypot(grain.X, grain.Y, grain.Z) < 0.4)
    {
      grains.push_back(grain);
      grains.back().X += x;
    }
  }
  return grains;
}

vtkSmartPointer<vtkPolyData> MakeCloud(const std::vector<Grain>& grains)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> ids;
  ids->SetName("id");
  vtkNew<vtkDoubleArray> temperatures;
  temperatures->SetName("temperature");
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  for (const Grain& grain : grains)
  {
    points->InsertNextPoint(grain.X, grain.Y, grain.Z);
    ids->InsertNextValue(grain.Id);
    temperatures->InsertNextValue(grain.Temperature);
    names->InsertNextValue("grain " + std::to_string(grain.Id));
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(ids);
  cloud->GetPointData()->SetScalars(temperatures);
  cloud->GetPointData()->AddArray(names);
  AddFloats(cloud, "constant", 1, 7.25);
  return cloud;
}

void AddFloats(vtkPolyData* points, const char* name, int components, double value)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(points->GetNumberOfPoints());
  array->Fill(value);
  points->GetPointData()->AddArray(array);
}

Expected FindExpected(const std::vector<Grain>& grains, const double x[3], KernelFormula kernel)
{
  double sum = 0.0, weights = 0.0, largest = 0.0;
  Expected expected{ 0.0, -1 };
  for (const Grain& grain : grains)
  {
    const double q = std::hypot(x[0] - grain.X, x[1] - grain.Y, x[2] - grain.Z) / 0.3;
    const double weight = q < 1.0 ? kernel(q) : 0.0;
    sum += weight * grain.Temperature;
    weights += weight;
    expected.Id = weight > largest ? grain.Id : expected.Id;
    largest = std::max(largest, weight);
  }
  expected.Temperature = sum / weights;
  return expected;
}

std::string GetArrayBytes(vtkActiveImplicitSurface* filter)
{
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  std::string bytes;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    bytes += arrays->GetArrayName(i);
    if (vtkDataArray* array = arrays->GetArray(i))
    {
      bytes.append(static_cast<const char*>(array->GetVoidPointer(0)),
        static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize()));
    }
  }
  return bytes;
}

}
