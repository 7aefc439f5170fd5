// What particles carry, averaged around a place: their velocity, and whether they are in a body of
// fluid. Weights are (1 - d^2/R^2)^2, as in ParticlePotential.

#ifndef ParticleMeans_h
#define ParticleMeans_h

#include "BallCells.h"
#include "ParticleModel.h"
#include "Skeleton.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class VTKACTIVEPOTENTIALS_EXPORT ParticleMeans
{
public:
  // Of each particle: x y z, with a number that is not finite if it is unknown, to be left out of
  // that mean; and the bulk. Either may be empty: all are unknown, all bulks 1.
  struct Carried
  {
    const std::vector<double>& Velocities;
    const ParticleFits& Fits;
  };

  // Comes before the first evaluation. Vertices have to be usable; those of strength <= 0 add
  // nothing. Keeps its memory. Throws as BallCells do. largestRadius: as of ParticlePotential.
  void Build(const std::vector<SkeletonVertex>& particles, const Carried& carried,
    double largestRadius = 0.0);

  // What the order of the sums is for: with another one all values may be off by rounding.
  double GetCellSize() const { return this->Near.GetCellSize(); }

  // At points (x y z each): velocities (x y z each) and bulks; either may be null. Out of reach of
  // all particles whose velocity is known that is not a number; of all particles the bulk is 0.
  // Thread-safe.
  void Evaluate(std::size_t count, const double* points, double* velocities, double* bulks) const;

private:
  struct Element
  {
    double Position[3];
    double Weight;
    double InverseReach2;
    double KnownWeight; // Weight, or 0 where the velocity is unknown
    double Velocity[3];
    double Bulk;
  };
  struct Field;

  static Element MakeElement(const SkeletonVertex& particle, std::size_t i, const Carried& carried);

  UnsetVector<Element> Elements; // in the order of the cells
  BallCells Near;

  // Of Build, kept for their memory: the particles that add something, and their numbers.
  UnsetVector<BallCells::Ball> Balls;
  std::vector<std::size_t> Numbers;
};

}

#endif
