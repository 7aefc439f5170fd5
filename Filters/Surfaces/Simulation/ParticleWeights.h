// How much each particle counts at a place: by what its kernel adds there, in sum 1.
//
// Where no kernel reaches, as on a skin that lags behind, the nearest particle counts alone. A
// negative strength counts by its size.

#ifndef ParticleWeights_h
#define ParticleWeights_h

#include "Skeleton.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <vector>

namespace activesurface
{

class ParticleWeights
{
public:
  // There has to be a particle.
  ParticleWeights(const std::vector<SkeletonVertex>& particles, SkeletonKernel kernel);

  // By ascending particle, at least one. Thread-safe.
  void Find(const double x[3], std::vector<SkeletonWeight>& weights) const;

private:
  const SkeletonKernel Kernel;
  Skeleton Elements;
  vtkNew<vtkPolyData> Cloud;
  vtkNew<vtkStaticPointLocator> Locator;
};

}

#endif
