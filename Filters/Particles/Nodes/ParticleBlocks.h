// Particles sorted by blocks of 8^3 cells; and the shell, the cells that may contain the particles'
// surface.
//
// A cell is at least twice as wide as the smallest own radius. Each particle fills a cube whose
// side is twice the own radius. Cells far from any particle and, with HasInside, cells with a full
// neighbourhood contain no surface. The remaining cells are the shell. The filling is an integer
// sum, independent of the order of particles.

#ifndef ParticleBlocks_h
#define ParticleBlocks_h

#include "Base/IndexMap.h"
#include "Index/ParallelTasks.h"
#include "Index/UnsetVector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// Bits of the 8^3 cells of a block: cell (x, y, z) is bit 8 y + z of word x.
struct CellMask
{
  std::array<std::uint64_t, 8> Word{};

  static CellMask All()
  {
    CellMask all;
    all.Word.fill(~std::uint64_t(0));
    return all;
  }

  static constexpr int Bit(int y, int z) { return 8 * y + z; }
  bool Has(int x, int y, int z) const { return ((this->Word[x] >> Bit(y, z)) & 1) != 0; }
  void Add(int x, int y, int z) { this->Word[x] |= std::uint64_t(1) << Bit(y, z); }
  // Returns the eight cells along z.
  unsigned Row(int x, int y) const { return (this->Word[x] >> (8 * y)) & 0xffu; }

  bool Any() const
  {
    std::uint64_t any = 0;
    for (const std::uint64_t word : this->Word)
    {
      any |= word;
    }
    return any != 0;
  }

  // Calls visit(x, y, z) for each cell of the mask.
  template <class Visit>
  void ForEach(Visit&& visit) const
  {
    for (int n = 0; n < 512; ++n)
    {
      if (this->Has(n / 64, n / 8 % 8, n % 8))
      {
        visit(n / 64, n / 8 % 8, n % 8);
      }
    }
  }

  // Dilates this mask by one cell in both directions of an axis. before, after: the masks of the
  // adjacent blocks on this axis.
  CellMask Widen(const CellMask& before, const CellMask& after, int axis) const
  {
    CellMask wide;
    for (int x = 0; x < 8; ++x)
    {
      const std::uint64_t own = this->Word[x], low = before.Word[x], high = after.Word[x];
      if (axis == 0)
      {
        wide.Word[x] = own | (x > 0 ? this->Word[x - 1] : before.Word[7]) |
          (x < 7 ? this->Word[x + 1] : after.Word[0]);
      }
      else if (axis == 1)
      {
        wide.Word[x] = own | own << 8 | low >> 56 | own >> 8 | high << 56;
      }
      else
      {
        constexpr std::uint64_t first = 0x0101010101010101ull, last = first << 7;
        wide.Word[x] =
          own | (own << 1 & ~first) | (low >> 7 & first) | (own >> 1 & ~last) | (high << 7 & last);
      }
    }
    return wide;
  }
};

// A particle as a cube of fluid.
struct ParticleCube
{
  double Position[3];
  double HalfSide; // own radius
  double Shell;    // radius of the ball that the shell contains, except full cells [length]
  double Filling;  // in [0,1]: 1 at full strength
};

// Particles, read one by one, repeatedly and by several threads at once.
class ParticleCubes
{
public:
  virtual std::size_t Size() const = 0;
  virtual ParticleCube Get(std::size_t n) const = 0;

protected:
  ~ParticleCubes() = default;
};

class ParticleBlocks
{
public:
  // Particles are sorted by parts of a block, of 2^3 cells each.
  static constexpr int PartsOfSide = 4;
  static constexpr int Parts = PartsOfSide * PartsOfSide * PartsOfSide;
  // The largest cube is at most this number of cells wide.
  static constexpr double MostCellsOfCube = 16.0;

  struct Block
  {
    NodeIndex At; // in units of blocks
    std::uint32_t Starts[Parts + 1];
    CellMask Occupied;
    CellMask Open;  // not full
    CellMask Dense; // at twice the density of the fluid or more
    CellMask Near;  // kernels from here may touch cells that are not full
  };

  // Bounds on the distance, along each axis, from a block's particles to the ends of their supports
  // [voxels].
  struct Reaches
  {
    std::vector<double> OfBlock;
    double Longest = 0.0;
  };

  struct Options
  {
    double VoxelSize = 1.0;
    double Reach = 0.0;    // longest half-axis of the kernels [length]
    bool HasInside = true; // full cells are inside, whatever the kernels
  };

