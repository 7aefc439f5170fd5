#include "Skeleton/SurfacePlaces.h"

#include "Skeleton/Ellipsoid.h"
#include "Skeleton/SmoothStep.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// Distance of a particle from the mean of its neighbourhood, over the neighbourhood's radius.
// Particles belong to the surface above these limits: 0.24 in a flat layer of a deep body, below
// 0.1 inside.
constexpr double LeastDepth = 0.1;
constexpr double FullDepth = 0.22;

// Additional distance of the surface from a particle of a body, in its own radius. It compensates
// for the volume lost at the edges of the body.
constexpr double OffsetOfBody = 0.1;

// Sum of the neighbours' weights, relative to a whole ball with one particle in each (2 r)^3, above
// which there is a body. A sheet of one layer has 0.28. The outermost layer of a deep body has 0.63
// (and then 0.73 of its tension), the next one 0.87.
constexpr double LeastBody = 0.3;
constexpr double FullBody = 0.8;

double FindBulk(
  const NeighbourhoodOptions& options, const SkeletonVertex& particle, const NeighbourMoments& sums)
{
  // The integral of (1 - d^2/R^2)^2 over the ball of radius R, over (2 r)^3.
  const double cells = options.Reach / (2.0 * options.OwnRadius);
  const double whole = 32.0 * 3.14159265358979 / 105.0 * cells * cells * cells;
  const double others = sums.Weight - std::max(particle.Strength, 0.0);
  return SmoothStep(LeastBody, FullBody, others / whole);
}

}

void FitNeighbourhood(const NeighbourhoodOptions& options, const SkeletonVertex& particle,
  const NeighbourMoments& sums, ParticleFit& fit, SurfacePlaces& places)
{
  const double own = options.OwnRadius;
  fit = ParticleFit();
  fit.Bulk = FindBulk(options, particle, sums);
  fit.OwnRadius = own;
  fit.Strength = 1.0; // replaced once the missing kernel sum is shared

  const NeighbourhoodShape shape(sums);
  const double depth = std::hypot(shape.Mean[0], shape.Mean[1], shape.Mean[2]);
  places.Deep = SmoothStep(LeastDepth, FullDepth, depth / options.Reach);
  places.ShapeShare = GetShapeShare(sums.Near);
  places.Thin = shape.GetThinness(options.Reach);
  const double inward = shape.Frame[0][2] * shape.Mean[0] + shape.Frame[1][2] * shape.Mean[1] +
    shape.Frame[2][2] * shape.Mean[2];
  const double offset = own * (1.0 + OffsetOfBody * fit.Bulk);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double away = depth > 0.0 ? -shape.Mean[axis] / depth : 0.0;
    const double across = inward > 0.0 ? -shape.Frame[axis][2] : shape.Frame[axis][2];
    places.Away[axis] = particle.Position[axis] + offset * away;
    places.Across[axis] = particle.Position[axis] + offset * across;
    fit.Outward[axis] = places.Deep > 0.0 ? 2.0 * own * away : 0.0;
  }
  if (options.Model == ParticleModel::Anisotropic)
  {
    FitEllipsoid(shape, { particle.Radius, options.Anisotropy, places.ShapeShare }, fit);
  }
}

}
