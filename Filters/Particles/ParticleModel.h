// Models of a fluid body made of particles.
//
// A particle has two lengths. The own radius r, as given or half of the usual spacing, is the
// radius of the surface of an isolated particle. The influence of a particle ends at the support
// radius R.

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
