#include "ParticleNodes.h"

#include "Index/ParallelTasks.h"
#include "Nodes/MotionMeans.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Kernel radius of the means of motion and bulk [own radii].
constexpr double ReachOfMotion = 4.5;
// Distance from an outermost particle of a body to the skin, minus 1 [own radii].
constexpr double BeyondOwnRadius = 0.1;
// Least half width of the shell around the skin [voxels]. See FindShellRadius.
constexpr double Band = 3.0;
// A displacement of this length or more along an axis counts as unknown [voxels].
constexpr double LongestDisplacement = 1e6;

void CheckPlace(double place)
{
  constexpr double farthest = 1e9; // node indices are 32-bit integers
  if (!(std::fabs(place) < farthest))
  {
    throw std::runtime_error("A particle is more than 10^9 voxels from the first time step's "
                             "particles (from ModelBounds, if set), too far for the lattice; "
                             "enlarge VoxelSize, or remove the particle.");
  }
}

}

double ParticleNodes::GetOwnRadius(const SkeletonVertex& particle) const
{
  return this->Options.OwnRadius > 0.0 ? this->Options.OwnRadius
                                       : particle.Radius / this->Options.ReachPerRadius;
}

class ParticleNodes::CubesOf final : public ParticleCubes
{
public:
  CubesOf(const ParticleNodes& nodes, const NodeParticles& given)
    : Nodes(nodes)
    , Given(given)
  {
  }

  std::size_t Size() const override { return this->Given.Size(); }
  ParticleCube Get(std::size_t n) const override
  {
    const SkeletonVertex particle = this->Given.Get(n);
    ParticleCube cube;
    for (int axis = 0; axis < 3; ++axis)
    {
      CheckPlace(particle.Position[axis] / this->Nodes.Options.VoxelSize);
      cube.Position[axis] = particle.Position[axis];
    }
    cube.HalfSide = this->Nodes.GetOwnRadius(particle);
    cube.Shell = this->Nodes.Options.AreForPoints ? 0.0 : this->Nodes.FindShellRadius(particle);
    cube.Filling = std::min(std::max(particle.Strength, 0.0), 1.0);
    return cube;
  }

private:
  const ParticleNodes& Nodes;
  const NodeParticles& Given;
};

// Particles listed on this rank.
class ParticleNodes::ListedParticles final : public NodeParticles
{
public:
  ListedParticles(const NodeParticles& all, const std::vector<std::uint32_t>& listed)
    : All(all)
    , Listed(listed)
  {
  }

  std::size_t Size() const override { return this->Listed.size(); }
  SkeletonVertex Get(std::size_t n) const override { return this->All.Get(this->Listed[n]); }
  bool FindVelocity(std::size_t n, double (&velocity)[3]) const override
  {
    return this->All.FindVelocity(this->Listed[n], velocity);
  }

private:
  const NodeParticles& All;
  const std::vector<std::uint32_t>& Listed;
};

void ParticleNodes::Build(const NodeParticles& given, const NodeParticleOptions& options)
{
  this->Options = options;
  const double longest =
    FindMost(given.Size(), 0.0, [&given](std::size_t n) { return given.Get(n).Radius; });
  this->Ghosts.Find(options.Space, FindMarginOfNodes(options, longest), given.Size(),
    [&](std::size_t n)
    {
      const SkeletonVertex particle = given.Get(n);
      for (const double position : particle.Position)
      {
        CheckPlace(position / options.VoxelSize);
      }
      return NodeBelow(particle.Position, options.VoxelSize);
    });
  if (options.Space)
  {
    this->BuildListed(ListedParticles(given, this->Ghosts.GetListed()), longest);
  }
  else
  {
    this->BuildListed(given, longest);
  }
}

void ParticleNodes::BuildListed(const NodeParticles& given, double longest)
{
  const NodeParticleOptions& options = this->Options;
  const std::size_t count = given.Size();
  this->Blocks.Build(CubesOf(*this, given),
    { options.VoxelSize, StretchInBody * longest,
      options.Model != ParticleModel::Sum && !options.AreForPoints });
  this->Ghosts.SetOrder(this->Blocks.GetOrder());
  this->Resize(count);
  RunPieces(count, ParticlesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        this->Place(given, k);
      }
    });
  this->MostReachOfMotion = FindMost(count, 0.0,
    [this](std::size_t k) { return ReachOfMotion * static_cast<double>(this->OwnRadius[k]); });
  this->FindFits();
}

