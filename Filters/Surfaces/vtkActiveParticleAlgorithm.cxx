#include "vtkActiveParticleAlgorithm.h"

#include "Simulation/PropertyValues.h"

#include "vtkSkeletonPotential.h"

static_assert(static_cast<int>(vtkActiveParticleAlgorithm::ANISOTROPIC) ==
    static_cast<int>(vtkSkeletonPotential::ANISOTROPIC),
  "The filter's models are the potential's.");

void vtkActiveParticleAlgorithm::SetParticleKernelToWyvill()
{
  this->SetParticleKernel(vtkSkeletonPotential::WYVILL);
}

void vtkActiveParticleAlgorithm::SetParticleKernelToCubicSpline()
{
  this->SetParticleKernel(vtkSkeletonPotential::CUBIC_SPLINE);
}

void vtkActiveParticleAlgorithm::SetParticleKernelToMetaball()
{
  this->SetParticleKernel(vtkSkeletonPotential::METABALL);
}

void vtkActiveParticleAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  activesurface::SurfaceSettings unused;
  activesurface::ForEachParticleProperty(unused,
    [&](const activesurface::Property& property, auto&, auto&& get)
    { activesurface::PrintProperty(os << indent, property, get(*this)); });
}
