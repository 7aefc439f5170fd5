// Sums over the neighbours of points, with the weight (1 - d^2/R^2)^2 of a particle of support
// radius R. Fits of particles are computed from these sums.

#ifndef NeighbourSums_h
#define NeighbourSums_h

#include "BallCells.h"
#include "Skeleton.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// Moments of the offsets from a point to its neighbours.
struct NeighbourMoments
{
  double Weight = 0.0;
  double Near = 0.0; // Weight of neighbours within 0.55 R, by (1 - (d/0.55R)^2)^2
  double First[3] = { 0.0, 0.0, 0.0 };
  double Second[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }; // xx xy xz yy yz zz
};

class NeighbourSums
{
public:
  // Support radii are those of the particles times a factor. Particles of strength <= 0 are
  // ignored.
  NeighbourSums(const std::vector<SkeletonVertex>& particles, double factor);

  // Sums over some of the particles of `all`. The sums are bitwise identical if the omitted
  // particles would only add zeros.
  NeighbourSums(const NeighbourSums& all, const std::vector<SkeletonVertex>& some);

  // Indices of all particles, ordered by cell: points near one another are evaluated faster
  // together.
  const UnsetVector<BallCells::Index>& GetOrder() const { return this->Near.GetOrder(); }

  // Evaluates the moments at points (x y z each).
  void FindMoments(std::size_t count, const double* places, NeighbourMoments* moments) const;

  // Returns at least the number of particles near a point.
  std::size_t CountNear(const double x[3]) const;

  // Evaluates sum w Share and sum w Share Value, where w is a particle's weight. ofParticles: the
  // two numbers of each particle, in the order of GetOrder().
  struct Shares
  {
    double Share;
    double Value;
  };
  void FindShares(std::size_t count, const double* places, const UnsetVector<Shares>& ofParticles,
    Shares* shares) const;

private:
  struct Element
  {
    double Position[3];
    double Strength; // 0 for one that is no neighbour
    double InverseReach2;
  };
  struct MomentField;
  struct ShareField;

  void Build(const std::vector<SkeletonVertex>& particles, double cellSize);

  double Factor;
  UnsetVector<Element> Elements; // in the order of the cells
  BallCells Near;
};

}

#endif
