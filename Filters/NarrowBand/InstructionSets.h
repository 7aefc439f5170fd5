/**
 * Which instruction sets a function is compiled for; the best one is chosen when the library loads.
 *
 * Results do not depend on the choice: rows are vectorised lane by lane, nothing is summed across
 * lanes, and contraction to fused multiply-add is off. The sanitizers run before such choices can
 * be made, so they get the baseline.
 */
#ifndef InstructionSets_h
#define InstructionSets_h

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ACTIVE_FOR_EACH_INSTRUCTION_SET __attribute__((target_clones("avx2", "default")))
#else
#define ACTIVE_FOR_EACH_INSTRUCTION_SET
#endif

#if defined(__GNUC__)
#define ACTIVE_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define ACTIVE_ALWAYS_INLINE inline
#endif

#endif
