// Particles as a target at the nodes of a lattice: see NodeTarget.h in LevelSet.
//
// The potential of ellipsoids is G = 1 - S^(1/4), with S the sum of strength (1 - d^2)^3. Here d is
// the distance from the centre of an ellipsoid, divided by the ellipsoid's radius in the same
// direction. The skin of a body is near the ends of the kernels' supports, where S grows with the
// fifth power of the depth below these ends. At the skin of an isolated particle, S grows with the
// third power. The fourth root is nearly linear in both cases.
//
// The columns are in voxels, with positions relative to a block or leaf, so that single precision
// suffices anywhere.

#ifndef ParticleNodes_h
#define ParticleNodes_h

#include "Base/NodeTarget.h"
#include "Index/Skeleton.h"
#include "Index/UnsetVector.h"
#include "Nodes/GhostParticles.h"
#include "Nodes/NodeFits.h"
#include "Nodes/ParticleBlocks.h"
#include "Nodes/ParticleRuns.h"
#include "ParticleModel.h"
#include "vtkActiveParticlesModule.h"

#include <vector>

namespace activesurface
{

// Particles, read one by one, repeatedly and by several threads at once.
class NodeParticles
{
public:
  virtual std::size_t Size() const = 0;
  virtual SkeletonVertex Get(std::size_t n) const = 0;
  // Finds the velocity x y z [length / (pipeline time * TimeScale)]. Returns false if unknown.
  virtual bool FindVelocity(std::size_t n, double (&velocity)[3]) const = 0;

protected:
  ~NodeParticles() = default;
};

struct NodeParticleOptions
{
  ParticleModel Model = ParticleModel::Anisotropic;
  double VoxelSize = 1.0; // [length]
  double OwnRadius = 0.0; // [length]; 0: support radius / ReachPerRadius
  double ReachPerRadius = 4.5;
  double Anisotropy = 4.0;       // largest ratio of an ellipsoid's axes
  bool WantsBulks = true;        // false: all bulks are 1 with ParticleModel::Sum
  bool AreForPoints = false;     // fits for any point (ParticlePotential), not only for nodes
  bool HasVelocities = false;    // otherwise no particle moves
  double Duration = 0.0;         // of the motion [pipeline time * TimeScale]
  bool HasNoise = false;         // removes the noise of single particles from the motion of a body
  const Domain* Space = nullptr; // partition among ranks; only for ParticleModel::Anisotropic
};

// Longest half-axis of an ellipsoid, divided by the support radius, for a particle in a body.
constexpr double StretchInBody = 1.3;

// Returns the distance from a rank's leaves, along each axis, within which the rank needs particles
// [voxels]. longestReach: longest support radius [length].
VTKACTIVEPARTICLES_EXPORT int FindMarginOfNodes(
  const NodeParticleOptions& options, double longestReach);

class VTKACTIVEPARTICLES_EXPORT ParticleNodes
{
public:
  // Reuses allocated memory. Throws std::runtime_error for a coordinate of at least 10^9 voxels,
  // std::invalid_argument for too many neighbours (NodeFits::Find). Collective with options.Space:
  // the given particles then have to include all particles within FindMarginOfNodes of this rank's
  // partition.
  void Build(const NodeParticles& given, const NodeParticleOptions& options);

  // Throws std::runtime_error if the boxes of leaves to search (VisitBoxes) have more than 2^33
  // voxels in total.
  void FindShell(bool wantsInside, Shell& shell) const;
  bool IsInside(const NodeIndex& node) const;

  // Access for evaluation at points instead of nodes.
  const ParticleBlocks& GetBlocks() const { return this->Blocks; }
  const NodeFits& GetFits() const { return this->Fits; }

  // EvaluateLeaf needs ParticleModel::Anisotropic.
  void EvaluateLeaf(const ShellLeaf& leaf, float* values) const;
  void FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const;

private:
  class CubesOf;
  class ListedParticles;
  void BuildListed(const NodeParticles& given, double longestReach);
  void Resize(std::size_t count);
  void Place(const NodeParticles& given, std::size_t k);
  void FindFits();
  double GetOwnRadius(const SkeletonVertex& particle) const;
  double FindShellRadius(const SkeletonVertex& particle) const;
  template <class Visit>
  void VisitBoxes(bool wantsInside, Visit&& visit) const;
  void CheckNumberOfLeaves(bool wantsInside) const;
  void ListLeaves(bool wantsInside, std::vector<NodeIndex>& origins) const;
  ShellLeaf FindRows(const NodeIndex& origin) const;
  const ParticleRuns& ListNear(const NodeIndex& origin, double size,
    const ParticleBlocks::Reaches& reaches, const std::uint32_t* before = nullptr) const;

  NodeParticleOptions Options;
  ParticleBlocks Blocks;
  GhostParticles Ghosts;

  // Columns in the order of the blocks, padded by LanePadding.
  UnsetVector<float> X, Y, Z;    // positions
  UnsetVector<float> DX, DY, DZ; // displacements
  UnsetVector<float> IsMoved;    // 1, or 0 if the displacement is unknown
  UnsetVector<float> OwnRadius, Reach, Strength;
  UnsetVector<float> InverseReach2; // for the means of motion
  NodeFits Fits;
  ParticleBlocks::Reaches ReachesOfMotion;
};

}

#endif
