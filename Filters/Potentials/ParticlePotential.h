// Potential of particles by a model that depends on the particles' neighbours; negative inside.
//
// AveragedCentre: F(x) = |x - c| - g(P) r, with c and r the means of the particles' positions and
// fitted radii around x, weighted by (1 - d^2/R^2)^2. (Two is the smallest power with a continuous
// gradient, and the flattest for a support radius.) The mean c jumps between separate parts and
// around concave ones, which would create surfaces far from all particles. So g, a smooth step from
// 1 to -1, falls where the presence P falls below its value at the surface of an isolated particle.
// P is a sum of narrow kernels.
//
// Anisotropic: F(x) = 1/2 - sum of strength (1 - dT Metric d)^3, d from the fitted centre.
//
// F is constant outside all supports: the largest support radius, or 1/2 (without particles, too).
// Sums are by cells, in the order of the particles within a cell. They are bitwise identical for
// any batch, thread and instruction set, whatever other particles there are.

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
  // Precedes the first evaluation; each particle has a fit. Particles with a strength <= 0 add
  // nothing. Vertices have to be usable. Not for ParticleModel::Sum. Keeps allocated memory. Throws
  // as BallCells do.
  void Build(
    ParticleModel model, const std::vector<SkeletonVertex>& particles, const ParticleFits& fits);

  // Removes all particles.
  void Clear() { this->Build(ParticleModel::AveragedCentre, {}, {}); }

  // Returns the size that determines the order of sums; another size changes values by rounding.
  double GetCellSize() const { return this->Near.GetCellSize(); }

  // Evaluates at points (x y z each); gradients may be null. A point that is not finite gets NaN.
  // Thread-safe.
  void Evaluate(std::size_t count, const double* points, double* values, double* gradients) const;

  // Bounding box of all supports: xmin xmax ymin ... Undefined without particles.
  const double* GetBounds() const { return this->Near.GetBounds(); }

  // Returns the value of AveragedCentre outside all supports.
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
  UnsetVector<CentreElement> Centres; // in the order of the cells, like Ellipsoids
  UnsetVector<AnisotropicElement> Ellipsoids;
  BallCells Near;

  // Temporaries of Build, kept to reuse their memory: the particles that add something, and their
  // indices.
  UnsetVector<BallCells::Ball> Balls;
  std::vector<std::size_t> Numbers;
};

}

#endif
