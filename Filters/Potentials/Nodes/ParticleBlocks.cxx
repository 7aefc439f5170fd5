#include "Nodes/ParticleBlocks.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

// Up to where kernels end, beyond the first own radius [own radii].
constexpr double BeyondDense = 3.6;

// Cells are no smaller than a share of a voxel.
constexpr double CellsOfVoxel = 4.0;

int NumberOf(const NodeIndex& offset)
{
  return 9 * (offset[0] + 1) + 3 * (offset[1] + 1) + offset[2] + 1;
}

}

void ParticleBlocks::Build(const UnsetVector<ParticleCube>& cubes, const Options& options)
{
  this->VoxelSize = options.VoxelSize;
  this->ChooseCells(cubes);
  this->AddBlocks(cubes);
  this->Sort();
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

// From a cell in the middle of a cube to a node beyond the skin [cells]. beyond: of the skin from
// the cube [length].
int ParticleBlocks::CountOutward(double beyond) const
{
  constexpr double rounding = 1e-6;
  const double outward = 0.5 * this->CellSize + beyond / this->VoxelSize + 1.0;
  return static_cast<int>(std::ceil(outward / this->CellSize - rounding));
}

void ParticleBlocks::ChooseCells(const UnsetVector<ParticleCube>& cubes)
{
  double least = HUGE_VAL, most = 0.0;
  for (const ParticleCube& cube : cubes)
  {
    least = std::min(least, cube.HalfSide);
    most = std::max(most, cube.HalfSide);
  }
  this->CellSize = cubes.empty()
    ? 1.0
    : std::max({ 2.0 * least / this->VoxelSize, 2.0 * most / this->VoxelSize / MostCellsOfCube,
        1.0 / CellsOfVoxel });
  this->OutwardOfDense = this->CountOutward(BeyondDense * most);
  this->Inward = this->CountOutward(0.0);
}

// The blocks of particles first of all, then those that a mask may reach.
void ParticleBlocks::AddBlocks(const UnsetVector<ParticleCube>& cubes)
{
  const std::size_t count = cubes.size();
  this->Homes.resize(count);
  this->PartOf.resize(count);
  this->Numbers.Clear(count / 64);
  this->Blocks.clear();
  this->Around.clear();
  const auto add = [this](const NodeIndex& at)
  {
    const std::int32_t i = this->Numbers.Add(at);
    if (static_cast<std::size_t>(i) == this->Blocks.size())
    {
      this->Blocks.emplace_back();
      this->Blocks.back().At = at;
      this->Around.push_back(0);
    }
    return static_cast<std::size_t>(i);
  };
  std::size_t home = 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    NodeIndex cell, at, low, high;
    const double rest = cubes[n].HalfSide / this->VoxelSize - 0.5 * this->CellSize;
    const double reach = std::max(rest, 0.0);
    const int margin = this->CountOutward(BeyondDense * cubes[n].HalfSide);
    const double shell = cubes[n].Shell / this->VoxelSize;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double place = cubes[n].Position[axis] / this->VoxelSize;
      cell[axis] = this->CellOf(place);
      at[axis] = cell[axis] >> 3;
      low[axis] = std::min(this->CellOf(place - reach) - margin, this->CellOf(place - shell)) >> 3;
      high[axis] = std::max(this->CellOf(place + reach) + margin, this->CellOf(place + shell)) >> 3;
    }
    home = this->Blocks.empty() || !AreSame(this->Blocks[home].At, at) ? add(at) : home;
    this->Homes[n] = static_cast<std::uint32_t>(home);
    this->PartOf[n] = static_cast<std::uint8_t>(
      16 * ((cell[0] & 7) >> 1) + 4 * ((cell[1] & 7) >> 1) + ((cell[2] & 7) >> 1));
    NodeIndex other;
    for (other[0] = low[0]; other[0] <= high[0]; ++other[0])
    {
      for (other[1] = low[1]; other[1] <= high[1]; ++other[1])
      {
        for (other[2] = low[2]; other[2] <= high[2]; ++other[2])
        {
          const NodeIndex offset = { other[0] - at[0], other[1] - at[1], other[2] - at[2] };
          const bool isNear =
            std::all_of(offset.begin(), offset.end(), [](int o) { return o >= -1 && o <= 1; });
          const std::uint32_t bit = isNear ? 1u << NumberOf(offset) : 0u;
          if (!bit || !(this->Around[home] & bit))
          {
            add(other);
            this->Around[home] |= bit;
          }
        }
      }
    }
  }
}

void ParticleBlocks::Sort()
{
  const std::size_t count = this->Homes.size();
  for (Block& block : this->Blocks)
  {
    std::fill_n(block.Starts, Parts + 1, 0u);
  }
  for (std::size_t n = 0; n < count; ++n)
  {
    ++this->Blocks[this->Homes[n]].Starts[this->PartOf[n] + 1];
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
    const std::uint32_t home = this->Homes[n];
    const std::uint32_t place = this->Blocks[home].Starts[this->PartOf[n]]++;
    this->Order[place] = static_cast<std::uint32_t>(n);
    this->BlockOf[place] = home;
  }
  for (Block& block : this->Blocks) // each start has become the next one
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

}
