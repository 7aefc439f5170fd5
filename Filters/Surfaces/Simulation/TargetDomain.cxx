// Domain of a surface, from the bounds of the target and of the initial shape.

#include "Simulation/TargetBuilder.h"

#include "vtkBoundingBox.h"
#include "vtkGridPotential.h"
#include "vtkSkeletonPotential.h"

#include <cmath>

namespace activesurface
{

namespace
{

void AddFunction(vtkImplicitFunction* function, vtkBoundingBox& box)
{
  double bounds[6];
  auto skeleton = vtkSkeletonPotential::SafeDownCast(function);
  auto grid = vtkGridPotential::SafeDownCast(function);
  if (function && !function->GetTransform() &&
    ((skeleton && skeleton->GetSkeletonBounds(bounds)) || (grid && grid->GetGridBounds(bounds))))
  {
    box.AddBounds(bounds);
  }
}

}

const SurfaceDomain* TargetBuilder::FindDomain()
{
  if (this->DomainKnown)
  {
    return &this->Domain;
  }
  this->Settings.Check();
  vtkBoundingBox shapes;
  vtkBoundingBox images;
  if (this->Settings.HasBounds())
  {
    this->Domain = MakeDomain(this->Settings);
    this->DomainKnown = true;
  }
  else if (this->AddFirstBounds(shapes, images) && (shapes.IsValid() || images.IsValid()))
  {
    this->Domain =
      MakeDomain(this->Settings, { shapes, images, this->GetSpacing(), this->GetPixel() });
    this->DomainKnown = true;
  }
  else if (this->Frames.FindLastStep() >= 0 && this->StartsOnNothing() &&
    (this->Settings.HasOwnSizes() || this->EstimatedSpacing > 0.0))
  {
    this->Domain = MakeDomainOfNothing(this->Settings, this->FindSpacing());
    this->DomainKnown = true;
  }
  this->MoveToOrigin();
  return this->DomainKnown ? &this->Domain : nullptr;
}

void TargetBuilder::SetDomain(const SurfaceDomain& domain, double spacing)
{
  this->Domain = domain;
  this->DomainKnown = true;
  this->KeepEstimatedSpacing(spacing);
  this->MoveToOrigin();
}

void TargetBuilder::MoveToOrigin()
{
  for (const int step : { this->Frames.FindLastStep() - 1, this->Frames.FindLastStep() })
  {
    if (InputShape* shape = this->Frames.Find(step))
    {
      shape->MoveTo(this->GetOrigin());
    }
  }
  if (this->Initial)
  {
    this->Initial->MoveTo(this->GetOrigin());
  }
}

// Adds the available bounds of the first frame, the functions and the initial shape. Returns false
// if an input has not been added yet.
bool TargetBuilder::AddFirstBounds(vtkBoundingBox& shapes, vtkBoundingBox& images) const
{
  if (this->WantsInitial() || (this->Settings.UsesInput() && !this->Frames.Has(0)))
  {
    return false;
  }
  const TargetOptions options = this->GetOptions();
  if (this->Settings.UsesInput())
  {
    this->Frames.Find(0)->AddBounds(options, shapes, images);
  }
  if (this->Initial)
  {
    this->Initial->AddBounds(options, shapes, images);
  }
  AddFunction(this->Settings.Inputs.TargetFunction, shapes);
  AddFunction(this->Settings.Inputs.InitialFunction, shapes);
  return true;
}

double TargetBuilder::GetPixel() const
{
  double least = 0.0;
  for (const InputShape* shape : { this->Frames.Find(0), this->Initial.get() })
  {
    const double pixel = shape ? shape->GetPixel() : 0.0;
    least = pixel > 0.0 && (least == 0.0 || pixel < least) ? pixel : least;
  }
  return least;
}

// Returns the spacing that determines voxel size and reach; 0 if the spacing is unknown, or
// estimated with ParticleModel SUM.
double TargetBuilder::GetSpacing() const
{
  const ParticleSettings& particles = this->Settings.Particles;
  const bool isUsed = particles.Spacing > 0.0 || particles.Model != ParticleModel::Sum;
  return isUsed ? this->FindSpacing() : 0.0;
}

vtkBoundingBox TargetBuilder::FindBoundsOfInside(int step) const
{
  vtkBoundingBox shapes;
  vtkBoundingBox images;
  const InputShape* shape = this->Frames.Find(step);
  if (this->Settings.UsesInput() && shape && !this->Settings.Invert)
  {
    shape->AddBounds(this->GetOptions(), shapes, images);
    if (shapes.IsValid())
    {
      shapes.Inflate(std::fabs(this->Settings.IsoValue)); // distance of the level
    }
    shapes.AddBox(images);
  }
  else if (this->DomainKnown && (shape || !this->Settings.UsesInput()))
  {
    shapes.AddBounds(this->Domain.Bounds);
  }
  return shapes;
}

void TargetBuilder::WarnOfUnusedBox(bool isUsed) const
{
  if (!isUsed && this->Settings.Particles.ArePeriodic())
  {
    this->Messages.Say("no particles in a box",
      "PeriodicBounds has no effect here: the target has no particles; unset PeriodicBounds.");
  }
}

bool TargetBuilder::StartsOnNothing() const
{
  const InputShape* first = this->Frames.Find(0);
  return this->Settings.UsesInput() && (!first || first->IsEmpty()) &&
    !this->Settings.Inputs.InitialFunction && !this->Initial;
}

}
