// Models of a fluid body made of particles, and the properties of each particle in them.
//
// A particle has two lengths. Its own radius r, half of the usual spacing, is that of its surface
// if it is isolated. Its support radius R is where its influence ends.

#ifndef ParticleModel_h
#define ParticleModel_h

#include "UnsetVector.h"

#include <algorithm>

namespace activesurface
{

enum class ParticleModel
{
  Sum,            // sum of kernels, see Skeleton.h
  AveragedCentre, // Zhu and Bridson 2005
  Anisotropic     // Yu and Turk 2013
};

// Default support radius per spacing of the particles.
inline double GetReachPerSpacing(ParticleModel model)
{
  return model == ParticleModel::AveragedCentre ? 3.0
    : model == ParticleModel::Anisotropic       ? 2.25
                                                : 2.0;
}

// Properties of a particle among its neighbours. They are found once for each time step of the
// input and interpolated linearly in between. ParticleFit() has no neighbours and no size.
struct ParticleFit
{
  // In [0,1]: 0 for an isolated particle or a thread of few, 1 in a body of fluid.
  double Bulk;

  // Vector of the length of the spacing, away from the neighbours, at the edge of a body; else 0.
  double Outward[3];

  // Distance of the surface from the averaged centre, as a weighted mean over particles.
  double OwnRadius; // AveragedCentre

  // Anisotropic: the ellipsoid of influence, d^T Metric d = 1, where d is the vector from its
  // centre. The centre is the particle's position plus Offset.
  double Strength;
  double Reach; // at least the longest half-axis
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
