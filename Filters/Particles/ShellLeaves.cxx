// Leaves that particles' surface may cross.

#include "ParticleNodes.h"

#include "Index/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr double SideOfLeaf = 8.0; // [voxels]

}

bool ParticleNodes::IsInside(const NodeIndex& node) const
{
  return this->Blocks.IsInside(
    { this->Blocks.CellOf(node[0]), this->Blocks.CellOf(node[1]), this->Blocks.CellOf(node[2]) });
}

// Calls visit(first, last) for boxes of leaves, in units of leaves, that together contain the shell
// and, with wantsInside, the full cells: a box around each block or, if cells are at least as wide
// as leaves, around each cell.
template <class Visit>
void ParticleNodes::VisitBoxes(bool wantsInside, Visit&& visit) const
{
  const double cell = this->Blocks.GetCellSize();
  const auto visitCells = [&](const NodeIndex& at, int count) // count: cells along each axis
  {
    std::array<double, 3> first, last;
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = std::floor(cell * at[axis] / SideOfLeaf);
      last[axis] = std::floor(cell * (at[axis] + count) / SideOfLeaf);
    }
    visit(first, last);
  };
  for (std::size_t i = 0; i < this->Blocks.Size(); ++i)
  {
    const ParticleBlocks::Block& block = this->Blocks[i];
    const NodeIndex corner = { 8 * block.At[0], 8 * block.At[1], 8 * block.At[2] };
    const CellMask wanted = ParticleBlocks::ShellOf(block, wantsInside);
    if (cell < SideOfLeaf)
    {
      if (wanted.Any())
      {
        visitCells(corner, 8);
      }
      continue;
    }
    wanted.ForEach(
      [&](int x, int y, int z) {
        visitCells({ corner[0] + x, corner[1] + y, corner[2] + z }, 1);
      });
  }
}

void ParticleNodes::CheckNumberOfLeaves(bool wantsInside) const
{
  constexpr double most = 1 << 24;
  double count = 0.0;
  this->VisitBoxes(wantsInside,
    [&](const std::array<double, 3>& first, const std::array<double, 3>& last)
    { count += (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1); });
  if (count > most)
  {
    std::ostringstream text;
    text << "The particles' kernels cover up to " << SideOfLeaf * SideOfLeaf * SideOfLeaf * count
         << " voxels, too many to search for the skin; enlarge VoxelSize, or reduce the radii, "
         << "ParticleSpacing or KernelRadius.";
    throw std::runtime_error(text.str());
  }
}

// Lists the leaves of VisitBoxes.
void ParticleNodes::ListLeaves(bool wantsInside, std::vector<NodeIndex>& origins) const
{
  this->CheckNumberOfLeaves(wantsInside);
  IndexMap found;
  this->VisitBoxes(wantsInside,
    [&](const std::array<double, 3>& first, const std::array<double, 3>& last)
    {
      const auto add = [&](const NodeIndex& leaf)
      {
        if (static_cast<std::size_t>(found.Add(leaf)) == origins.size())
        {
          origins.push_back({ 8 * leaf[0], 8 * leaf[1], 8 * leaf[2] });
        }
      };
      NodeIndex leaf;
      for (leaf[0] = static_cast<int>(first[0]); leaf[0] <= last[0]; ++leaf[0])
      {
        for (leaf[1] = static_cast<int>(first[1]); leaf[1] <= last[1]; ++leaf[1])
        {
          for (leaf[2] = static_cast<int>(first[2]); leaf[2] <= last[2]; ++leaf[2])
          {
            add(leaf);
          }
        }
      }
    });
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
    if (x > 0 && cells[0][x] == cells[0][x - 1])
    {
      constexpr std::uint64_t rowsOfPlane = 0xff;
      leaf.Rows |= leaf.Rows << 8 & rowsOfPlane << 8 * x;
      leaf.InsideRows |= leaf.InsideRows << 8 & rowsOfPlane << 8 * x;
      continue;
    }
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

}
