// Rows of columns that only the particles near a surface have, in the order of the blocks.

#ifndef NearRows_h
#define NearRows_h

#include "Index/ParallelTasks.h"
#include "Index/UnsetVector.h"
#include "Nodes/ParticleBlocks.h"

#include <cstddef>
#include <cstdint>

namespace activesurface
{

class NearRows
{
public:
  // Keeps its memory.
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

  // The row of a particle near a surface; of others that of the next one.
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

}

#endif
