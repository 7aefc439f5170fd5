#include "Nodes/ParticleBlocks.h"

#include "CompilerBuiltins.h"
#include "ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

// Filling by a cube of a cell's size.
constexpr std::uint32_t FillingOfCell = 256;
// A cell is full if the sum of 27 cells with the weights 1 2 1, 64 in all, is at least this.
constexpr std::uint32_t Full = FillingOfCell * 64 * 6 / 10;

// Limit of the filling of a cell: dense particles do not fill the cells next to theirs.
constexpr std::uint32_t MostFilling = FillingOfCell * 3 / 2;
// Where twice as many particles are as at rest their sum is large beyond their own radii: up to
// where the kernels end, so many own radii beyond the first. (S goes with the density and with the
// fifth power of the depth: below, the skin is off by less than .45 own radii.)
constexpr std::uint32_t Crowd = FillingOfCell * 2;
constexpr double BeyondCrowd = 3.6;

// Cells are no smaller than a share of the largest cube, so that each cube is in few cells; nor
// than a share of a voxel.
constexpr double MostCellsOfCube = 16.0;
constexpr double CellsOfVoxel = 4.0;

constexpr int BlocksPerTask = 8;

int NumberOf(const NodeIndex& offset)
{
  return 9 * (offset[0] + 1) + 3 * (offset[1] + 1) + offset[2] + 1;
}

}

void ParticleBlocks::Build(
  const UnsetVector<ParticleCube>& cubes, double voxelSize, double beyond, bool hasInside)
{
  this->VoxelSize = voxelSize;
  this->ChooseCells(cubes, beyond);
  this->AddBlocks(cubes);
  this->Sort();
  this->FillCells(cubes);
  if (hasInside)
  {
    this->FindOpen();
    this->Widen(&Block::Open, true, this->Inward);
  }
  this->Widen(&Block::Occupied, false, this->Outward);
  if (hasInside)
  {
    this->OccupyAroundCrowds();
  }
}

void ParticleBlocks::OccupyAroundCrowds()
{
  if (std::none_of(this->Blocks.begin(), this->Blocks.end(),
        [](const Block& block) { return block.Crowded.Any(); }))
  {
    return;
  }
  this->Widen(&Block::Crowded, false, this->OutwardOfCrowd);
  for (Block& block : this->Blocks)
  {
    for (int x = 0; x < 8; ++x)
    {
      block.Occupied.Word[x] |= block.Crowded.Word[x];
    }
  }
}

// To the surface, from the cells in the middle of a cube [cells].
int ParticleBlocks::CountOutward(double halfSide, double beyond) const
{
  // A node beyond the skin is in the shell.
  constexpr double rounding = 1e-6;
  const double outward = 0.5 * this->CellSize + beyond * halfSide / this->VoxelSize + 1.0;
  return static_cast<int>(std::ceil(outward / this->CellSize - rounding));
}

void ParticleBlocks::ChooseCells(const UnsetVector<ParticleCube>& cubes, double beyond)
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
  this->Outward = this->CountOutward(most, beyond);
  this->OutwardOfCrowd = this->CountOutward(most, std::max(beyond, BeyondCrowd));
  this->Inward = this->CountOutward(0.0, 0.0);
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
    const int margin = std::max(this->Outward, this->CountOutward(cubes[n].HalfSide, BeyondCrowd));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double place = cubes[n].Position[axis] / this->VoxelSize;
      cell[axis] = this->CellOf(place);
      at[axis] = cell[axis] >> 3;
      low[axis] = (this->CellOf(place - reach) - margin) >> 3;
      high[axis] = (this->CellOf(place + reach) + margin) >> 3;
    }
    home = this->Blocks.empty() || this->Blocks[home].At != at ? add(at) : home;
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

void ParticleBlocks::FillCells(const UnsetVector<ParticleCube>& cubes)
{
  this->Filling.assign(512 * this->Blocks.size(), 0);
  for (Block& block : this->Blocks)
  {
    block.Occupied = CellMask();
    block.Open = CellMask::All();
    block.Crowded = CellMask();
  }
  RunPieces(this->Order.size(), ParticlesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        this->FillCube(cubes[this->Order[k]], this->BlockOf[k]);
      }
    });
  for (std::size_t k = 0; k < this->Order.size(); ++k)
  {
    this->Occupy(cubes[this->Order[k]], this->BlockOf[k]);
  }
}