// Returns the radius of a ball around a particle [length]. The nodes in this ball are in the shell,
// except in full cells. The ball extends at least an own radius beyond the skin: gaps of two own
// radii can be inside a body, and the shell includes these gaps.
double ParticleNodes::FindShellRadius(const SkeletonVertex& particle) const
{
  // A sum may have any iso-value, and balls of individual radii may overlap: the skin may be
  // anywhere within the kernels.
  if (this->Options.Model == ParticleModel::Sum || !(this->Options.OwnRadius > 0.0))
  {
    return particle.Radius + this->Options.VoxelSize;
  }
  const double own = this->GetOwnRadius(particle), voxel = this->Options.VoxelSize;
  const double skin = own * (1.0 + std::max(BeyondOwnRadius, FindLossOfBall(own / voxel)));
  return skin + std::max(own + voxel, Band * voxel);
}

void ParticleNodes::FindFits()
{
  const bool isAnisotropic = this->Options.Model == ParticleModel::Anisotropic;
  if (!isAnisotropic && !this->Options.WantsBulks)
  {
    return;
  }
  NodeFitOptions options;
  options.HasTriangles = !this->Options.AreForPoints;
  options.WidePerReach = GetNeighbourhoodPerRadius(this->Options.Model);
  options.Anisotropy = this->Options.Anisotropy;
  options.HasEllipsoids = isAnisotropic;
  this->Fits.Find(this->Blocks,
    { this->X.data(), this->Y.data(), this->Z.data(), this->OwnRadius.data(), this->Reach.data(),
      this->Strength.data() },
    this->Ghosts, options);
}

void ParticleNodes::Resize(std::size_t count)
{
  for (UnsetVector<float>* numbers :
    { &this->X, &this->Y, &this->Z, &this->DX, &this->DY, &this->DZ, &this->IsMoved,
      &this->OwnRadius, &this->Reach, &this->Strength, &this->InverseReach2 })
  {
    numbers->resize(count + LanePadding);
    std::fill_n(numbers->data() + count, LanePadding, 0.f);
  }
}

void ParticleNodes::Place(const NodeParticles& given, std::size_t k)
{
  const std::size_t n = this->Blocks.GetOrder()[k];
  const SkeletonVertex particle = given.Get(n);
  const double voxel = this->Options.VoxelSize;
  const ParticleBlocks::Block& block = this->Blocks[this->Blocks.GetBlockOf()[k]];
  float* const places[3] = { &this->X[k], &this->Y[k], &this->Z[k] };
  float* const displacements[3] = { &this->DX[k], &this->DY[k], &this->DZ[k] };
  double velocity[3] = { 0.0, 0.0, 0.0 };
  bool isKnown = !this->Options.HasVelocities || given.FindVelocity(n, velocity);
  for (int axis = 0; axis < 3; ++axis)
  {
    *places[axis] = static_cast<float>(
      particle.Position[axis] / voxel - this->Blocks.GetBlockSize() * block.At[axis]);
    const double way = velocity[axis] * this->Options.Duration / voxel;
    isKnown = isKnown && std::fabs(way) < LongestDisplacement;
    *displacements[axis] = static_cast<float>(way);
  }
  if (!isKnown)
  {
    *displacements[0] = *displacements[1] = *displacements[2] = 0.f;
  }
  this->IsMoved[k] = isKnown ? 1.f : 0.f;
  const double own = this->GetOwnRadius(particle) / voxel, reach = ReachOfMotion * own;
  this->OwnRadius[k] = static_cast<float>(own);
  this->Reach[k] = static_cast<float>(particle.Radius / voxel);
  this->Strength[k] = static_cast<float>(particle.Strength);
  this->InverseReach2[k] = static_cast<float>(1.0 / (reach * reach));
}

bool ParticleNodes::IsInside(const NodeIndex& node) const
{
  return this->Blocks.IsInside(
    { this->Blocks.CellOf(node[0]), this->Blocks.CellOf(node[1]), this->Blocks.CellOf(node[2]) });
}

// Lists the leaves that overlap a block with a part of the shell or, with wantsInside, with full
// cells.
void ParticleNodes::ListLeaves(bool wantsInside, std::vector<NodeIndex>& origins) const
{
  IndexMap found;
  const double size = this->Blocks.GetBlockSize();
  for (std::size_t i = 0; i < this->Blocks.Size(); ++i)
  {
    const ParticleBlocks::Block& block = this->Blocks[i];
    const bool isFull = std::any_of(block.Open.Word.begin(), block.Open.Word.end(),
      [](std::uint64_t word) { return ~word != 0; });
    if (!ParticleBlocks::ShellOf(block).Any() && !(wantsInside && isFull))
    {
      continue;
    }
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = static_cast<int>(std::floor(size * block.At[axis] / 8.0));
      last[axis] = static_cast<int>(std::floor(size * (block.At[axis] + 1.0) / 8.0));
    }
    NodeIndex leaf;
    for (leaf[0] = first[0]; leaf[0] <= last[0]; ++leaf[0])
    {
      for (leaf[1] = first[1]; leaf[1] <= last[1]; ++leaf[1])
      {
        for (leaf[2] = first[2]; leaf[2] <= last[2]; ++leaf[2])
        {
          if (static_cast<std::size_t>(found.Add(leaf)) == origins.size())
          {
            origins.push_back({ 8 * leaf[0], 8 * leaf[1], 8 * leaf[2] });
          }
        }
      }
    }
  }
}