  // Reuses allocated memory.
  void Build(const ParticleCubes& cubes, const Options& options);

  std::size_t Size() const { return this->Blocks.size(); }
  const Block& operator[](std::size_t i) const { return this->Blocks[i]; }
  const Block* Find(const NodeIndex& at) const
  {
    const std::int32_t i = this->Numbers.Find(at);
    return i >= 0 ? &this->Blocks[i] : nullptr;
  }

  // Side of a cell [voxels].
  double GetCellSize() const { return this->CellSize; }
  double GetBlockSize() const { return 8.0 * this->CellSize; }

  // Indices of the particles, sorted by block and part.
  const UnsetVector<std::uint32_t>& GetOrder() const { return this->Order; }
  // The block of each particle, in the order of GetOrder.
  const UnsetVector<std::uint32_t>& GetBlockOf() const { return this->BlockOf; }

  // Returns the cell of a coordinate [voxels].
  int CellOf(double place) const
  {
    constexpr double farthest = 1e9;
    const double cell = std::floor(place / this->CellSize);
    return static_cast<int>(std::min(std::max(cell, -farthest), farthest));
  }

  // Returns the cells that may contain the surface and, with hasInside, the full cells.
  static CellMask ShellOf(const Block& block, bool hasInside = false)
  {
    CellMask shell;
    for (int x = 0; x < 8; ++x)
    {
      const std::uint64_t full = hasInside ? ~block.Open.Word[x] : 0;
      shell.Word[x] = (block.Occupied.Word[x] & block.Open.Word[x]) | full;
    }
    return shell;
  }
  // Returns true if kernels of particles in a part may touch cells that are not full.
  static bool IsNearSurface(const Block& block, int x, int y, int z)
  {
    constexpr std::uint64_t part = 0x0303;
    return (((block.Near.Word[2 * x] | block.Near.Word[2 * x + 1]) >> CellMask::Bit(2 * y, 2 * z)) &
             part) != 0;
  }
  bool IsInside(const NodeIndex& cell) const
  {
    const Block* block = this->Find({ cell[0] >> 3, cell[1] >> 3, cell[2] >> 3 });
    return block && !block->Open.Has(cell[0] & 7, cell[1] & 7, cell[2] & 7);
  }

  // reachOf(k): bound of a particle, in the order of GetOrder. Reuses allocated memory.
  template <class ReachOf>
  void FindReaches(ReachOf&& reachOf, Reaches& reaches) const
  {
    constexpr std::size_t blocksPerTask = 16;
    reaches.OfBlock.resize(this->Blocks.size());
    RunPieces(this->Blocks.size(), blocksPerTask,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          double longest = 0.0;
          for (std::uint32_t k = this->Blocks[i].Starts[0]; k < this->Blocks[i].Starts[Parts]; ++k)
          {
            longest = std::max(longest, static_cast<double>(reachOf(k)));
          }
          reaches.OfBlock[i] = longest;
        }
      });
    reaches.Longest = FindMost(
      reaches.OfBlock.size(), 0.0, [&reaches](std::size_t i) { return reaches.OfBlock[i]; });
  }

  // Calls visit(first, end, block) for runs of particles whose supports may touch a box [voxels].
  // block: At of the run's block.
  template <class Visit>
  void VisitRuns(
    const double (&low)[3], const double (&high)[3], const Reaches& reaches, Visit&& visit) const
  {
    const PartRange longest = this->FindParts(low, high, reaches.Longest);
    this->VisitFilled(longest,
      [&](std::size_t i)
      {
        // A range of its own costs more than it saves unless the reach is much shorter.
        const bool isShort = 2.0 * reaches.OfBlock[i] < reaches.Longest;
        const double rounding = 1e-3 * this->CellSize;
        VisitRunsOf(this->Blocks[i],
          isShort ? this->FindParts(low, high, reaches.OfBlock[i] + rounding) : longest, visit);
      });
  }

