#include "Skeleton/SurfacePlaces.h"

#include "Skeleton/Ellipsoid.h"
#include "Skeleton/SmoothStep.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// A particle counts as one of the surface by how far it is from the mean of its neighbourhood, in
// reaches of that: .24 in a flat layer of a deep body, below .1 inside.
constexpr double LeastDepth = 0.1;
constexpr double FullDepth = 0.22;

// How much farther than its own radius the surface is from a particle of a body, for what the edges
// of the body lose.
constexpr double OffsetOfBody = 0.1;

// Sum of weights of the neighbours, in that of a whole ball with one particle in each (2 r)^3, from
// which on there is a body: .28 in a sheet of one layer, .63 in the outermost layer of a deep body
// (which then has .73 of its tension), .87 in the next.
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
  fit.Strength = 1.0; // until it is known

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