// Shares by the overlap of the cube and the cells.
void ParticleBlocks::FillCube(const ParticleCube& cube, std::size_t home)
{
  constexpr int most = static_cast<int>(MostCellsOfCube) + 3;
  std::uint32_t share[3][most];
  int first[3], last[3];
  const double half = std::max(cube.HalfSide / this->VoxelSize, 0.5 * this->CellSize);
  const double filling = cube.Filling *
    std::pow(std::min(cube.HalfSide / this->VoxelSize / (0.5 * this->CellSize), 1.0), 3.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = cube.Position[axis] / this->VoxelSize;
    first[axis] = this->CellOf(place - half);
    last[axis] = std::min(this->CellOf(place + half), first[axis] + most - 1);
    for (int c = first[axis]; c <= last[axis]; ++c)
    {
      const double from = std::max(place - half, c * this->CellSize);
      const double to = std::min(place + half, (c + 1.0) * this->CellSize);
      share[axis][c - first[axis]] =
        static_cast<std::uint32_t>(std::lround(16.0 * std::max(to - from, 0.0) / this->CellSize));
    }
  }
  const auto whole = static_cast<std::uint32_t>(FillingOfCell * filling);
  NodeIndex cell;
  for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0])
  {
    for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
    {
      const std::uint32_t across = share[0][cell[0] - first[0]] * share[1][cell[1] - first[1]];
      for (cell[2] = first[2]; across > 0 && cell[2] <= last[2]; ++cell[2])
      {
        const std::uint32_t part = across * share[2][cell[2] - first[2]];
        if (part > 0)
        {
          const int n = 64 * (cell[0] & 7) + CellMask::Bit(cell[1] & 7, cell[2] & 7);
          AddRelaxed(part * whole / 4096, &this->Filling[512 * this->FindBlock(cell, home) + n]);
        }
      }
    }
  }
}

// The cells in the middle of the cube.
void ParticleBlocks::Occupy(const ParticleCube& cube, std::size_t home)
{
  const double reach = std::max(cube.HalfSide / this->VoxelSize - 0.5 * this->CellSize, 0.0);
  int first[3], last[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = cube.Position[axis] / this->VoxelSize;
    first[axis] = this->CellOf(place - reach);
    last[axis] = this->CellOf(place + reach);
  }
  NodeIndex cell;
  for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0])
  {
    for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
    {
      for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2])
      {
        this->Blocks[this->FindBlock(cell, home)].Occupied.Add(
          cell[0] & 7, cell[1] & 7, cell[2] & 7);
      }
    }
  }
}

void ParticleBlocks::FindOpen()
{
  RunPieces(this->Blocks.size(), BlocksPerTask,
    [this](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        this->FindOpenOf(this->Blocks[i]);
      }
    });
}

void ParticleBlocks::FindOpenOf(Block& block) const
{
  const std::uint32_t* own =
    &this->Filling[512 * static_cast<std::size_t>(&block - this->Blocks.data())];
  for (int n = 0; n < 512; ++n)
  {
    if (own[n] >= Crowd)
    {
      block.Crowded.Word[n >> 6] |= std::uint64_t(1) << (n & 63);
    }
  }
  // Sums with the weights 1 2 1, axis by axis.
  std::uint32_t cells[10][10][10];
  for (int n = 0; n < 27; ++n)
  {
    const NodeIndex offset = { n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1 };
    const std::int32_t i = this->Numbers.Find(
      { block.At[0] + offset[0], block.At[1] + offset[1], block.At[2] + offset[2] });
    const std::uint32_t* from =
      i >= 0 ? &this->Filling[512 * static_cast<std::size_t>(i)] : nullptr;
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = offset[axis] < 0 ? 0 : offset[axis] > 0 ? 9 : 1;
      last[axis] = offset[axis] < 0 ? 0 : offset[axis] > 0 ? 9 : 8;
    }
    for (int x = first[0]; x <= last[0]; ++x)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int z = first[2]; z <= last[2]; ++z)
        {
          const int at = 64 * ((x + 7) & 7) + CellMask::Bit((y + 7) & 7, (z + 7) & 7);
          cells[x][y][z] = from ? std::min(from[at], MostFilling) : 0;
        }
      }
    }
  }
  std::uint32_t lines[10][10][8];
  for (int x = 0; x < 10; ++x)
  {
    for (int y = 0; y < 10; ++y)
    {
      for (int z = 0; z < 8; ++z)
      {
        lines[x][y][z] = cells[x][y][z] + 2 * cells[x][y][z + 1] + cells[x][y][z + 2];
      }
    }
  }
  for (int x = 0; x < 8; ++x)
  {
    for (int y = 0; y < 8; ++y)
    {
      for (int z = 0; z < 8; ++z)
      {
        std::uint32_t sum = 0;
        for (int i = 0; i < 3; ++i)
        {
          const auto* plane = lines[x + i];
          sum += (i == 1 ? 2u : 1u) * (plane[y][z] + 2 * plane[y + 1][z] + plane[y + 2][z]);
        }
        if (sum >= Full)
        {
          block.Open.Word[x] &= ~(std::uint64_t(1) << CellMask::Bit(y, z));
          block.Occupied.Add(x, y, z);
        }
      }
    }
  }
}

// Adds the cells around a mask, `times` times. outside: whether cells of missing blocks are in the
// mask.
void ParticleBlocks::Widen(CellMask Block::*mask, bool outside, int times)
{
  const CellMask other = outside ? CellMask::All() : CellMask();
  this->Wide.resize(this->Blocks.size());
  for (int pass = 0; pass < 3 * times; ++pass)
  {
    const int axis = pass % 3;
    RunPieces(this->Blocks.size(), BlocksPerTask,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          NodeIndex before = this->Blocks[i].At, after = before;
          --before[axis];
          ++after[axis];
          const Block *low = this->Find(before), *high = this->Find(after);
          this->Wide[i] = (this->Blocks[i].*mask)
                            .Widen(low ? low->*mask : other, high ? high->*mask : other, axis);
        }
      });
    for (std::size_t i = 0; i < this->Blocks.size(); ++i)
    {
      this->Blocks[i].*mask = this->Wide[i];
    }
  }
}

}
