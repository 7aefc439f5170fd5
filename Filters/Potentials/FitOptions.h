// How particles are fitted, see ParticleFit.h.

#ifndef FitOptions_h
#define FitOptions_h

#include "ParticleModel.h"

namespace activesurface
{

class Agreement;

struct FitOptions
{
  ParticleModel Model = ParticleModel::AveragedCentre;
  double OwnRadius = 0.0;     // r [length]; 0: the particle's reach over twice GetReachPerSpacing
  double Anisotropy = 4.0;    // largest ratio of an ellipsoid's axes
  bool SparesCrowds = false;  // where there are too many in one place, all fits are as of none
  Agreement* Ranks = nullptr; // that fit the same particles together, or null
};

}

#endif
