#include "TargetInput.h"

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCellTypes.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <sstream>
#include <stdexcept>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

namespace
{

enum ArrayIndices
{
  RadiusArray = 0,
  IdArray = 1,
  StrengthArray = 2
};

[[noreturn]] void Refuse(const std::string& what)
{
  throw std::invalid_argument(what +
    " cannot be a target yet, only particles can: points without cells, or with vertices. "
    "Take its points alone, or make it a TargetFunction.");
}

void CheckIsParticles(vtkPointSet* points)
{
  if (auto mesh = vtkPolyData::SafeDownCast(points))
  {
    if (mesh->GetNumberOfLines() > 0)
    {
      Refuse("A vtkPolyData with lines");
    }
    if (mesh->GetNumberOfPolys() > 0 || mesh->GetNumberOfStrips() > 0)
    {
      Refuse("A vtkPolyData with polygons or strips");
    }
    return;
  }
  vtkNew<vtkCellTypes> types;
  points->GetCellTypes(types);
  for (vtkIdType i = 0; i < types->GetNumberOfTypes(); ++i)
  {
    const int type = types->GetCellType(i);
    if (type != VTK_EMPTY_CELL && type != VTK_VERTEX && type != VTK_POLY_VERTEX)
    {
      Refuse(std::string("A ") + points->GetClassName() + " with other cells than vertices");
    }
  }
}

}

TargetInput::TargetInput(vtkAlgorithm* filter)
  : Filter(filter)
{
}

bool TargetInput::IsConnected() const
{
  return this->Filter->GetNumberOfInputConnections(0) > 0;
}

std::uint64_t TargetInput::GetStamp() const
{
  auto upstream = this->IsConnected()
    ? vtkDemandDrivenPipeline::SafeDownCast(this->Filter->GetInputExecutive(0, 0))
    : nullptr;
  if (!upstream)
  {
    return 0;
  }
  upstream->UpdatePipelineMTime();
  return upstream->GetPipelineMTime();
}

std::vector<double> TargetInput::GetTimeSteps(vtkInformation* information)
{
  std::vector<double> steps;
  if (information && information->Has(SDDP::TIME_STEPS()))
  {
    const double* first = information->Get(SDDP::TIME_STEPS());
    steps.assign(first, first + information->Length(SDDP::TIME_STEPS()));
  }
  return steps.size() > 1 ? steps : std::vector<double>();
}

bool TargetInput::IsContinuous(vtkInformation* information)
{
  if (!information || information->Has(SDDP::TIME_STEPS()) || !information->Has(SDDP::TIME_RANGE()))
  {
    return false;
  }
  const double* range = information->Get(SDDP::TIME_RANGE());
  return range[0] < range[1];
}

bool TargetInput::IsArrayChosen(int index) const
{
  vtkInformation* choice = this->Filter->GetInputArrayInformation(index);
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  return name ? *name != '\0' : choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()) != 0;
}

std::array<std::string, 3> TargetInput::DescribeArrays() const
{
  std::array<std::string, 3> arrays;
  for (int index = RadiusArray; index <= StrengthArray; ++index)
  {
    if (this->IsArrayChosen(index))
    {
      vtkInformation* choice = this->Filter->GetInputArrayInformation(index);
      const char* name = choice->Get(vtkDataObject::FIELD_NAME());
      std::ostringstream text;
      text << "association " << choice->Get(vtkDataObject::FIELD_ASSOCIATION());
      if (name)
      {
        text << ", array \"" << name << "\"";
      }
      else
      {
        text << ", attribute " << choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
      }
      arrays[index] = text.str();
    }
  }
  return arrays;
}

bool TargetInput::IsComposite(vtkInformation* information)
{
  return vtkCompositeDataSet::SafeDownCast(vtkDataObject::GetData(information)) != nullptr;
}

ParticleFrame TargetInput::Read(vtkInformation* information) const
{
  vtkPointSet* points = vtkPointSet::GetData(information);
  if (!points)
  {
    Refuse("An input without data");
  }
  CheckIsParticles(points);
  return ReadParticles(points,
    { this->FindArray(RadiusArray, points), this->FindArray(IdArray, points),
      this->FindArray(StrengthArray, points) });
}

vtkAbstractArray* TargetInput::FindArray(int index, vtkPointSet* points) const
{
  if (!this->IsArrayChosen(index))
  {
    return nullptr;
  }
  vtkInformation* choice = this->Filter->GetInputArrayInformation(index);
  const int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkPointData* data = points->GetPointData();
  vtkAbstractArray* array = name
    ? data->GetAbstractArray(name)
    : data->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
  const bool isOfPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
    association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  if (!array || !isOfPoints)
  {
    throw std::invalid_argument(
      "The input has no point array as chosen by SetInputArrayToProcess(" + std::to_string(index) +
      ", ...): " + this->DescribeArrays()[index] + ".");
  }
  return array;
}

void TargetInput::AskForWhole(vtkInformation* information)
{
  information->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
  information->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
  information->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

bool TargetInput::Update(vtkInformation* information, double time) const
{
  AskForWhole(information);
  information->Set(SDDP::UPDATE_TIME_STEP(), time);
  int port = 0;
  vtkAlgorithm* producer = this->Filter->GetInputAlgorithm(0, 0, port);
  auto upstream = SDDP::SafeDownCast(producer->GetExecutive());
  return upstream && upstream->Update(port);
}

}
