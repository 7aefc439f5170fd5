// Models of a fluid body made of particles.
//
// A particle has two lengths: the own radius r, given or half of the particle spacing, and the
// support radius R, where its kernel ends in a body. With Anisotropic, the surface of an isolated
// particle is a ball of radius r.

#ifndef ParticleModel_h
#define ParticleModel_h

namespace activesurface
{

enum class ParticleModel
{
  Sum,        // sum of kernels, see Skeleton.h
  Anisotropic // Yu and Turk 2013, see ParticleNodes.h
};

// Default support radius, divided by the spacing of the particles.
inline double GetReachPerSpacing(ParticleModel model)
{
  return model == ParticleModel::Anisotropic ? 2.25 : 2.0;
}

// Radius of the neighbourhood that a fit uses [support radii]: 7.25 own radii with the default
// support radius. Larger values give flatter surfaces and cost more.
inline double GetNeighbourhoodPerRadius(ParticleModel model)
{
  return 7.25 / (2.0 * GetReachPerSpacing(model));
}

}

#endif
