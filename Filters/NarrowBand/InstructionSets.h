/**
 * Which instruction sets the kernels (of rows, of leaves, of skeletons) are compiled for, and which
 * one runs.
 *
 * At its first use the library chooses the best set of the processor, or the one named by the
 * environment variable ACTIVE_INSTRUCTION_SET: sse2, avx2 or avx512. A set that the processor lacks
 * is replaced by the best one below it. Results do not depend on the choice: rows are vectorised
 * lane by lane, nothing is summed across lanes, and contraction to fused multiply-add is off.
 */
#ifndef InstructionSets_h
#define InstructionSets_h

#include "ActiveNarrowBandExport.h"
#include "CompilerBuiltins.h"

namespace activesurface
{

enum class InstructionSet
{
  Baseline, //< SSE2 on x86-64
  Avx2,
  Avx512
};

/** The set that kernels run with. */
ACTIVENARROWBAND_EXPORT InstructionSet GetInstructionSet();

/** Chooses another set, or the best one below it that the processor has; returns the choice. It
 * holds for the whole program; do not call it while a band, skin or skeleton is working. */
ACTIVENARROWBAND_EXPORT InstructionSet SetInstructionSet(InstructionSet wanted);

/** A function object compiled for each instruction set. Its operator() must be
 * ACTIVE_ALWAYS_INLINE, and so must be what it calls. */
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

/** Calls a kernel without arguments, compiled for the chosen instruction set. */
template <class Kernel>
void RunCompiled(const Kernel& kernel)
{
  CompiledKernel<Kernel>::GetBest()(kernel);
}

}

#endif