void ParticleNodes::FindShell(bool wantsInside, Shell& shell) const
{
  std::vector<NodeIndex> origins;
  this->ListLeaves(wantsInside, origins);
  std::sort(origins.begin(), origins.end());
  std::vector<ShellLeaf> leaves(origins.size());
  constexpr std::size_t leavesPerTask = 16;
  RunPieces(origins.size(), leavesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        leaves[i] = this->FindRows(origins[i]);
      }
    });
  shell.Leaves.clear();
  shell.InsideLeaves.clear();
  for (const ShellLeaf& leaf : leaves)
  {
    if (leaf.Rows != 0)
    {
      shell.Leaves.push_back(leaf);
    }
    else if (wantsInside && leaf.InsideRows != 0)
    {
      shell.InsideLeaves.push_back(leaf.Origin);
    }
  }
}

ShellLeaf ParticleNodes::FindRows(const NodeIndex& origin) const
{
  ShellLeaf leaf{ origin, 0, 0 };
  int cells[3][8];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int n = 0; n < 8; ++n)
    {
      cells[axis][n] = this->Blocks.CellOf(origin[axis] + n);
    }
  }
  const int first = cells[2][0], last = cells[2][7];
  for (int x = 0; x < 8; ++x)
  {
    for (int y = 0; y < 8; ++y)
    {
      const std::uint64_t bit = std::uint64_t(1) << (8 * x + y);
      if (y > 0 && cells[1][y] == cells[1][y - 1])
      {
        leaf.Rows |= (leaf.Rows << 1) & bit;
        leaf.InsideRows |= (leaf.InsideRows << 1) & bit;
        continue;
      }
      unsigned shell = 0, inside = 0;
      for (int block = first >> 3; block <= last >> 3; ++block)
      {
        const NodeIndex at = { cells[0][x] >> 3, cells[1][y] >> 3, block };
        const ParticleBlocks::Block* found = this->Blocks.Find(at);
        unsigned wanted = 0xffu;
        wanted &= block == first >> 3 ? 0xffu << (first & 7) : 0xffu;
        wanted &= block == last >> 3 ? 0xffu >> (7 - (last & 7)) : 0xffu;
        if (found)
        {
          const unsigned open = found->Open.Row(cells[0][x] & 7, cells[1][y] & 7);
          const unsigned occupied = found->Occupied.Row(cells[0][x] & 7, cells[1][y] & 7);
          shell |= open & occupied & wanted;
          inside |= ~open & wanted;
        }
      }
      leaf.Rows |= shell ? bit : 0;
      leaf.InsideRows |= !shell && inside ? bit : 0;
    }
  }
  return leaf;
}

// Lists the particles whose supports may touch a cube of nodes. size: side of the cube [voxels].
// reach: largest support radius [voxels]. before: number of column rows before each particle; null:
// each particle has a row.
const ParticleRuns& ParticleNodes::ListNear(
  const NodeIndex& origin, double size, double reach, const std::uint32_t* before) const
{
  thread_local ParticleRuns runs;
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = origin[axis] - reach;
    high[axis] = origin[axis] + size + reach;
  }
  runs.clear();
  this->Blocks.VisitRuns(low, high,
    [&](std::uint32_t first, std::uint32_t end, const NodeIndex& at)
    {
      ParticleRun run{ before ? before[first] : first, before ? before[end] : end, {} };
      for (int axis = 0; axis < 3; ++axis)
      {
        run.Shift[axis] = static_cast<float>(this->Blocks.GetBlockSize() * at[axis] - origin[axis]);
      }
      runs.push_back(run);
    });
  return runs;
}

void ParticleNodes::EvaluateLeaf(const ShellLeaf& leaf, float* values) const
{
  constexpr double size = 7.0;
  FindPotential(this->Fits.GetColumns(), this->Fits.GetEllipsoids(),
    this->ListNear(leaf.Origin, size, this->Fits.GetLongestReach(), this->Fits.GetRows()),
    leaf.Rows, values);
}

void ParticleNodes::FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const
{
  constexpr double size = 8.0;
  const bool hasBulks =
    this->Options.Model == ParticleModel::Anisotropic || this->Options.WantsBulks;
  const MotionColumns columns = { { this->X.data(), this->Y.data(), this->Z.data() },
    { this->DX.data(), this->DY.data(), this->DZ.data() }, this->IsMoved.data(),
    hasBulks ? this->Fits.GetBulks() : nullptr, this->InverseReach2.data() };
  FindMotionMeans(columns, this->ListNear(leaf.Origin, size, this->MostReachOfMotion),
    this->Options.HasNoise, motion);
}

}
