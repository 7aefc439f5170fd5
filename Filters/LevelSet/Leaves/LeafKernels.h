/**
 * Passes over the leaves, compiled for each instruction set.
 */
#ifndef LeafKernels_h
#define LeafKernels_h

#include "Base/InstructionSets.h"
#include "Leaves/LeafTable.h"

namespace activesurface
{

/**
 * Prefetches the 512 numbers of the next leaf. Processors do not predict these reads: rows are read
 * out of order, and the buffers of leaves are allocated separately.
 */
ACTIVE_ALWAYS_INLINE void FetchAhead(const float* numbers)
{
  constexpr int inALine = 16;
  for (int k = 0; k < 512; k += inALine)
  {
    Prefetch(numbers + k);
  }
}

/** Calls kernel(i) for every leaf, in parallel, compiled for the chosen instruction set; see
 * CompiledKernel. */
template <class Kernel>
void ForEachLeaf(const LeafTable& table, const Kernel& kernel)
{
  const auto run = CompiledKernel<Kernel, std::size_t>::GetBest();
  table.ForEach([&kernel, run](std::size_t i) { run(kernel, i); });
}

/** Calls kernel(i) for the leaves of a list, in parallel. */
template <class Kernel>
void ForEachLeaf(const LeafTable& table, const LeafList& leaves, const Kernel& kernel)
{
  const auto run = CompiledKernel<Kernel, std::size_t>::GetBest();
  table.ForEach(leaves, [&kernel, run](std::size_t i) { run(kernel, i); });
}

/** Calls kernel(i) for the leaves of a list, in this thread and in the list's order. */
template <class Kernel>
void ForEachLeafInTurn(const LeafList& leaves, const Kernel& kernel)
{
  const auto run = CompiledKernel<Kernel, std::size_t>::GetBest();
  for (const std::int32_t i : leaves)
  {
    run(kernel, static_cast<std::size_t>(i));
  }
}

}

#endif