private:
  struct PartRange
  {
    int First[3], Last[3];
  };
  // Returns the parts of a box enlarged by `reach` [voxels].
  PartRange FindParts(const double (&low)[3], const double (&high)[3], double reach) const
  {
    PartRange range;
    for (int axis = 0; axis < 3; ++axis)
    {
      range.First[axis] = this->CellOf(low[axis] - reach) >> 1;
      range.Last[axis] = this->CellOf(high[axis] + reach) >> 1;
    }
    return range;
  }

  // Calls visit(index) for the blocks with particles in a range, in the order of x, y, z. Goes over
  // the range, or over all these blocks if they are fewer.
  template <class Visit>
  void VisitFilled(const PartRange& range, Visit&& visit) const
  {
    NodeIndex low, high;
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = range.First[axis] >> 2;
      high[axis] = range.Last[axis] >> 2;
      count *= 1.0 + high[axis] - low[axis];
    }
    if (count > static_cast<double>(this->Filled.size()))
    {
      for (const std::uint32_t i : this->Filled)
      {
        if (IsBetween(this->Blocks[i].At, low, high))
        {
          visit(i);
        }
      }
      return;
    }
    NodeIndex at;
    for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
    {
      for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
      {
        for (at[2] = low[2]; at[2] <= high[2]; ++at[2])
        {
          const std::int32_t i = this->Numbers.Find(at);
          if (i >= 0 && HasParticles(this->Blocks[i]))
          {
            visit(static_cast<std::size_t>(i));
          }
        }
      }
    }
  }
  static bool HasParticles(const Block& block) { return block.Starts[0] != block.Starts[Parts]; }
  static bool IsBetween(const NodeIndex& at, const NodeIndex& low, const NodeIndex& high)
  {
    return at[0] >= low[0] && at[0] <= high[0] && at[1] >= low[1] && at[1] <= high[1] &&
      at[2] >= low[2] && at[2] <= high[2];
  }

  template <class Visit>
  static void VisitRunsOf(const Block& block, const PartRange& range, Visit&& visit)
  {
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::max(range.First[axis] - PartsOfSide * block.At[axis], 0);
      high[axis] = std::min(range.Last[axis] - PartsOfSide * block.At[axis], PartsOfSide - 1);
    }
    for (int x = low[0]; x <= high[0]; ++x)
    {
      for (int y = low[1]; y <= high[1]; ++y)
      {
        const std::uint32_t* starts = block.Starts + PartsOfSide * (PartsOfSide * x + y);
        if (low[2] <= high[2] && starts[low[2]] != starts[high[2] + 1])
        {
          visit(starts[low[2]], starts[high[2] + 1], block.At);
        }
      }
    }
  }
  int CountOutward(double beyond) const;
  void FindNear(double reach);
  void OccupyAroundDense();
  void ChooseCells(const ParticleCubes& cubes);
  struct CubePlace
  {
    NodeIndex At, Low, High; // block of the particle, and range of blocks around it
    std::uint8_t Part;
  };
  CubePlace FindPlace(const ParticleCube& cube) const;
  std::size_t AddBlock(const NodeIndex& at);
  void AddAround(const CubePlace& place, std::size_t own);
  void AddBlocks(const ParticleCubes& cubes);
  void Sort();
  void ListFilled();
  void FillCells(const ParticleCubes& cubes);
  void FillCube(const ParticleCube& cube, std::size_t own);
  void OccupyCells(const ParticleCubes& cubes);
  void Occupy(const ParticleCube& cube, std::size_t own);
  struct ShellBall
  {
    double Place[3], Reach; // [voxels]
    int First[3], Last[3];  // range of the cells of its box
  };
  void OccupyIn(Block& block, const ShellBall& ball) const;
  // Returns the block of a cell, often the particle's own block.
  std::size_t FindBlock(const NodeIndex& cell, std::size_t own) const
  {
    const NodeIndex at = { cell[0] >> 3, cell[1] >> 3, cell[2] >> 3 };
    return AreSame(this->Blocks[own].At, at) ? own
                                             : static_cast<std::size_t>(this->Numbers.Find(at));
  }
  void FindOpen();
  void FindOpenOf(Block& block) const;
  void Widen(CellMask Block::*mask, bool outside, int times);

  double VoxelSize = 1.0;
  double CellSize = 1.0;
  int OutwardOfDense = 1; // from a dense cell to a node beyond the skin [cells]
  int Inward = 1;
  IndexMap Numbers;
  std::vector<Block> Blocks;
  std::vector<std::uint32_t> Filled; // blocks with particles, in the order of x, y, z
  std::vector<std::uint32_t> Around; // per block, a bit for each of the 27 around: known to exist
  UnsetVector<CubePlace> Places;     // of one batch of particles
  UnsetVector<std::uint32_t> OwnBlocks;
  UnsetVector<std::uint8_t> PartOf;
  UnsetVector<std::uint32_t> Order, BlockOf;
  std::vector<std::uint32_t> Filling; // 512 per block
  std::vector<CellMask> Wide;
};

}

#endif
