#include "Nodes/ParticleBlocks.h"

#include "Index/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

// Bound on the distance from the cube of a dense particle to the skin [own radii]: at the default
// support radius, 4.5, ball kernels end 3.5 from the cube.
constexpr double BeyondDense = 3.6;

// Cells are at least 1 / CellsOfVoxel of a voxel wide.
constexpr double CellsOfVoxel = 4.0;

int NumberOf(const NodeIndex& offset)
{
  return 9 * (offset[0] + 1) + 3 * (offset[1] + 1) + offset[2] + 1;
}

}

void ParticleBlocks::Build(const ParticleCubes& cubes, const Options& options)
{
  this->VoxelSize = options.VoxelSize;
  this->ChooseCells(cubes);
  this->AddBlocks(cubes);
  this->Sort();
  this->ListFilled();
  this->FillCells(cubes);
  if (options.HasInside)
  {
    this->FindOpen();
    this->Widen(&Block::Open, true, this->Inward);
  }
  this->FindNear(options.Reach);
  this->OccupyCells(cubes);
  if (options.HasInside)
  {
    this->OccupyAroundDense();
  }
}

void ParticleBlocks::FindNear(double reach)
{
  for (Block& block : this->Blocks)
  {
    block.Near = block.Open;
  }
  const double cells = reach / this->VoxelSize / this->CellSize;
  this->Widen(&Block::Near, true, static_cast<int>(std::ceil(cells)));
}

// Returns the distance in cells from the cell of a cube's centre to a node beyond the skin. beyond:
// distance from the cube to the skin [length].
int ParticleBlocks::CountOutward(double beyond) const
{
  constexpr double rounding = 1e-6;
  const double outward = 0.5 * this->CellSize + beyond / this->VoxelSize + 1.0;
  return static_cast<int>(std::ceil(outward / this->CellSize - rounding));
}

void ParticleBlocks::ChooseCells(const ParticleCubes& cubes)
{
  const std::size_t count = cubes.Size();
  const auto getHalfSide = [&cubes](std::size_t n) { return cubes.Get(n).HalfSide; };
  const double most = FindMost(count, 0.0, getHalfSide);
  const double least = -FindMost(count, -HUGE_VAL, [&](std::size_t n) { return -getHalfSide(n); });
  this->CellSize = count == 0
    ? 1.0
    : std::max({ 2.0 * least / this->VoxelSize, 2.0 * most / this->VoxelSize / MostCellsOfCube,
        1.0 / CellsOfVoxel });
  this->OutwardOfDense = this->CountOutward(BeyondDense * most);
  this->Inward = this->CountOutward(0.0);
}

// Finds the block of a particle, and a range of blocks around it. The range contains the cells of
// the particle, enlarged by a margin, and the ball of radius Shell.
ParticleBlocks::CubePlace ParticleBlocks::FindPlace(const ParticleCube& cube) const
{
  CubePlace found;
  const double rest = cube.HalfSide / this->VoxelSize - 0.5 * this->CellSize;
  const double reach = std::max(rest, 0.0), shell = cube.Shell / this->VoxelSize;
  const int margin = this->CountOutward(BeyondDense * cube.HalfSide);
  int part[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = cube.Position[axis] / this->VoxelSize;
    const int cell = this->CellOf(place);
    found.At[axis] = cell >> 3;
    part[axis] = (cell & 7) >> 1;
    found.Low[axis] =
      std::min(this->CellOf(place - reach) - margin, this->CellOf(place - shell)) >> 3;
    found.High[axis] =
      std::max(this->CellOf(place + reach) + margin, this->CellOf(place + shell)) >> 3;
  }
  found.Part = static_cast<std::uint8_t>(16 * part[0] + 4 * part[1] + part[2]);
  return found;
}

std::size_t ParticleBlocks::AddBlock(const NodeIndex& at)
{
  const auto i = static_cast<std::size_t>(this->Numbers.Add(at));
  if (i == this->Blocks.size())
  {
    this->Blocks.emplace_back();
    this->Blocks.back().At = at;
    this->Around.push_back(0);
  }
  return i;
}

