// Weights of the particles at a point: the absolute contributions of their kernels, normalized to a
// sum of 1. Outside of all kernels, as on a skin that lags behind, the nearest particle has weight
// 1.

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
  // particles: at least one.
  ParticleWeights(const std::vector<SkeletonVertex>& particles, SkeletonKernel kernel);

  // Replaces weights by at least one, in ascending order of particles. Thread-safe.
  void Find(const double x[3], std::vector<SkeletonWeight>& weights) const;

private:
  const SkeletonKernel Kernel;
  Skeleton Elements;
  vtkNew<vtkPolyData> Cloud;
  vtkNew<vtkStaticPointLocator> Locator;
};

}

#endif
