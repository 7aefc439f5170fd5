// Fits of the particles near a surface: ellipsoids, and bulks (how much of a body surrounds each
// particle). If the blocks have full cells (HasInside), particles deep in a body have no fit,
// because their kernels do not reach a surface. There are three passes:
//
// - Ellipsoid: shape and centre for each particle.
// - Lack: the sum of kernels at the particle's expected surface, minus the sum for an isolated
//   particle.
// - Strength: from the mean lack of the neighbours.

#ifndef NodeFits_h
#define NodeFits_h

#include "Index/ParallelTasks.h"
#include "Index/UnsetVector.h"
#include "Nodes/FitKernels.h"
#include "Nodes/GhostParticles.h"
#include "Nodes/NodeSums.h"
#include "Nodes/ParticleBlocks.h"

#include <cstddef>
#include <cstdint>

namespace activesurface
{

// Up to FewParticles particles may all be neighbours of each other. Larger inputs are refused, or
// get bulks of 0 (see Find), if the particles have more than MostNeighbours neighbours on average,
// a hundred times the usual number: visiting all pairs would need hours. The average is over a
// sample.
constexpr std::size_t FewParticles = 30000;

constexpr std::size_t MostNeighbours = 20000;

constexpr std::size_t ParticlesOfSample = 256;

[[noreturn]] void RefuseNeighbours(std::size_t particles);

// Rows of the columns that contain only the particles near a surface, in the order of the blocks.
class NearRows
{
public:
  // Reuses allocated memory.
  void Build(const ParticleBlocks& blocks)
  {
    const std::size_t count = blocks.GetOrder().size();
    this->Rows.resize(count + 1);
    std::uint32_t near = 0;
    for (std::size_t n = 0; n < blocks.Size(); ++n)
    {
      for (int part = 0; part < ParticleBlocks::Parts; ++part)
      {
        const std::uint32_t step = IsNear(blocks[n], part) ? 1 : 0;
        for (std::uint32_t k = blocks[n].Starts[part]; k < blocks[n].Starts[part + 1]; ++k)
        {
          this->Rows[k] = near;
          near += step;
        }
      }
    }
    this->Rows[count] = near;
  }

  std::size_t Size() const { return this->Rows.back(); }

  // The row of a particle near a surface; for another particle, the row of the next particle near a
  // surface.
  std::uint32_t operator[](std::uint32_t particle) const { return this->Rows[particle]; }
  const std::uint32_t* GetAll() const { return this->Rows.data(); }

  // Calls visit(block, particle, row) for all particles near a surface, blocks in parallel.
  template <class Visit>
  void ForEach(const ParticleBlocks& blocks, Visit&& visit) const
  {
    constexpr std::size_t blocksPerTask = 16;
    RunPieces(blocks.Size(), blocksPerTask,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t n = begin; n < end; ++n)
        {
          for (std::uint32_t k = blocks[n].Starts[0]; k < blocks[n].Starts[ParticleBlocks::Parts];
               ++k)
          {
            if (this->Rows[k + 1] > this->Rows[k])
            {
              visit(n, k, this->Rows[k]);
            }
          }
        }
      });
  }

private:
  static bool IsNear(const ParticleBlocks::Block& block, int part)
  {
    constexpr int side = ParticleBlocks::PartsOfSide;
    return ParticleBlocks::IsNearSurface(
      block, part / (side * side), part / side % side, part % side);
  }

  UnsetVector<std::uint32_t> Rows;
};

// Columns of the particles in the order of their blocks, padded by LanePadding. Lengths in voxels,
// positions relative to the block.
struct FitColumns
{
  const float *X, *Y, *Z;
  const float* OwnRadius;
  const float* Reach; // support radius in a body
  const float* Strength;
};

struct NodeFitOptions
{
  double WidePerReach = 1.0; // radius of the neighbourhood over support radius
  double Anisotropy = 4.0;   // largest ratio of axes
  bool HasEllipsoids = true; // otherwise finds only bulks and outward vectors
  bool HasTriangles = true;  // enlarges balls to compensate for their triangles
};

