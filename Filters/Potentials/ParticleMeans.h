// What particles carry, averaged around a place: their velocity, and whether they are in a body of
// fluid. Weights are (1 - d^2/R^2)^2, as in ParticlePotential.

#ifndef ParticleMeans_h
#define ParticleMeans_h

#include "ElementIndex.h"
#include "Skeleton.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class VTKACTIVEPOTENTIALS_EXPORT ParticleMeans
{
public:
  // Forgets the particles, keeps the memory.
  void Clear();

  // velocity: null, or with a number that is not finite: unknown, left out of that mean. Vertices
  // have to be usable; those of strength <= 0 add nothing.
  void Add(const SkeletonVertex& particle, const double velocity[3], double bulk);

  // Comes after the last particle and before the first evaluation. Throws as ElementIndex does.
  void Build();

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

  std::vector<Element> Elements;
  ElementIndex Near;
};

}

#endif
