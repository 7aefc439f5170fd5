// Static particles for the node scheme.

#ifndef ParticlesAtRest_h
#define ParticlesAtRest_h

#include "ParticleNodes.h"

#include <vector>

class ParticlesAtRest final : public activesurface::NodeParticles
{
public:
  // The caller keeps the particles.
  explicit ParticlesAtRest(const std::vector<activesurface::SkeletonVertex>& particles)
    : Particles(particles)
  {
  }

  std::size_t Size() const override { return this->Particles.size(); }
  activesurface::SkeletonVertex Get(std::size_t n) const override { return this->Particles[n]; }
  bool FindVelocity(std::size_t, double (&velocity)[3]) const override
  {
    velocity[0] = velocity[1] = velocity[2] = 0.0;
    return true;
  }

private:
  const std::vector<activesurface::SkeletonVertex>& Particles;
};

#endif
