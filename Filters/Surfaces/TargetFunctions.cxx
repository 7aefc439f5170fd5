#include "TargetFunctions.h"

#include "vtkCallbackCommand.h"
#include "vtkGridPotential.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSkeletonPotential.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Takes what an object says, in place of the output window.
class Ear
{
public:
  Ear(vtkObject* object, unsigned long event)
  {
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(&this->Said);
    note->SetCallback([](vtkObject*, unsigned long, void* said, void* text)
      { *static_cast<std::string*>(said) = static_cast<const char*>(text); });
    this->Object = object;
    this->Tag = object->AddObserver(event, note);
  }
  ~Ear() { this->Object->RemoveObserver(this->Tag); }
  Ear(const Ear&) = delete;
  void operator=(const Ear&) = delete;

  std::string Said;

private:
  vtkObject* Object;
  unsigned long Tag;
};

bool HasArray(vtkDataSet* data, const char* name)
{
  return data->GetPointData()->HasArray(name) != 0;
}

}

FrameFunction MakeSkeletonFunction(
  const TargetFrame& frame, const ParticleSettings& settings, double radius)
{
  vtkNew<vtkSkeletonPotential> skeleton;
  skeleton->SetInput(vtkPointSet::SafeDownCast(frame.Data));
  skeleton->SetRadius(radius);
  skeleton->SetRadiusArrayName(HasArray(frame.Data, RadiusName) ? RadiusName : "");
  skeleton->SetStrengthArrayName(HasArray(frame.Data, StrengthName) ? StrengthName : "");
  skeleton->SetKernel(static_cast<int>(settings.Kernel));
  skeleton->SetThreshold(settings.Threshold);
  const Ear errors(skeleton, vtkCommand::ErrorEvent);
  const Ear warnings(skeleton, vtkCommand::WarningEvent);
  const vtkIdType ignored = skeleton->GetNumberOfIgnoredElements();
  if (!errors.Said.empty())
  {
    throw std::runtime_error(errors.Said);
  }
  FrameFunction made;
  made.Function = skeleton;
  if (ignored > 0)
  {
    made.Flaw = std::to_string(ignored) +
      " points or segments are left out: a coordinate, radius or strength is not finite, the "
      "radius is not > 0, or the point does not exist.";
  }
  return made;
}

FrameFunction MakeGridFunction(
  const TargetFrame& frame, const SurfaceSettings& settings, double voxelSize, double reach)
{
  vtkNew<vtkGridPotential> grid;
  grid->SetWarnOfDefects(false);
  grid->SetReportErrors(false);
  grid->SetInput(frame.Data);
  grid->SetVoxelSize(voxelSize);
  grid->SetReach(reach);
  grid->SetMeshThickness(settings.MeshThickness);
  if (frame.Kind == TargetKind::Image)
  {
    grid->SetIsoValue(settings.IsoValue);
    grid->SetInvertInside(settings.Invert);
  }
  grid->Build();
  if (*grid->GetError() != '\0')
  {
    throw std::runtime_error(grid->GetError());
  }
  std::string flaw = grid->GetDefects();
  if (!flaw.empty() && settings.MeshThickness == 0.0)
  {
    flaw += " Where it is open it has no inside; a MeshThickness > 0 makes a shell of it.";
  }
  return { grid.Get(), flaw };
}

std::string DescribeThinParts(vtkImplicitFunction* function, double voxelSize)
{
  // A patch that shows: of a body 64 voxels across, ten voxels by ten. And six times what the
  // share is off by, see SurfaceSample, so that it is not there by chance.
  constexpr double negligible = 0.005;
  constexpr double voxels = 2.0;
  auto grid = vtkGridPotential::SafeDownCast(function);
  const double share = grid ? grid->FindThinShare(voxels * voxelSize) : 0.0;
  std::ostringstream text;
  if (share > negligible)
  {
    constexpr double percent = 100.0;
    text << "about " << std::ceil(percent * share)
         << " % of its surface belongs to parts thinner than two voxels, which the skin loses, or "
            "has in shreds; lessen VoxelSize, which is "
         << voxelSize << ", to half of their thickness.";
  }
  return text.str();
}

}
