#include "Support/PipelineTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

vtkStandardNewMacro(ParticleSource);

ParticleSource::ParticleSource()
{
  this->SetNumberOfInputPorts(0);
}

void ParticleSource::SetCloud(const Cloud& cloud)
{
  this->Particles = cloud;
  this->Modified();
}

void ParticleSource::SetSteps(const std::vector<double>& steps)
{
  this->Steps = steps;
  this->Modified();
}

void ParticleSource::SetContinuous(bool continuous)
{
  this->Continuous = continuous;
  this->Modified();
}

std::string ParticleSource::GetExecutions() const
{
  std::ostringstream text;
  for (const double time : this->Executions)
  {
    text << time << " ";
  }
  return text.str();
}

int ParticleSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  if (!this->Steps.empty())
  {
    const double range[2] = { this->Steps.front(), this->Steps.back() };
    out->Set(SDDP::TIME_STEPS(), this->Steps.data(), static_cast<int>(this->Steps.size()));
    out->Set(SDDP::TIME_RANGE(), range, 2);
  }
  else if (this->Continuous)
  {
    const double range[2] = { 0.0, 10.0 };
    out->Remove(SDDP::TIME_STEPS());
    out->Set(SDDP::TIME_RANGE(), range, 2);
  }
  return 1;
}

int ParticleSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  const double time = out->Has(SDDP::UPDATE_TIME_STEP()) ? out->Get(SDDP::UPDATE_TIME_STEP()) : 0.0;
  this->Executions.push_back(time);
  if (this->Restless)
  {
    this->Modified();
  }
  if (this->FailingExecution >= 0 && this->FailingExecution < int(this->Executions.size()))
  {
    return 0;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> ids;
  ids->SetName("id");
  for (const Particle& particle : this->Particles(time))
  {
    points->InsertNextPoint(particle.X, particle.Y, particle.Z);
    ids->InsertNextValue(particle.Id);
  }
  vtkPolyData* particles = vtkPolyData::GetData(output, 0);
  particles->SetPoints(points);
  particles->GetPointData()->AddArray(ids);
  if (!this->Steps.empty() || this->Continuous)
  {
    particles->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  return 1;
}

void CountExecutions(vtkAlgorithm* algorithm, int& executions)
{
  vtkNew<vtkCallbackCommand> counter;
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  counter->SetClientData(&executions);
  algorithm->AddObserver(vtkCommand::StartEvent, counter);
}

std::string GetBytes(vtkActiveImplicitSurface* filter)
{
  vtkPolyData* skin = filter->GetOutput();
  std::string bytes;
  const auto append = [&bytes](vtkDataArray* array)
  {
    if (array)
    {
      bytes.append(static_cast<const char*>(array->GetVoidPointer(0)),
        array->GetDataSize() * array->GetDataTypeSize());
    }
  };
  append(skin->GetPoints() ? skin->GetPoints()->GetData() : nullptr);
  append(skin->GetPolys()->GetConnectivityArray());
  append(skin->GetPointData()->GetNormals());
  return bytes;
}

std::string GetBytesAt(vtkActiveImplicitSurface* filter, double time)
{
  filter->UpdateTimeStep(time);
  return GetBytes(filter);
}

std::array<double, 6> GetSkinBounds(vtkActiveImplicitSurface* filter)
{
  std::array<double, 6> bounds;
  filter->GetOutput()->GetBounds(bounds.data());
  return bounds;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeShrinkingBall()
{
  vtkNew<vtkSphere> from;
  from->SetRadius(0.6);
  vtkNew<vtkSphere> to;
  to->SetRadius(0.4);
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInitialFunction(from);
  filter->SetTargetFunction(to);
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->SetVoxelSize(0.0625);
  return filter;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkin()
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.3);
  filter->SetAttraction(10.0);
  filter->SetVoxelSize(0.05);
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  return filter;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkAlgorithm* source)
{
  auto filter = MakeSkin();
  filter->SetInputConnection(source->GetOutputPort());
  return filter;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkDataObject* data)
{
  auto filter = MakeSkin();
  filter->SetInputData(data);
  return filter;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(ParticleSource* source)
{
  auto filter = MakeSkinOver(static_cast<vtkAlgorithm*>(source));
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  return filter;
}

vtkSmartPointer<vtkImplicitFunction> MakeBallFunction(double radius, double x)
{
  auto ball = vtkSmartPointer<vtkSphere>::New();
  ball->SetCenter(x, 0.0, 0.0);
  ball->SetRadius(radius);
  return ball;
}

Radii GetRadii(vtkActiveImplicitSurface* filter, double x)
{
  Radii radii = { HUGE_VAL, 0.0 };
  vtkPolyData* skin = filter->GetOutput();
  for (vtkIdType i = 0; i < skin->GetNumberOfPoints(); ++i)
  {
    double p[3];
    skin->GetPoint(i, p);
    const double radius = std::hypot(p[0] - x, p[1], p[2]);
    radii.Least = std::min(radii.Least, radius);
    radii.Largest = std::max(radii.Largest, radius);
  }
  return radii;
}

void CheckBall(
  vtkActiveImplicitSurface* filter, double radius, double tolerance, const std::string& name)
{
  const Radii radii = GetRadii(filter);
  EXPECT_NEAR(radii.Least, radius, tolerance) << "least radius, " << name;
  EXPECT_NEAR(radii.Largest, radius, tolerance) << "largest radius, " << name;
}

std::vector<Particle> MovingBall(double time)
{
  return { { 0.2 * time, 0.0, 0.0, 7 } };
}

vtkSmartPointer<ParticleSource> MakeMovingBall()
{
  auto source = vtkSmartPointer<ParticleSource>::New();
  source->SetCloud(MovingBall);
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0, 4.0 });
  return source;
}

}
