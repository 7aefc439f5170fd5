// Potential of particles at any point: F = (1 - S) / 2, negative inside. S is the sum of strength
// (1 - d^2)^3 over ellipsoids fitted to the particles (Nodes/NodeFits.h, without HasTriangles); d
// is the distance from an ellipsoid's centre, divided by its radius in this direction. Implicit
// functions and explicit substeps use this potential. The node scheme uses ParticleNodes.h, which
// evaluates S at nodes.
//
// F and its gradient are bitwise identical for any batch, thread and instruction set.

#ifndef ParticlePotential_h
#define ParticlePotential_h

#include "ParticleNodes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class VTKACTIVEPARTICLES_EXPORT ParticlePotential
{
public:
  // Call before the first evaluation. Uses the options' model, radii and anisotropy. Particles with
  // a strength <= 0 add nothing. With ParticleModel::Sum only FindOutward works. Throws
  // std::invalid_argument for too many neighbours (NodeFits::Find), and for a coordinate of at
  // least 10^9 times the smallest own radius.
  void Build(const std::vector<SkeletonVertex>& particles, NodeParticleOptions options);

  // Evaluates F, and its gradient unless `gradients` is null, at points (x y z each). Values and
  // gradients are NaN at a point that is not finite. Thread-safe.
  void Evaluate(std::size_t count, const double* points, double* values, double* gradients) const;

  // Finds the box of a particle's ellipsoid [length]: xmin xmax ymin ... Returns false if the
  // particle has no ellipsoid.
  bool FindSupport(std::size_t particle, double (&bounds)[6]) const;

  // For a particle at the surface of a body, finds the vector [length] away from its neighbours,
  // two own radii long. Returns false for other particles.
  bool FindOutward(std::size_t particle, double (&outward)[3]) const;

  // Finds the bounding box of all ellipsoids; returns false if there are none.
  bool FindBounds(double (&bounds)[6]) const;

private:
  class Batch;

  double Unit = 1.0; // voxel size of the nodes: the smallest own radius
  ParticleNodes Nodes;
  std::vector<std::uint32_t> Places; // index of each particle in the order of the blocks
};

}

#endif
