// Initializes a surface from the shape that it starts with.

#ifndef SurfaceStart_h
#define SurfaceStart_h

#include "NarrowBand.h"
#include "Simulation/SurfaceDomain.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/Warnings.h"
#include "Targets/PotentialTarget.h"

namespace activesurface
{

struct SurfaceStart
{
  const SurfaceDomain& Domain;
  const Walls& Box;
  Obstacle* Solid; // or null
  PotentialTarget& Shape;
};

// Returns false if `progress` has stopped it. Warns if the shape has no surface. Throws as
// NarrowBand::Start.
bool StartOn(NarrowBand& band, const SurfaceStart& start, Warnings& messages,
  const ProgressFunction& progress);

}

#endif
