#include "ParticleLengths.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// Neighbours are looked for within so many own radii, by usual proportions. For AveragedCentre it
// has to be the reach. For the others wider is flatter, and dearer.
double GetNeighbourhoodPerOwnRadius(ParticleModel model)
{
  return model == ParticleModel::AveragedCentre ? 6.0 : 7.25;
}

}

double FindLargestRadius(const std::vector<SkeletonVertex>& particles)
{
  double largest = 0.0;
  for (const SkeletonVertex& particle : particles)
  {
    largest = std::max(largest, particle.Radius);
  }
  return largest;
}

double FindLargestRadiusOfStrengths(const std::vector<SkeletonVertex>& particles)
{
  double largest = 0.0;
  for (const SkeletonVertex& particle : particles)
  {
    largest = particle.Strength > 0.0 ? std::max(largest, particle.Radius) : largest;
  }
  return largest;
}

double GetNeighbourhoodPerRadius(ParticleModel model)
{
  return GetNeighbourhoodPerOwnRadius(model) / (2.0 * GetReachPerSpacing(model));
}

}
