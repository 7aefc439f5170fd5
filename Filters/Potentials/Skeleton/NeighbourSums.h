// Sums over the neighbours of single places, with the weight (1 - d^2/R^2)^2 of a particle in reach
// R: what fits are made of.

#ifndef NeighbourSums_h
#define NeighbourSums_h

#include "ElementIndex.h"
#include "Skeleton.h"
#include "Skeleton/HitVisits.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// Of the offsets from a place to its neighbours.
struct NeighbourMoments
{
  double Weight = 0.0;
  double Near = 0.0; // the same of those within .55 reaches, with the weight (1 - (d/.55R)^2)^2
  double First[3] = { 0.0, 0.0, 0.0 };
  double Second[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }; // xx xy xz yy yz zz
};

class NeighbourSums
{
public:
  // Reaches are those of the particles times a factor. Those of strength <= 0 are no neighbours.
  NeighbourSums(const std::vector<SkeletonVertex>& particles, double factor);

  NeighbourMoments FindMoments(const double x[3]) const;

  // How many are near a place, or a few more.
  std::size_t CountNear(const double x[3]) const;

  // Of the amount times two numbers of each particle, Share and Value: sum w Share, and
  // sum w Share Value.
  struct Shares
  {
    double Share = 0.0;
    double Value = 0.0;
  };
  Shares FindShares(const double x[3], const std::vector<Shares>& ofParticles) const;

private:
  // Calls visit(particle, weight, offset).
  template <class Visitor>
  void Visit(const double x[3], Visitor visit) const;

  const std::vector<SkeletonVertex>& Particles;
  std::vector<double> InverseReach2;
  ElementIndex Near;
};

}

#endif
