// Particles as a target at the nodes of a lattice: see NodeTarget.h in NarrowBand.
//
// The potential of ellipsoids is G = 1 - S^(1/4), S the sum of strength (1 - d^2)^3. The
// skin of a body is where kernels end and S grows with the fifth power of the depth, that of a lone
// particle where it grows with the third: the root is nearly linear in both.
//
// Lengths are in voxels, places are relative to the block or the leaf that they belong to: so
// single precision suffices wherever the particles are.

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

// Particles that are asked for one by one, several times each and by several threads.
class NodeParticles
{
public:
  virtual std::size_t Size() const = 0;
  virtual SkeletonVertex Get(std::size_t n) const = 0;
  // Finds x y z [length / motion time]. Returns false if unknown.
  virtual bool FindVelocity(std::size_t n, double (&velocity)[3]) const = 0;

protected:
  ~NodeParticles() = default;
};

struct NodeParticleOptions
{
  ParticleModel Model = ParticleModel::Anisotropic;
  double VoxelSize = 1.0;
  double OwnRadius = 0.0; // [length]; 0: the particle's reach over ReachPerRadius
  double ReachPerRadius = 4.5;
  double Anisotropy = 4.0;       // largest ratio of an ellipsoid's axes
  bool WantsBulks = true;        // else all particles count as in a body
  bool AreForPoints = false;     // fits everywhere, as ParticlePotential needs, not only near nodes
  bool HasVelocities = false;    // else no particle moves
  double Duration = 0.0;         // by which velocities are multiplied
  bool HasNoise = false;         // whether the motion of a body is without that of single particles
  const Domain* Space = nullptr; // shared out to ranks, for ParticleModel::Anisotropic only
};

// Longest half-axis of an ellipsoid over the particle's reach, where it is a body's.
constexpr double StretchInBody = 1.3;

// Distance along each axis from a rank's leaves within which it needs particles [voxels].
VTKACTIVEPARTICLES_EXPORT int FindMarginOfNodes(
  const NodeParticleOptions& options, double longestReach);

class VTKACTIVEPARTICLES_EXPORT ParticleNodes
{
public:
  // Keeps its memory. Collective with a domain; the particles then are at least those within the
  // margin of this rank's space.
  void Build(const NodeParticles& given, const NodeParticleOptions& options);

  void FindShell(bool wantsInside, Shell& shell) const;
  bool IsInside(const NodeIndex& node) const;

  // For points, in place of nodes.
  const ParticleBlocks& GetBlocks() const { return this->Blocks; }
  const NodeFits& GetFits() const { return this->Fits; }

  // Only for ParticleModel::Anisotropic.
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
  void ListLeaves(bool wantsInside, std::vector<NodeIndex>& origins) const;
  ShellLeaf FindRows(const NodeIndex& origin) const;
  const ParticleRuns& ListNear(const NodeIndex& origin, double size, double reach,
    const std::uint32_t* before = nullptr) const;

  NodeParticleOptions Options;
  ParticleBlocks Blocks;
  GhostParticles Ghosts;

  // By the order of the blocks, with room for a vector of eight more.
  UnsetVector<float> X, Y, Z;    // places
  UnsetVector<float> DX, DY, DZ; // displacements
  UnsetVector<float> IsMoved;    // 1, or 0 if the displacement is unknown
  UnsetVector<float> OwnRadius, Reach, Strength;
  UnsetVector<float> InverseReach2; // of the means of motion
  NodeFits Fits;
  double MostReachOfMotion = 0.0; // [voxels]
};

}

#endif
