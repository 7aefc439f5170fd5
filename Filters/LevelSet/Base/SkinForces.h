/**
 * Inputs of FindSpeeds (SkinMotion.h), except the surface.
 */
#ifndef SkinForces_h
#define SkinForces_h

#include "Base/Motion.h"
#include "Base/Target.h"

namespace activesurface
{

struct SkinForces
{
  const Motion& Parameters;
  activesurface::Target& Target;
  double StartArea;
  double StartVolume;
  /** Times of the frames before and after the surface's time. Used only by the node scheme. */
  double Begin = 0.0;
  double End = 0.0;
};

}

#endif
