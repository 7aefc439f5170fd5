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
// A smaller strength counts as 0, because products of small strengths underflow to 0.
constexpr double LeastStrength = 1e-20;

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
  this->Blocks.FindReaches([this](std::uint32_t k)
    { return ReachOfMotion * static_cast<double>(this->OwnRadius[k]); },
    this->ReachesOfMotion);
  this->FindFits();
}

// Returns the radius of a ball around a particle [length]. The nodes in this ball are in the shell,
// except in full cells. For ellipsoids of one own radius, the ball extends at least this own radius
// beyond the skin: gaps of two own radii can be inside a body, and the shell includes these gaps.
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
  this->Strength[k] =
    particle.Strength > LeastStrength ? static_cast<float>(particle.Strength) : 0.f;
  this->InverseReach2[k] = static_cast<float>(1.0 / (reach * reach));
}

// Lists the particles whose supports may touch a cube of nodes. size: side of the cube [voxels].
// before: number of column rows before each particle; null: each particle has a row.
const ParticleRuns& ParticleNodes::ListNear(const NodeIndex& origin, double size,
  const ParticleBlocks::Reaches& reaches, const std::uint32_t* before) const
{
  thread_local ParticleRuns runs;
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = origin[axis];
    high[axis] = origin[axis] + size;
  }
  runs.clear();
  this->Blocks.VisitRuns(low, high, reaches,
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
    this->ListNear(leaf.Origin, size, this->Fits.GetReaches(), this->Fits.GetRows()), leaf.Rows,
    values);
}

void ParticleNodes::FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const
{
  constexpr double size = 8.0;
  const bool hasBulks =
    this->Options.Model == ParticleModel::Anisotropic || this->Options.WantsBulks;
  const MotionColumns columns = { { this->X.data(), this->Y.data(), this->Z.data() },
    { this->DX.data(), this->DY.data(), this->DZ.data() }, this->IsMoved.data(),
    hasBulks ? this->Fits.GetBulks() : nullptr, this->InverseReach2.data() };
  FindMotionMeans(columns, this->ListNear(leaf.Origin, size, this->ReachesOfMotion),
    this->Options.HasNoise, motion);
}

}
