// Sums over the neighbours of places, with the weight (1 - d^2/R^2)^2 of a particle in reach R:
// what fits are made of.

#ifndef NeighbourSums_h
#define NeighbourSums_h

#include "BallCells.h"
#include "Skeleton.h"

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

  // Of some of the particles of another one. What the others would add as zeros may be left out:
  // the sums are the same ones, to the bit.
  NeighbourSums(const NeighbourSums& all, const std::vector<SkeletonVertex>& some);

  // The numbers of all particles, by cells: places near one another are evaluated faster together.
  const UnsetVector<BallCells::Index>& GetOrder() const { return this->Near.GetOrder(); }

  // At places (x y z each).
  void FindMoments(std::size_t count, const double* places, NeighbourMoments* moments) const;

  // How many are near a place, or a few more.
  std::size_t CountNear(const double x[3]) const;

  // Of the amount times two numbers of each particle, Share and Value, in this order: sum w Share,
  // and sum w Share Value.
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
