// The potential of particles by one of the models that look at a particle's neighbours, negative
// inside.
//
// AveragedCentre: F(x) = |x - c| - g(P) r, with c and r the means of the particles' positions and
// fitted radii around x, weighted by (1 - d^2/R^2)^2. (Two is the least power with a continuous
// gradient, and the flattest for a reach.) Between separate or around concave parts c jumps, and
// pieces appear far from all particles. So g, a smooth step from 1 to -1, falls where the presence
// P, a sum of narrow kernels, falls below that at the surface of a lone particle.
//
// Anisotropic: F(x) = 1/2 - sum of strength (1 - dT Metric d)^3, d from the fitted centre.
//
// Outside all reaches F is constant: the largest reach, or 1/2 (without particles, too). Sums are
// by cells, in the order of the particles within a cell, so they have the same bits for any batch,
// thread and instruction set, whatever other particles there are.

#ifndef ParticlePotential_h
#define ParticlePotential_h

#include "BallCells.h"
#include "ParticleModel.h"
#include "Skeleton.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class VTKACTIVEPOTENTIALS_EXPORT ParticlePotential
{
public:
  // Comes before the first evaluation; each particle has a fit. Those with a strength <= 0 add
  // nothing. Vertices have to be usable. Not for ParticleModel::Sum. Keeps its memory. Throws as
  // BallCells do.
  void Build(
    ParticleModel model, const std::vector<SkeletonVertex>& particles, const ParticleFits& fits);

  // No particles at all.
  void Clear() { this->Build(ParticleModel::AveragedCentre, {}, {}); }

  // What the order of the sums is for: with another one all values may be off by rounding.
  double GetCellSize() const { return this->Near.GetCellSize(); }

  // At points (x y z each); gradients may be null. A point that is not finite gets NaN.
  // Thread-safe.
  void Evaluate(std::size_t count, const double* points, double* values, double* gradients) const;

  // The box of all reaches: xmin xmax ymin ... Meaningless without particles.
  const double* GetBounds() const { return this->Near.GetBounds(); }

  // The value of AveragedCentre where no particle reaches.
  double GetOutside() const { return this->LargestRadius > 0.0 ? this->LargestRadius : 0.5; }

private:
  struct CentreElement
  {
    double Position[3];
    double Weight;
    double InverseReach2;
    double OwnRadius;
    double Presence;
    double InverseNear2;
  };
  struct AnisotropicElement
  {
    double Position[3];
    double Strength;
    double Metric[6];
  };
  struct Results;
  struct CentreField;
  struct AnisotropicField;
  template <class Field>
  void EvaluateField(
    std::size_t count, const double* points, double* values, double* gradients) const;

  BallCells::Ball MakeBall(const SkeletonVertex& particle, const ParticleFit& fit) const;
  static CentreElement MakeCentre(const SkeletonVertex& particle, const ParticleFit& fit);
  static AnisotropicElement MakeEllipsoid(const SkeletonVertex& particle, const ParticleFit& fit);

  ParticleModel Model = ParticleModel::AveragedCentre;
  double LargestRadius = 0.0;
  UnsetVector<CentreElement> Centres; // in the order of the cells, and so are the ellipsoids
  UnsetVector<AnisotropicElement> Ellipsoids;
  BallCells Near;

  // Of Build, kept for their memory: the particles that add something, and their numbers.
  UnsetVector<BallCells::Ball> Balls;
  std::vector<std::size_t> Numbers;
};

}

#endif