void ParticleBlocks::AddAround(const CubePlace& place, std::size_t own)
{
  NodeIndex other;
  for (other[0] = place.Low[0]; other[0] <= place.High[0]; ++other[0])
  {
    for (other[1] = place.Low[1]; other[1] <= place.High[1]; ++other[1])
    {
      for (other[2] = place.Low[2]; other[2] <= place.High[2]; ++other[2])
      {
        const NodeIndex offset = { other[0] - place.At[0], other[1] - place.At[1],
          other[2] - place.At[2] };
        const bool isNear =
          std::all_of(offset.begin(), offset.end(), [](int o) { return o >= -1 && o <= 1; });
        const std::uint32_t bit = isNear ? 1u << NumberOf(offset) : 0u;
        if (!bit || !(this->Around[own] & bit))
        {
          this->AddBlock(other);
          this->Around[own] |= bit;
        }
      }
    }
  }
}

// Finds the blocks of particles in parallel, batch by batch. Adds these blocks in the order of the
// particles.
void ParticleBlocks::AddBlocks(const ParticleCubes& cubes)
{
  constexpr std::size_t most = std::size_t(1) << 15;
  const std::size_t count = cubes.Size();
  this->OwnBlocks.resize(count);
  this->PartOf.resize(count);
  this->Numbers.Clear(count / 64);
  this->Blocks.clear();
  this->Around.clear();
  this->Places.resize(std::min(count, most));
  std::size_t own = 0;
  for (std::size_t first = 0; first < count; first += most)
  {
    const std::size_t some = std::min(most, count - first);
    RunEach(some, [&](std::size_t i) { this->Places[i] = this->FindPlace(cubes.Get(first + i)); });
    for (std::size_t i = 0; i < some; ++i)
    {
      const CubePlace& place = this->Places[i];
      const bool isSame = !this->Blocks.empty() && AreSame(this->Blocks[own].At, place.At);
      own = isSame ? own : this->AddBlock(place.At);
      this->OwnBlocks[first + i] = static_cast<std::uint32_t>(own);
      this->PartOf[first + i] = place.Part;
      this->AddAround(place, own);
    }
  }
}

void ParticleBlocks::Sort()
{
  const std::size_t count = this->OwnBlocks.size();
  for (Block& block : this->Blocks)
  {
    std::fill_n(block.Starts, Parts + 1, 0u);
  }
  for (std::size_t n = 0; n < count; ++n)
  {
    ++this->Blocks[this->OwnBlocks[n]].Starts[this->PartOf[n] + 1];
  }
  std::uint32_t first = 0;
  for (Block& block : this->Blocks)
  {
    block.Starts[0] = first;
    std::partial_sum(block.Starts, block.Starts + Parts + 1, block.Starts);
    first = block.Starts[Parts];
  }
  this->Order.resize(count);
  this->BlockOf.resize(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    const std::uint32_t own = this->OwnBlocks[n];
    const std::uint32_t place = this->Blocks[own].Starts[this->PartOf[n]]++;
    this->Order[place] = static_cast<std::uint32_t>(n);
    this->BlockOf[place] = own;
  }
  for (Block& block : this->Blocks) // each start now is that of the next part
  {
    std::copy_backward(block.Starts, block.Starts + Parts, block.Starts + Parts + 1);
  }
  first = 0;
  for (Block& block : this->Blocks)
  {
    block.Starts[0] = first;
    first = block.Starts[Parts];
  }
}

void ParticleBlocks::ListFilled()
{
  this->Filled.clear();
  for (std::uint32_t i = 0; i < this->Blocks.size(); ++i)
  {
    if (HasParticles(this->Blocks[i]))
    {
      this->Filled.push_back(i);
    }
  }
  std::sort(this->Filled.begin(), this->Filled.end(),
    [this](std::uint32_t a, std::uint32_t b) { return this->Blocks[a].At < this->Blocks[b].At; });
}

}
