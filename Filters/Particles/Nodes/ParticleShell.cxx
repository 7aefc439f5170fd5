// Finds the cells that may contain the surface of particles.

#include "Nodes/ParticleBlocks.h"

#include "Base/CompilerBuiltins.h"
#include "Index/ParallelTasks.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// Filling of a cell by a cube of its size.
constexpr std::uint32_t FillingOfCell = 256;
// A cell is full if the filling of 3^3 cells, summed with the weights 1 2 1 along each axis (64 in
// all), is at least this.
constexpr std::uint32_t Full = FillingOfCell * 64 * 6 / 10;

// Limit of a cell's filling in this sum, so that dense particles do not make the neighbouring cells
// full.
constexpr std::uint32_t MostFilling = FillingOfCell * 3 / 2;
// At twice the density of the fluid or more, the skin may lie as far out as the ends of the
// supports. The sum of kernels grows with the density and with the fifth power of the depth below
// these ends. At lower densities the skin is displaced by less than 0.45 own radii.
constexpr std::uint32_t DenseFilling = FillingOfCell * 2;

constexpr int BlocksPerTask = 8;

}

void ParticleBlocks::OccupyAroundDense()
{
  if (std::none_of(this->Blocks.begin(), this->Blocks.end(),
        [](const Block& block) { return block.Dense.Any(); }))
  {
    return;
  }
  this->Widen(&Block::Dense, false, this->OutwardOfDense);
  for (Block& block : this->Blocks)
  {
    for (int x = 0; x < 8; ++x)
    {
      block.Occupied.Word[x] |= block.Dense.Word[x];
    }
  }
}

void ParticleBlocks::FillCells(const ParticleCubes& cubes)
{
  this->Filling.assign(512 * this->Blocks.size(), 0);
  for (Block& block : this->Blocks)
  {
    block.Occupied = CellMask();
    block.Open = CellMask::All();
    block.Dense = CellMask();
  }
  RunPieces(this->Order.size(), ParticlesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        this->FillCube(cubes.Get(this->Order[k]), this->BlockOf[k]);
      }
    });
}

// Distributes the filling by the overlap of the cube and the cells.
void ParticleBlocks::FillCube(const ParticleCube& cube, std::size_t own)
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
          AddRelaxed(part * whole / 4096, &this->Filling[512 * this->FindBlock(cell, own) + n]);
        }
      }
    }
  }
}

// Marks cells as occupied around particles whose kernels may touch cells that are not full.
void ParticleBlocks::OccupyCells(const ParticleCubes& cubes)
{
  RunPieces(this->Blocks.size(), BlocksPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Block& block = this->Blocks[i];
        for (int part = 0; part < Parts; ++part)
        {
          if (IsNearSurface(block, part >> 4, part >> 2 & 3, part & 3))
          {
            for (std::uint32_t k = block.Starts[part]; k < block.Starts[part + 1]; ++k)
            {
              this->Occupy(cubes.Get(this->Order[k]), i);
            }
          }
        }
      }
    });
}

void ParticleBlocks::Occupy(const ParticleCube& cube, std::size_t own)
{
  ShellBall ball;
  ball.Reach = cube.Shell / this->VoxelSize;
  for (int axis = 0; axis < 3; ++axis)
  {
    ball.Place[axis] = cube.Position[axis] / this->VoxelSize;
    ball.First[axis] = this->CellOf(ball.Place[axis] - ball.Reach);
    ball.Last[axis] = this->CellOf(ball.Place[axis] + ball.Reach);
  }
  NodeIndex at;
  for (at[0] = ball.First[0] >> 3; at[0] <= ball.Last[0] >> 3; ++at[0])
  {
    for (at[1] = ball.First[1] >> 3; at[1] <= ball.Last[1] >> 3; ++at[1])
    {
      for (at[2] = ball.First[2] >> 3; at[2] <= ball.Last[2] >> 3; ++at[2])
      {
        const NodeIndex cell = { 8 * at[0], 8 * at[1], 8 * at[2] };
        this->OccupyIn(this->Blocks[this->FindBlock(cell, own)], ball);
      }
    }
  }
}

// Marks the rows of cells that the ball touches as occupied; a row extends over the ball's box.
void ParticleBlocks::OccupyIn(Block& block, const ShellBall& ball) const
{
  int first[3], last[3];
  double square[2][8];
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = std::max(ball.First[axis] - 8 * block.At[axis], 0);
    last[axis] = std::min(ball.Last[axis] - 8 * block.At[axis], 7);
    for (int c = first[axis]; axis < 2 && c <= last[axis]; ++c)
    {
      const double low = this->CellSize * (8.0 * block.At[axis] + c) - ball.Place[axis];
      const double away = std::max({ low, -low - this->CellSize, 0.0 });
      square[axis][c] = away * away;
    }
  }
  const std::uint64_t row = (0xffull << first[2]) & (0xffull >> (7 - last[2]));
  for (int x = first[0]; x <= last[0]; ++x)
  {
    std::uint64_t cells = 0;
    for (int y = first[1]; y <= last[1]; ++y)
    {
      cells |= square[0][x] + square[1][y] < ball.Reach * ball.Reach ? row << (8 * y) : 0;
    }
    AddBitsRelaxed(cells, &block.Occupied.Word[x]);
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
    if (own[n] >= DenseFilling)
    {
      block.Dense.Word[n >> 6] |= std::uint64_t(1) << (n & 63);
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

// Dilates a mask `times` times. outside: true if cells of missing blocks count as cells of the
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
