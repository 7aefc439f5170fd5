// Starts the motion of a simulation, on the first frame or on nothing.

#include "Simulation/SurfaceSimulation.h"

#include <memory>
#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

constexpr const char* NothingToStartOn =
  "The target is empty at the first time step, so there is no skin, now or later. For a skin that "
  "begins with the target, turn CreateParts on and, unless the target is particles, set "
  "ModelBounds. Or set an initial shape.";
constexpr const char* NothingYet =
  "The target is empty at the first time step, so there is no skin. The skin will follow from the "
  "first particles; for another target, set ModelBounds or an initial shape.";

}

// A surface that began without a domain gets the voxel size of the domain as soon as there is one.
void SurfaceSimulation::UseNewDomain()
{
  const SurfaceDomain* domain = this->FindDomain();
  if (this->LacksDomain && domain)
  {
    const int step = this->Path.GetStep();
    auto band = std::make_unique<NarrowBand>(domain->VoxelSize);
    band->StartEmpty(this->Settings.GetMotionTimeOf(step).Value, domain->Bounds);
    this->Path.Begin(step, std::move(band));
    this->Shapes.ForgetTarget(); // was made without the domain
    this->Saved.Clear();         // has bands of another voxel size
    this->LacksDomain = false;
  }
}

bool SurfaceSimulation::Start(const ProgressFunction& progress)
{
  try
  {
    const SurfaceDomain* domain = this->FindDomain();
    if (!domain && !this->Shapes.StartsOnNothing())
    {
      throw std::invalid_argument("Neither the target nor the initial shape has known bounds, as "
                                  "for most functions and for input without usable points; set "
                                  "ModelBounds to a box around the initial shape (by default the "
                                  "target), or correct the input.");
    }
    if (this->Loaded.Band && domain)
    {
      this->Shapes.StartTarget(this->FindFirstStep());
      this->RestoreLoaded();
      this->Rewind(this->Requested.Step);
      if (this->Path.HasBegun())
      {
        return true;
      }
    }
    return this->StartBand(progress);
  }
  catch (...)
  {
    this->Reset();
    this->LoadedIsNew = this->Loaded.Band != nullptr; // the user may correct the settings
    throw;
  }
}

bool SurfaceSimulation::StartBand(const ProgressFunction& progress)
{
  const SurfaceDomain* domain = this->FindDomain();
  this->LacksDomain = !domain;
  auto band = std::make_unique<NarrowBand>(domain ? domain->VoxelSize : 1.0);
  if (this->Shapes.StartsOnNothing())
  {
    const bool mayBegin = this->Settings.Parameters.CreateParts;
    if (!domain || !mayBegin)
    {
      this->Messages.Say("empty", mayBegin ? NothingYet : NothingToStartOn);
    }
  }
  else
  {
    this->Shared.Place(*band, 0, 0);
    if (!this->Driver.Start(*band, *domain, progress))
    {
      return false;
    }
  }
  this->Path.Begin(0, std::move(band));
  this->Record(0, this->Settings.GetStep(0), "");
  return true;
}

}
