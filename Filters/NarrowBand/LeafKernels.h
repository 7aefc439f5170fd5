/**
 * Passes over the leaves, compiled for each instruction set.
 */
#ifndef LeafKernels_h
#define LeafKernels_h

#include "InstructionSets.h"
#include "LeafTable.h"

namespace activesurface
{

template <class Kernel>
struct CompiledKernel
{
  static void Baseline(const Kernel& kernel, std::size_t leaf) { kernel(leaf); }
  ACTIVE_FOR_AVX2 static void Avx2(const Kernel& kernel, std::size_t leaf) { kernel(leaf); }
  ACTIVE_FOR_AVX512 static void Avx512(const Kernel& kernel, std::size_t leaf) { kernel(leaf); }
};

/** Calls kernel(i) for every leaf, in parallel, with the best instructions that the processor has.
 * Its operator() must be ACTIVE_ALWAYS_INLINE, and so must be what it calls. */
template <class Kernel>
void ForEachLeaf(const LeafTable& table, const Kernel& kernel)
{
  const InstructionSet set = GetInstructionSet();
  const auto run = set == InstructionSet::Avx512 ? CompiledKernel<Kernel>::Avx512
    : set == InstructionSet::Avx2                ? CompiledKernel<Kernel>::Avx2
                                                 : CompiledKernel<Kernel>::Baseline;
  table.ForEach([&kernel, run](std::size_t i) { run(kernel, i); });
}

}

#endif
