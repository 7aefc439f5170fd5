// How particles make a body of fluid: the models, and what each particle is in them.
//
// Lengths of a particle: its own radius r, half of the usual spacing, is where the surface of a
// lone one is; its reach R is where its influence ends.

#ifndef ParticleModel_h
#define ParticleModel_h

#include "UnsetVector.h"

#include <algorithm>

namespace activesurface
{

enum class ParticleModel
{
  Sum,            // of kernels, see Skeleton.h
  AveragedCentre, // Zhu and Bridson 2005
  Anisotropic     // Yu and Turk 2013
};

// Reach per spacing of the particles, where nobody says it.
inline double GetReachPerSpacing(ParticleModel model)
{
  return model == ParticleModel::AveragedCentre ? 3.0
    : model == ParticleModel::Anisotropic       ? 2.25
                                                : 2.0;
}

// What a particle is among its neighbours: found once for each time step of the input, and in
// between as it changes evenly. ParticleFit() is one without neighbours, and without a size.
struct ParticleFit
{
  // In [0,1]: 0 for a lone particle or in a thread of few, 1 in a body of fluid.
  double Bulk;

  // At the edge of a body: the spacing, in the direction away from its neighbours; else 0.
  double Outward[3];

  // How far from the averaged centre the surface is, where this particle's neighbourhood makes it.
  double OwnRadius; // AveragedCentre

  // Anisotropic: the ellipsoid of influence, dT Metric d = 1, around the position plus Offset.
  double Strength;
  double Reach; // the longest half-axis, or more
  double Offset[3];
  double Metric[6]; // xx xy xz yy yz zz

  bool IsAtEdge() const
  {
    return this->Outward[0] != 0.0 || this->Outward[1] != 0.0 || this->Outward[2] != 0.0;
  }
};

using ParticleFits = UnsetVector<ParticleFit>;

}

#endif
