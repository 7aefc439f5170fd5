/**
 * What the speed of the skin follows from, besides the surface.
 */
#ifndef SkinForces_h
#define SkinForces_h

#include "Motion.h"
#include "Target.h"

namespace activesurface
{

struct SkinForces
{
  const Motion& Strategy;
  Target& Attractor;
  double StartArea;
  double StartVolume;
  /** Motion times of the frames before and after the surface, for the node scheme. */
  double Begin = 0.0;
  double End = 0.0;
};

}

#endif
