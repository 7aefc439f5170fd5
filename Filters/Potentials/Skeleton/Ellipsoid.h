// Ellipsoid of a particle's influence, stretched like its neighbourhood (Yu and Turk 2013).

#ifndef Ellipsoid_h
#define Ellipsoid_h

#include "ParticleModel.h"
#include "Skeleton/NeighbourSums.h"

namespace activesurface
{

// Covariance of a neighbourhood: its half-axes and their directions.
struct NeighbourhoodShape
{
  explicit NeighbourhoodShape(const NeighbourMoments& sums);

  double Mean[3] = { 0.0, 0.0, 0.0 }; // offset to the mean of the neighbours
  double Axes[3] = { 0.0, 0.0, 0.0 }; // standard deviations, largest first
  double Frame[3][3] = {};            // their directions, in columns

  // In [0,1]: 1 for a sheet or thread of one layer and for coincident particles, 0 for a body.
  // reach: radius of the neighbourhood.
  double GetThinness(double reach) const;
};

// In [0,1]: 1 if the near neighbours make a shape larger than a drop. near: sum of their weights.
double GetShapeShare(double near);

struct EllipsoidOptions
{
  double Reach;      // radius of the ball of the same volume
  double Anisotropy; // largest ratio of axes
  double ShapeShare;
};

// Sets Offset, Metric and Reach of the fit. The centre moves toward the mean of the neighbours, and
// the axes follow the neighbourhood. With few neighbours the ellipsoid tends to a ball around the
// particle.
void FitEllipsoid(
  const NeighbourhoodShape& shape, const EllipsoidOptions& options, ParticleFit& fit);

}

#endif
