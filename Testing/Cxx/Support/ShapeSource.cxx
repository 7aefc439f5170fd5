#include "Support/ShapeSource.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

vtkStandardNewMacro(ShapeSource);

ShapeSource::ShapeSource()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

int ShapeSource::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataSet");
  return 1;
}

void ShapeSource::SetShape(const Shape& shape, const std::vector<double>& steps)
{
  this->Shapes = shape;
  this->Steps = steps;
  this->Modified();
}

std::string ShapeSource::GetExecutions() const
{
  std::ostringstream text;
  for (const double time : this->Executions)
  {
    text << time << " ";
  }
  return text.str();
}

vtkTypeBool ShapeSource::ProcessRequest(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    this->MakeOutput(out);
  }
  else if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    this->PublishTimes(out);
  }
  else if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    this->Execute(out);
    return this->Failing ? 0 : 1;
  }
  return 1;
}

void ShapeSource::MakeOutput(vtkInformation* out)
{
  const vtkSmartPointer<vtkDataSet> shape =
    this->Shapes(this->Steps.empty() ? 0.0 : this->Steps.front());
  vtkDataObject* data = vtkDataObject::GetData(out);
  if (!data || !data->IsA(shape->GetClassName()))
  {
    vtkSmartPointer<vtkDataObject> made;
    made.TakeReference(shape->NewInstance());
    out->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  if (auto image = vtkImageData::SafeDownCast(shape))
  {
    out->Set(SDDP::WHOLE_EXTENT(), image->GetExtent(), 6);
  }
}

void ShapeSource::PublishTimes(vtkInformation* out)
{
  if (!this->Steps.empty())
  {
    const double range[2] = { this->Steps.front(), this->Steps.back() };
    out->Set(SDDP::TIME_STEPS(), this->Steps.data(), static_cast<int>(this->Steps.size()));
    out->Set(SDDP::TIME_RANGE(), range, 2);
  }
}

void ShapeSource::Execute(vtkInformation* out)
{
  const double time = out->Has(SDDP::UPDATE_TIME_STEP()) ? out->Get(SDDP::UPDATE_TIME_STEP()) : 0.0;
  this->Executions.push_back(time);
  const vtkSmartPointer<vtkDataSet> shape = this->Shapes(time);
  vtkDataSet* data = vtkDataSet::GetData(out);
  auto image = vtkImageData::SafeDownCast(data);
  vtkDataArray* values = shape->GetPointData()->GetScalars();
  if (!image || !values)
  {
    data->ShallowCopy(shape);
    return;
  }
  image->CopyStructure(shape);
  image->AllocateScalars(values->GetDataType(), 1);
  std::memcpy(image->GetScalarPointer(), values->GetVoidPointer(0),
    static_cast<std::size_t>(values->GetDataSize()) * values->GetDataTypeSize());
}

vtkSmartPointer<ShapeSource> MakeSource(
  const ShapeSource::Shape& shape, const std::vector<double>& steps)
{
  auto source = vtkSmartPointer<ShapeSource>::New();
  source->SetShape(shape, steps);
  return source;
}

vtkSmartPointer<vtkPolyData> MakeBallMesh(double radius, double x)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetCenter(x, 0.0, 0.0);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  return sphere->GetOutput();
}

vtkSmartPointer<vtkImageData> MakeBallImage(double radius, double x)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-20, 20, -20, 20, -20, 20);
  image->SetSpacing(0.05, 0.05, 0.05);
  vtkNew<vtkDoubleArray> values;
  values->SetName("squares");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double p[3];
    image->GetPoint(i, p);
    values->InsertNextValue((p[0] - x) * (p[0] - x) + p[1] * p[1] + p[2] * p[2] - radius * radius);
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkSmartPointer<vtkPolyData> MakeLines()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(-0.4, 0.0, 0.0);
  points->InsertNextPoint(0.0, 0.1, 0.0);
  points->InsertNextPoint(0.4, 0.0, 0.2);
  points->InsertNextPoint(0.0, -0.5, 0.0);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1, 2 });
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 2 });
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->SetVerts(vertices);
  return data;
}

}
