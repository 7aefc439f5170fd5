// The ellipsoid of a particle's influence, stretched as its neighbourhood is (Yu and Turk 2013).

#ifndef Ellipsoid_h
#define Ellipsoid_h

#include "ParticleModel.h"
#include "Skeleton/NeighbourSums.h"

namespace activesurface
{

// The covariance of a neighbourhood: its half-axes and their directions.
struct NeighbourhoodShape
{
  explicit NeighbourhoodShape(const NeighbourMoments& sums);

  double Mean[3] = { 0.0, 0.0, 0.0 }; // offset to the mean of the neighbours
  double Axes[3] = { 0.0, 0.0, 0.0 }; // standard deviations, largest first
  double Frame[3][3] = {};            // their directions, in columns

  // In [0,1]: 1 for a sheet or a thread of one layer and for a single place, 0 for a body. reach:
  // of the neighbourhood.
  double GetThinness(double reach) const;
};

// In [0,1]: whether near neighbours make a shape of it, more than a drop; near: the sum of their
// weights.
double GetShapeShare(double near);

struct EllipsoidOptions
{
  double Reach;      // radius of the ball of the same volume
  double Anisotropy; // largest ratio of axes
  double ShapeShare;
};

// Offset, Metric and Reach of the fit: the centre moves to the mean of the neighbours, the axes are
// as the neighbourhood's. With few neighbours the ellipsoid tends to a ball around the particle.
void FitEllipsoid(
  const NeighbourhoodShape& shape, const EllipsoidOptions& options, ParticleFit& fit);

}

#endif
