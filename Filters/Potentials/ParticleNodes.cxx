#include "ParticleNodes.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Kernel radius of the means of motion and bulk, in own radii.
constexpr double ReachOfMotion = 4.5;
// From a particle to its skin, in own radii beyond the first: of ellipsoids in a body, and of the
// averaged centre.
constexpr double BeyondOwnRadius = 0.1;
// A displacement longer than this is none [voxels].
constexpr double LongestDisplacement = 1e6;

constexpr std::size_t Padding = 8;

void CheckPlace(double place)
{
  constexpr double farthest = 1e9; // as node numbers are 32-bit integers
  if (!(std::fabs(place) < farthest))
  {
    throw std::runtime_error("A particle is more than 10^9 voxels from the first ones, which no "
                             "lattice can hold; enlarge VoxelSize, or leave the particle out.");
  }
}

}

double ParticleNodes::GetOwnRadius(const SkeletonVertex& particle) const
{
  return this->Options.OwnRadius > 0.0
    ? this->Options.OwnRadius
    : particle.Radius / (2.0 * GetReachPerSpacing(this->Options.Model));
}

void ParticleNodes::Build(const NodeParticles& given, const NodeParticleOptions& options)
{
  this->Options = options;
  this->MakeCubes(given);
  // A sum may have any level: its skin is anywhere within the kernels.
  const bool isSum = options.Model == ParticleModel::Sum;
  double beyond = BeyondOwnRadius;
  for (std::size_t n = 0; isSum && n < this->Cubes.size(); ++n)
  {
    beyond = std::max(beyond, given.Particles[n].Radius / this->Cubes[n].HalfSide - 1.0);
  }
  this->Blocks.Build(this->Cubes, options.VoxelSize, beyond, !isSum);
  const std::size_t count = given.Particles.size();
  this->Resize(count);
  RunPieces(count, ParticlesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        this->Place(given, k);
      }
    });
  this->MostReach = this->MostReachOfMotion = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const double reach = std::sqrt(this->EReach2[k]);
    const double far = std::max({ std::fabs(this->EX[k] - this->X[k]),
      std::fabs(this->EY[k] - this->Y[k]), std::fabs(this->EZ[k] - this->Z[k]) });
    this->MostReach = std::max(this->MostReach, reach + far);
    this->MostReachOfMotion =
      std::max(this->MostReachOfMotion, 1.0 / std::sqrt(double(this->InverseReach2[k])));
  }
}

void ParticleNodes::MakeCubes(const NodeParticles& given)
{
  const std::vector<SkeletonVertex>& particles = given.Particles;
  this->Cubes.resize(particles.size());
  RunEach(particles.size(),
    [&](std::size_t n)
    {
      const SkeletonVertex& particle = particles[n];
      ParticleCube& cube = this->Cubes[n];
      for (int axis = 0; axis < 3; ++axis)
      {
        CheckPlace(particle.Position[axis] / this->Options.VoxelSize);
        cube.Position[axis] = particle.Position[axis];
      }
      cube.HalfSide = this->GetOwnRadius(particle);
      cube.Filling = std::min(std::max(particle.Strength, 0.0), 1.0);
    });
}

void ParticleNodes::Resize(std::size_t count)
{
  for (UnsetVector<float>* numbers :
    { &this->X, &this->Y, &this->Z, &this->DX, &this->DY, &this->DZ, &this->IsMoved, &this->Bulk,
      &this->InverseReach2, &this->EX, &this->EY, &this->EZ, &this->EReach2 })
  {
    numbers->resize(count + Padding);
    std::fill_n(numbers->data() + count, Padding, 0.f);
  }
  this->Ellipsoids.resize(count);
}

void ParticleNodes::Place(const NodeParticles& given, std::size_t k)
{
  const std::size_t n = this->Blocks.GetOrder()[k];
  const SkeletonVertex& particle = given.Particles[n];
  const ParticleBlocks::Block& block = this->Blocks[this->Blocks.GetBlockOf()[k]];
  float* const places[3] = { &this->X[k], &this->Y[k], &this->Z[k] };
  float* const displacements[3] = { &this->DX[k], &this->DY[k], &this->DZ[k] };
  bool isKnown = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    *places[axis] = static_cast<float>(particle.Position[axis] / this->Options.VoxelSize -
      this->Blocks.GetBlockSize() * block.At[axis]);
    const double way = given.Velocities.empty()
      ? 0.0
      : given.Velocities[3 * n + axis] * this->Options.Duration / this->Options.VoxelSize;
    isKnown = isKnown && std::fabs(way) < LongestDisplacement;
    *displacements[axis] = static_cast<float>(way);
  }
  if (!isKnown)
  {
    *displacements[0] = *displacements[1] = *displacements[2] = 0.f;
  }
  this->IsMoved[k] = isKnown ? 1.f : 0.f;
  this->Bulk[k] = given.Fits.empty() ? 1.f : static_cast<float>(given.Fits[n].Bulk);
  const double reach = ReachOfMotion * this->GetOwnRadius(particle) / this->Options.VoxelSize;
  this->InverseReach2[k] = static_cast<float>(1.0 / (reach * reach));
  this->EX[k] = *places[0];
  this->EY[k] = *places[1];
  this->EZ[k] = *places[2];
  this->EReach2[k] = 0.f;
  if (this->Options.Model == ParticleModel::Anisotropic && particle.Strength > 0.0)
  {
    this->PlaceEllipsoid(particle, given.Fits[n], k);
  }
}

