/**
 * Passes over the leaves, compiled for each instruction set.
 */
#ifndef LeafKernels_h
#define LeafKernels_h

#include "InstructionSets.h"
#include "LeafTable.h"

namespace activesurface
{

/** Calls kernel(i) for every leaf, in parallel, with the best instructions that the processor has;
 * see CompiledKernel. */
template <class Kernel>
void ForEachLeaf(const LeafTable& table, const Kernel& kernel)
{
  const auto run = CompiledKernel<Kernel, std::size_t>::GetBest();
  table.ForEach([&kernel, run](std::size_t i) { run(kernel, i); });
}

}

#endif