class NodeFits
{
public:
  // Reuses allocated memory. For too many neighbours (MostNeighbours), throws std::invalid_argument
  // if options.HasEllipsoids, otherwise sets the bulks to 0. ghosts: particles whose fits other
  // ranks find. Collective if `ghosts` was made with a domain.
  void Find(const ParticleBlocks& blocks, const FitColumns& given, const GhostParticles& ghosts,
    const NodeFitOptions& options);

  // Bulks in [0,1]; 1 deep in a body.
  const float* GetBulks() const { return this->Bulk.data(); }

  // Rows of the particles in the columns below.
  const std::uint32_t* GetRows() const { return this->Row.GetAll(); }
  // Centres are relative to the particle's block. A squared reach of 0 means no ellipsoid.
  EllipsoidColumns GetColumns() const
  {
    return { this->EX.data(), this->EY.data(), this->EZ.data(), this->EReach2.data() };
  }
  const NodeEllipsoid* GetEllipsoids() const { return this->Ellipsoids.data(); }
  // Reaches of the ellipsoids.
  const ParticleBlocks::Reaches& GetReaches() const { return this->Reaches; }

  // Evaluates the sum of the ellipsoids, and its gradient, at the positions of a group, relative to
  // the block `home`. Thread-safe.
  void SumAt(const NodeIndex& home, const FitGroup& group, PointSums& sums) const;

  // Finds the box of the ellipsoid of particle k [voxels], relative to the block of the particle:
  // xmin xmax ymin ... Returns false if the particle has no ellipsoid.
  bool FindBox(std::uint32_t k, float (&box)[6]) const;

  // For a particle at the surface of a body, finds the vector [voxels] away from its neighbours,
  // two own radii long. Returns false for other particles.
  bool FindOutward(std::uint32_t k, float (&outward)[3]) const;

private:
  struct Search;

  void Resize(std::size_t count);
  bool HasTooManyNeighbours() const;
  template <class IsWanted, class Visit>
  void ForEachGroup(IsWanted&& isWanted, Visit&& visit) const;
  void FillGroup(Search& search) const;
  template <class RowOf>
  void Gather(Search& search, const PlaceColumns& columns, const ParticleBlocks::Reaches& reaches,
    RowOf&& rowOf) const;
  void GatherNeighbours(Search& search) const;
  void GatherEllipsoids(Search& search) const;
  void FindShapes(Search& search);
  void KeepShape(std::uint32_t k, int column, const GroupFits& fits);
  void FindLacks(Search& search);
  void SumBeside(
    Search& search, const UnsetVector<float>& counting, std::size_t place, float (&sums)[8]) const;
  bool PlaceBeside(Search& search, const UnsetVector<float>& counting, std::size_t place) const;
  float FindFaded(std::uint32_t k, std::size_t place) const;
  void ListSurface();
  void FindStrengths(Search& search);
  void FindReaches();
  bool HasRow(std::uint32_t k) const { return this->Row[k + 1] > this->Row[k]; }
  void ShareShapes();
  void ShareLacks();
  void ShareStrengths();
  bool IsAtSurface(std::uint32_t k) const
  {
    const std::uint32_t i = this->Row[k];
    return this->Deep[i] > 0.f || this->Thin[i] > 0.f;
  }

  const ParticleBlocks* Blocks = nullptr;
  const GhostParticles* Ghosts = nullptr;
  FitColumns Given{};
  NodeFitOptions Options;
  ParticleBlocks::Reaches WideReaches; // of the neighbourhoods
  ParticleBlocks::Reaches Reaches;

  UnsetVector<float> Wide2, InverseWide2; // squared radii of the neighbourhoods
  UnsetVector<float> Bulk;
  NearRows Row;

  // Columns of particles near a surface.
  UnsetVector<float> EX, EY, EZ, EReach2;
  UnsetVector<NodeEllipsoid> Ellipsoids;
  // Results of the first pass.
  UnsetVector<float> Deep, Thin, Shape, Lone;
  UnsetVector<float> Places;      // Away x y z, Across x y z
  UnsetVector<float> Share, Lack; // of particles at the surface; otherwise 0

  // Particles at the surface, in the order of the rows.
  struct SurfaceColumns
  {
    UnsetVector<float> X, Y, Z, Wide2, InverseWide2, Share, Lack;
  };
  SurfaceColumns Surface;
  UnsetVector<std::uint32_t> SurfaceBefore; // number of particles at the surface before each row
};

}

#endif