void ParticleNodes::PlaceEllipsoid(
  const SkeletonVertex& particle, const ParticleFit& fit, std::size_t k)
{
  const double voxel = this->Options.VoxelSize;
  this->EX[k] += static_cast<float>(fit.Offset[0] / voxel);
  this->EY[k] += static_cast<float>(fit.Offset[1] / voxel);
  this->EZ[k] += static_cast<float>(fit.Offset[2] / voxel);
  const double reach = fit.Reach / voxel;
  this->EReach2[k] = static_cast<float>(reach * reach);
  NodeEllipsoid& ellipsoid = this->Ellipsoids[k];
  double m[6];
  for (int i = 0; i < 6; ++i)
  {
    m[i] = fit.Metric[i] * voxel * voxel;
    ellipsoid.Metric[i] = static_cast<float>(m[i]);
  }
  ellipsoid.Strength = static_cast<float>(particle.Strength * fit.Strength / this->Options.Level);
  // The diagonal of the inverse.
  const double minors[3] = { m[3] * m[5] - m[4] * m[4], m[0] * m[5] - m[2] * m[2],
    m[0] * m[3] - m[1] * m[1] };
  const double determinant =
    m[0] * minors[0] - m[1] * (m[1] * m[5] - m[4] * m[2]) + m[2] * (m[1] * m[4] - m[3] * m[2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double square = minors[axis] / determinant;
    ellipsoid.Extent[axis] =
      static_cast<float>(square >= 0.0 && square < reach * reach ? std::sqrt(square) : reach);
  }
}

bool ParticleNodes::IsInside(const NodeIndex& node) const
{
  return this->Blocks.IsInside(
    { this->Blocks.CellOf(node[0]), this->Blocks.CellOf(node[1]), this->Blocks.CellOf(node[2]) });
}

// Lists the leaves that overlap a block with a part of the shell.
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

// Calls visit(first, end, shift) for runs of particles that may be within the reach of a box of so
// many nodes; shift: from the origin of their block to that of the box.
template <class Visit>
void ParticleNodes::VisitRuns(
  const NodeIndex& origin, double size, double reach, Visit&& visit) const
{
  int first[3], last[3]; // parts: two cells each
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = this->Blocks.CellOf(origin[axis] - reach) >> 1;
    last[axis] = this->Blocks.CellOf(origin[axis] + size + reach) >> 1;
  }
  NodeIndex at;
  for (at[0] = first[0] >> 2; at[0] <= last[0] >> 2; ++at[0])
  {
    for (at[1] = first[1] >> 2; at[1] <= last[1] >> 2; ++at[1])
    {
      for (at[2] = first[2] >> 2; at[2] <= last[2] >> 2; ++at[2])
      {
        const ParticleBlocks::Block* block = this->Blocks.Find(at);
        if (!block || block->Starts[0] == block->Starts[ParticleBlocks::Parts])
        {
          continue;
        }
        float shift[3];
        int low[3], high[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          shift[axis] = static_cast<float>(this->Blocks.GetBlockSize() * at[axis] - origin[axis]);
          low[axis] = std::max(first[axis] - 4 * at[axis], 0);
          high[axis] = std::min(last[axis] - 4 * at[axis], 3);
        }
        for (int x = low[0]; x <= high[0]; ++x)
        {
          for (int y = low[1]; y <= high[1]; ++y)
          {
            const std::uint32_t* starts = block->Starts + 16 * x + 4 * y;
            if (starts[low[2]] != starts[high[2] + 1])
            {
              visit(starts[low[2]], starts[high[2] + 1], shift);
            }
          }
        }
      }
    }
  }
}

void ParticleNodes::EvaluateLeaf(const ShellLeaf& leaf, float* values) const
{
  EllipsoidSum sum(leaf.Rows, values);
  constexpr double size = 7.0;
  this->VisitRuns(leaf.Origin, size, this->MostReach,
    [&](std::uint32_t first, std::uint32_t end, const float(&shift)[3])
    {
      sum.Add({ this->EX.data(), this->EY.data(), this->EZ.data(), this->EReach2.data() },
        this->Ellipsoids.data(), first, end, shift);
    });
  sum.Finish();
}

void ParticleNodes::FindMotion(const ShellLeaf& leaf, LeafMotion& motion) const
{
  thread_local MotionSum sum;
  sum.Clear();
  constexpr double size = 8.0;
  this->VisitRuns(leaf.Origin, size, this->MostReachOfMotion,
    [&](std::uint32_t first, std::uint32_t end, const float(&shift)[3])
    {
      sum.Add({ { this->X.data(), this->Y.data(), this->Z.data() },
                { this->DX.data(), this->DY.data(), this->DZ.data() }, this->IsMoved.data(),
                this->Bulk.data(), this->InverseReach2.data() },
        first, end, shift);
    });
  sum.Finish(this->Options.HasNoise, motion);
}

}
