#include "Targets/SkeletonShape.h"

#include "Targets/MovingTarget.h"
#include "Targets/TargetOptions.h"
#include "Targets/Warnings.h"

#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"

#include <stdexcept>

namespace activesurface
{

namespace
{

// Names of the point arrays of the copy.
constexpr const char* RadiusName = "Radius";
constexpr const char* ReachName = "Reach";
constexpr const char* StrengthName = "Strength";

// Stores the last message of an object, and keeps it out of the output window.
class LastReport
{
public:
  LastReport(vtkObject* object, unsigned long event)
  {
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(&this->Text);
    note->SetCallback([](vtkObject*, unsigned long, void* kept, void* text)
      { *static_cast<std::string*>(kept) = static_cast<const char*>(text); });
    this->Object = object;
    this->Tag = object->AddObserver(event, note);
  }
  ~LastReport() { this->Object->RemoveObserver(this->Tag); }
  LastReport(const LastReport&) = delete;
  void operator=(const LastReport&) = delete;

  std::string Text;

private:
  vtkObject* Object;
  unsigned long Tag;
};

// Adds a copy of the array with another name.
void AddArray(vtkDataSet* data, vtkAbstractArray* array, const char* name)
{
  if (array)
  {
    vtkSmartPointer<vtkAbstractArray> copy;
    copy.TakeReference(array->NewInstance());
    copy->DeepCopy(array);
    copy->SetName(name);
    data->GetPointData()->AddArray(copy);
  }
}

// Adds the support radii of kernels that make balls and tubes of the given radii.
void AddReaches(vtkDataSet* data, double reachPerRadius)
{
  vtkDataArray* radii = data->GetPointData()->GetArray(RadiusName);
  if (!radii)
  {
    return;
  }
  vtkNew<vtkDoubleArray> reaches;
  reaches->SetName(ReachName);
  reaches->SetNumberOfTuples(radii->GetNumberOfTuples());
  for (vtkIdType i = 0; i < radii->GetNumberOfTuples(); ++i)
  {
    reaches->SetValue(i, reachPerRadius * radii->GetComponent(i, 0));
  }
  data->GetPointData()->AddArray(reaches);
}

const char* FindName(vtkDataSet* data, const char* name)
{
  return data->GetPointData()->HasArray(name) ? name : "";
}

}

bool SkeletonShape::Fits(vtkDataSet* data)
{
  auto polyData = vtkPolyData::SafeDownCast(data);
  return polyData && polyData->GetNumberOfLines() > 0;
}

SkeletonShape::SkeletonShape(const InputData& input)
  : FunctionShape(CopyPointsAndCells(input.Data))
{
  PointArrays arrays;
  arrays.Radii = input.Chosen.FindRadii();
  arrays.Strengths = input.Chosen.FindStrengths();
  this->Points = ReadParticles(vtkPointSet::SafeDownCast(input.Data), arrays);
  AddArray(this->Data, arrays.Radii, RadiusName);
  AddArray(this->Data, arrays.Strengths, StrengthName);
}

std::string SkeletonShape::Prepare(const TargetOptions& options, const Warnings&)
{
  if (this->Function)
  {
    return "";
  }
  options.GiveRadii(ParticleModel::Sum, this->Points);
  vtkNew<vtkSkeletonPotential> skeleton;
  AddReaches(this->Data, options.GetReachPerRadius(ParticleModel::Sum));
  skeleton->SetInput(vtkPointSet::SafeDownCast(this->Data));
  skeleton->SetRadius(options.GetRadius(ParticleModel::Sum));
  skeleton->SetRadiusArrayName(FindName(this->Data, ReachName));
  skeleton->SetStrengthArrayName(FindName(this->Data, StrengthName));
  skeleton->SetKernel(static_cast<int>(options.Kernel));
  skeleton->SetThreshold(options.Threshold);
  const LastReport errors(skeleton, vtkCommand::ErrorEvent);
  const LastReport warnings(skeleton, vtkCommand::WarningEvent);
  const vtkIdType ignored = skeleton->GetNumberOfIgnoredElements();
  if (!errors.Text.empty())
  {
    throw std::runtime_error(errors.Text);
  }
  this->Function = skeleton;
  return ignored == 0 ? ""
                      : std::to_string(ignored) +
      (ignored == 1 ? " point or segment is" : " points or segments are") +
      " left out because a coordinate, radius or strength is not within "
      "+-1e100, a radius is below 1e-100, or a cell has a point that does not exist. Correct or "
      "remove these elements.";
}

void SkeletonShape::MoveBy(const double offset[3])
{
  FunctionShape::MoveBy(offset);
  this->Points.MoveBy(offset);
}

void SkeletonShape::AddBounds(const TargetOptions&, vtkBoundingBox& shapes, vtkBoundingBox&) const
{
  double bounds[6];
  auto skeleton = vtkSkeletonPotential::SafeDownCast(this->Function);
  if (skeleton && skeleton->GetSkeletonBounds(bounds))
  {
    shapes.AddBounds(bounds);
  }
}

std::unique_ptr<MovingTarget> SkeletonShape::MakeTarget(
  const TargetFrames& frames, const TargetOptions& options) const
{
  return MakeBlend(frames, options.Threshold, options);
}

}
