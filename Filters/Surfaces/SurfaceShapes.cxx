#include "SurfaceShapes.h"

#include "BlendedTarget.h"
#include "ImplicitTarget.h"
#include "MeshTriangles.h"
#include "ParticleTarget.h"
#include "TargetFunctions.h"

#include "vtkBoundingBox.h"
#include "vtkGridPotential.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace activesurface
{

namespace
{

// Spacing of the samples that stand in for the gradients that a function does not give [voxels].
constexpr double DifferenceStep = 0.125;

// Reach of the particles in units of their distance, when it is not given: balls of neighbours
// overlap enough to be one body.
constexpr double RadiusPerSpacing = 2.0;

// How far the initial shape has to be known around its surface [voxels]: the band and its ghosts.
constexpr double InitialReach = 8.0;

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

void AddMesh(vtkPolyData* mesh, double thickness, vtkBoundingBox& box)
{
  const std::array<double, 6> bounds = FindBounds(mesh);
  if (bounds[0] > bounds[1])
  {
    return; // no polygon of use: there will be an error when the mesh is read
  }
  vtkBoundingBox shell(bounds.data());
  shell.Inflate(0.5 * thickness);
  box.AddBox(shell);
}

void AddFrame(
  const TargetFrame& frame, double thickness, vtkBoundingBox& shapes, vtkBoundingBox& images)
{
  double bounds[6];
  switch (frame.Kind)
  {
    case TargetKind::Nothing:
      break;
    case TargetKind::Particles:
      frame.Particles.GetBounds(bounds) ? shapes.AddBounds(bounds) : void();
      break;
    case TargetKind::Skeleton:
      AddFunction(frame.Function, shapes);
      break;
    case TargetKind::Mesh:
      AddMesh(vtkPolyData::SafeDownCast(frame.Data), thickness, shapes);
      break;
    case TargetKind::Image:
      frame.Data->GetBounds(bounds);
      images.AddBounds(bounds);
      break;
  }
}

}

SurfaceShapes::SurfaceShapes(const SurfaceSettings& settings, Warnings& warnings)
  : Settings(settings)
  , Messages(warnings)
{
}

void SurfaceShapes::Clear()
{
  this->Moving = nullptr;
  this->Target.reset();
  this->Frames.Clear();
  this->Kind = TargetKind::Nothing;
  this->EstimatedRadius = 0.0;
  this->ThinPartsKnown = false;
  this->HasInitial = false;
  this->Initial = TargetFrame();
  this->DomainKnown = false;
}

void SurfaceShapes::Add(int step, TargetFrame frame)
{
  this->CheckKind(step, frame);
  if (frame.Kind == TargetKind::Particles && frame.Particles.Ignored > 0)
  {
    std::ostringstream text;
    text << frame.Particles.Ignored << " particles are left out at the time step "
         << this->Settings.Steps.at(step)
         << ": coordinates, radius or strength are not finite, or the radius is not > 0.";
    this->Messages.Say("ignored particles", text.str());
  }
  this->GiveRadii(frame.Particles);
  // A grid needs the size of the voxels: of the first frame, it is made when that is known.
  if (frame.Kind == TargetKind::Skeleton || this->DomainKnown)
  {
    this->MakeFunction(step, frame);
  }
  this->Frames.Add(step, std::move(frame));
}

bool SurfaceShapes::HasExtras(int step, const std::string& extras) const
{
  return this->Frames.Has(step) &&
    (this->Frames.Get(step).Kind != TargetKind::Particles ||
      this->Frames.Get(step).Extras == extras);
}

// An empty frame fits all others.
void SurfaceShapes::CheckKind(int step, TargetFrame& frame)
{
  if (this->Kind == TargetKind::Mesh && frame.Kind == TargetKind::Particles && !frame.HasCells)
  {
    frame = TargetFrame(); // the points of a mesh that has lost its polygons
  }
  if (frame.Kind == TargetKind::Nothing)
  {
    return;
  }
  if (this->Kind != TargetKind::Nothing && this->Kind != frame.Kind)
  {
    std::ostringstream text;
    text << "The target is " << GetName(frame.Kind) << " at the time step "
         << this->Settings.Steps.at(step) << ", but " << GetName(this->Kind)
         << " before; all time steps of the input have to be of one kind.";
    throw std::invalid_argument(text.str());
  }
  this->Kind = frame.Kind;
}

void SurfaceShapes::GiveRadii(ParticleFrame& frame)
{
  if (frame.HasRadii || frame.Particles.empty())
  {
    return;
  }
  if (this->Settings.Particles.Radius == 0.0 && this->EstimatedRadius == 0.0)
  {
    this->EstimatedRadius = RadiusPerSpacing * frame.GetSpacing();
    if (this->EstimatedRadius == 0.0)
    {
      throw std::invalid_argument(
        "The particles' radius cannot be estimated, as no two of them are "
        "apart; set ParticleRadius or choose a radius array.");
    }
    std::ostringstream text;
    text << "ParticleRadius is not set; " << this->EstimatedRadius << " is used, "
         << RadiusPerSpacing << " times the usual distance of neighbours. Set it to silence this.";
    this->Messages.Say("radius", text.str());
  }
  frame.GiveRadius(this->GetRadius());
}

double SurfaceShapes::GetRadius() const
{
  return this->EstimatedRadius > 0.0 ? this->EstimatedRadius : this->Settings.Particles.Radius;
}

void SurfaceShapes::MakeFunction(int step, TargetFrame& frame)
{
  const bool isGrid = frame.Kind == TargetKind::Mesh || frame.Kind == TargetKind::Image;
  if (frame.Function || (!isGrid && frame.Kind != TargetKind::Skeleton))
  {
    return;
  }
  std::ostringstream where;
  where << "The target, " << GetName(frame.Kind) << ", at the time step "
        << this->Settings.Steps.at(step) << ": ";
  try
  {
    // Distances to a level of a mesh have to be known around that level.
    const FrameFunction made = isGrid
      ? MakeGridFunction(frame, this->Settings, this->Domain.VoxelSize,
          this->Domain.Reach + std::fabs(this->Settings.IsoValue))
      : MakeSkeletonFunction(frame, this->Settings.Particles, this->GetRadius());
    frame.Function = made.Function;
    if (!made.Flaw.empty())
    {
      this->Messages.Say("flaw of the target", where.str() + made.Flaw);
    }
    this->WarnOfThinParts(frame, where.str());
  }
  catch (const std::runtime_error& error)
  {
    const char* hint = frame.Kind == TargetKind::Mesh
      ? " (Its Reach is TargetReach and the size of TargetIsoValue together.)"
      : "";
    throw std::runtime_error(where.str() + error.what() + hint);
  }
}

// Of the first mesh or image that there is: to look at each one of a motion would cost too much. At
// another level of a mesh its parts are thicker, or thinner.
void SurfaceShapes::WarnOfThinParts(const TargetFrame& frame, const std::string& where)
{
  const bool isOwnLevel = frame.Kind == TargetKind::Image || this->Settings.IsoValue == 0.0;
  if (this->ThinPartsKnown || frame.Kind == TargetKind::Skeleton || !isOwnLevel)
  {
    return;
  }
  this->ThinPartsKnown = true;
  const std::string told = DescribeThinParts(frame.Function, this->Domain.VoxelSize);
  if (!told.empty())
  {
    this->Messages.Say("thin parts", where + told);
  }
}

bool SurfaceShapes::WantsInitial() const
{
  return this->Settings.HasInitialInput && !this->HasInitial;
}

void SurfaceShapes::SetInitial(TargetFrame frame)
{
  if (frame.Kind == TargetKind::Nothing)
  {
    throw std::invalid_argument("The input of port 1, Initial, is empty: there are no points to "
                                "start on. Disconnect it, or connect a closed mesh or an image.");
  }
  if (frame.Kind != TargetKind::Mesh && frame.Kind != TargetKind::Image)
  {
    throw std::invalid_argument(std::string("The input of port 1, Initial, is ") +
      GetName(frame.Kind) +
      ", which is no initial shape: connect a closed mesh of polygons or an image.");
  }
  this->Initial = std::move(frame);
  this->HasInitial = true;
}

const SurfaceDomain* SurfaceShapes::FindDomain()
{
  if (this->DomainKnown)
  {
    return &this->Domain;
  }
  this->Settings.Check();
  vtkBoundingBox shapes;
  vtkBoundingBox images;
  if (this->Settings.BoundsGiven)
  {
    this->Domain = MakeDomain(this->Settings);
    this->DomainKnown = true;
  }
  else if (this->AddFirstBounds(shapes, images) && (shapes.IsValid() || images.IsValid()))
  {
    this->Domain = MakeDomain(this->Settings, shapes, images);
    this->DomainKnown = true;
  }
  return this->DomainKnown ? &this->Domain : nullptr;
}

// Of the first target and the initial shape, as far as they have any; false if more will be known.
bool SurfaceShapes::AddFirstBounds(vtkBoundingBox& shapes, vtkBoundingBox& images) const
{
  if (this->WantsInitial() || (this->Settings.UsesInput() && !this->Frames.Has(0)))
  {
    return false;
  }
  if (this->Settings.UsesInput())
  {
    AddFrame(this->Frames.Get(0), this->Settings.MeshThickness, shapes, images);
  }
  AddFrame(this->Initial, this->Settings.MeshThickness, shapes, images);
  AddFunction(this->Settings.TargetFunction, shapes);
  AddFunction(this->Settings.InitialFunction, shapes);
  return true;
}

bool SurfaceShapes::StartsOnNothing() const
{
  return this->Settings.UsesInput() && this->Frames.Get(0).IsEmpty() &&
    !this->Settings.InitialFunction && !this->HasInitial;
}

PotentialTarget& SurfaceShapes::GetTarget()
{
  if (!this->Target || this->KindOfTarget != this->Kind)
  {
    this->MakeTarget();
  }
  return *this->Target;
}

MovingTarget* SurfaceShapes::GetMovingTarget()
{
  this->GetTarget();
  return this->Moving;
}

void SurfaceShapes::MakeTarget()
{
  const SurfaceSettings& settings = this->Settings;
  const double differences = DifferenceStep * this->Domain.VoxelSize;
  TargetOptions options{ settings.IsoValue, settings.Invert, settings.Normalize,
    this->Domain.Reach };
  this->KindOfTarget = this->Kind;
  this->Moving = nullptr;
  if (!settings.UsesInput())
  {
    this->Target = std::make_unique<ImplicitTarget>(settings.TargetFunction, differences, options);
    return;
  }
  std::unique_ptr<MovingTarget> moving;
  if (this->Kind == TargetKind::Particles || this->Kind == TargetKind::Nothing)
  {
    moving = std::make_unique<ParticleTarget>(
      this->Frames, settings.Particles.Kernel, settings.Particles.Threshold, options);
  }
  else
  {
    if (this->Kind == TargetKind::Image) // whose function has them already
    {
      options.IsoValue = 0.0;
      options.Invert = false;
    }
    const double outside = this->Kind == TargetKind::Skeleton
      ? settings.Particles.Threshold
      : options.IsoValue + this->Domain.Reach;
    moving = std::make_unique<BlendedTarget>(this->Frames, differences, outside, options);
  }
  this->Moving = moving.get();
  this->Target = std::move(moving);
}

void SurfaceShapes::StartTarget()
{
  this->MakeTarget();
  if (this->Moving)
  {
    this->MakeFunction(0, this->Frames.Get(0));
    this->Moving->MoveAlong(0, 0.0, 0.0);
  }
}

std::unique_ptr<PotentialTarget> SurfaceShapes::MakeStart()
{
  vtkSmartPointer<vtkImplicitFunction> function = this->Settings.InitialFunction;
  if (this->HasInitial)
  {
    if (!this->Initial.Function)
    {
      this->MakeInitialFunction();
    }
    function = this->Initial.Function;
  }
  return function ? std::make_unique<ImplicitTarget>(
                      function, DifferenceStep * this->Domain.VoxelSize, TargetOptions())
                  : nullptr;
}

void SurfaceShapes::MakeInitialFunction()
{
  const std::string where = "The input of port 1, Initial: ";
  try
  {
    const double voxel = this->Domain.VoxelSize;
    const FrameFunction made =
      MakeGridFunction(this->Initial, this->Settings, voxel, InitialReach * voxel);
    this->Initial.Function = made.Function;
    if (!made.Flaw.empty())
    {
      this->Messages.Say("flaw of the initial shape", where + made.Flaw);
    }
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(where + error.what());
  }
}

}
