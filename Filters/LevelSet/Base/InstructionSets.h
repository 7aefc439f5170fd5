/**
 * Instruction sets for which kernels are compiled, and the choice among them.
 *
 * At its first use the library chooses the best set of the processor, or the set named by the
 * environment variable ACTIVE_INSTRUCTION_SET: sse2, avx2 or avx512. A set that the processor does
 * not support is replaced by the best set below it. Results do not depend on the choice: the
 * compiler may neither reorder sums nor contract to fused multiply-add.
 */
#ifndef InstructionSets_h
#define InstructionSets_h

#include "ActiveLevelSetExport.h"
#include "Base/CompilerBuiltins.h"

namespace activesurface
{

enum class InstructionSet
{
  Baseline, //< SSE2 on x86-64
  Avx2,
  Avx512
};

/** Returns the set with which kernels run. */
ACTIVELEVELSET_EXPORT InstructionSet GetInstructionSet();

/** Chooses `wanted`, or the best set below `wanted` that the processor supports. Returns the
 * choice, which applies to the whole program. Must not be called while kernels run. */
ACTIVELEVELSET_EXPORT InstructionSet SetInstructionSet(InstructionSet wanted);

/** A function object compiled for each instruction set. Its operator() must be
 * ACTIVE_ALWAYS_INLINE. Called functions that are not inlined get the baseline set. */
template <class Kernel, class... Arguments>
struct CompiledKernel
{
  static void Baseline(const Kernel& kernel, Arguments... arguments) { kernel(arguments...); }
  ACTIVE_FOR_AVX2 static void Avx2(const Kernel& kernel, Arguments... arguments)
  {
    kernel(arguments...);
  }
  ACTIVE_FOR_AVX512 static void Avx512(const Kernel& kernel, Arguments... arguments)
  {
    kernel(arguments...);
  }

  using Function = void (*)(const Kernel&, Arguments...);
  static Function GetBest()
  {
    const InstructionSet set = GetInstructionSet();
    return set == InstructionSet::Avx512 ? Avx512 : set == InstructionSet::Avx2 ? Avx2 : Baseline;
  }
};

/** Runs a kernel without arguments, compiled for the chosen instruction set. */
template <class Kernel>
void RunCompiled(const Kernel& kernel)
{
  CompiledKernel<Kernel>::GetBest()(kernel);
}

}

#endif
