// Initializes a surface from its initial shape.

#ifndef SurfaceStart_h
#define SurfaceStart_h

#include "NarrowBand.h"
#include "Simulation/SurfaceDomain.h"
#include "Simulation/SurfaceSettings.h"
#include "Targets/PotentialTarget.h"
#include "Targets/Warnings.h"

namespace activesurface
{

struct SurfaceStart
{
  const SurfaceDomain& Domain;
  const Walls& Box;
  Obstacle* Solid; // or null
  PotentialTarget& Shape;
};

// Starts the band. Returns false if `progress` cancelled the start. Warns if there is no skin.
// Throws like NarrowBand::Start.
bool StartOn(NarrowBand& band, const SurfaceStart& start, Warnings& messages,
  const ProgressFunction& progress);

}

#endif
