#include "vtkActiveMotionAlgorithm.h"

#include "Simulation/PropertyValues.h"

void vtkActiveMotionAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  activesurface::SurfaceSettings unused;
  activesurface::ForEachMotionProperty(unused,
    [&](const activesurface::Property& property, auto&, auto&& get)
    { activesurface::PrintProperty(os << indent, property, get(*this)); });
}
