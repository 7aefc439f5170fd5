/**
 * Features of GCC and Clang that are missing in standard C++17: bits of words, relaxed access to
 * plain numbers, prefetching, inlining, and functions for one instruction set. A port to another
 * compiler replaces these features, and the vectors in FloatLanes.h.
 */
#ifndef CompilerBuiltins_h
#define CompilerBuiltins_h

#include <cstdint>

#if defined(__x86_64__)
#define ACTIVE_FOR_AVX2 __attribute__((target("avx2,bmi,bmi2,popcnt")))
#define ACTIVE_FOR_AVX512                                                                          \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,bmi,bmi2,popcnt")))
#else
#define ACTIVE_FOR_AVX2
#define ACTIVE_FOR_AVX512
#endif

// ACTIVE_ALWAYS_INLINE precedes a function, ACTIVE_INLINED follows the parameters of a lambda. A
// function that a kernel calls gets the instruction set of the kernel only if the function is
// inlined into the kernel.
#define ACTIVE_ALWAYS_INLINE inline __attribute__((always_inline))
#define ACTIVE_INLINED __attribute__((always_inline))

// Precedes a loop over a few lanes. Otherwise GCC would unroll the loop before vectorisation, and
// then not vectorise it.
#ifdef __clang__
#define ACTIVE_LANES _Pragma("clang loop unroll(disable)")
#else
#define ACTIVE_LANES _Pragma("GCC unroll 1")
#endif

namespace activesurface
{

/** Index of the lowest set bit; the word must not be 0. */
ACTIVE_ALWAYS_INLINE int LowestBit(std::uint64_t word)
{
  return __builtin_ctzll(word);
}

/** Number of set bits, by arithmetic: the baseline of x86-64 has no instruction for this. */
inline int CountBits(std::uint64_t word)
{
  word -= (word >> 1) & 0x5555555555555555ull;
  word = (word & 0x3333333333333333ull) + ((word >> 2) & 0x3333333333333333ull);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0full;
  return static_cast<int>((word * 0x0101010101010101ull) >> 56);
}

/** Reads a number that another thread may write with StoreRelaxed at the same time. Returns the old
 * or the new value. */
ACTIVE_ALWAYS_INLINE float LoadRelaxed(const float* from)
{
  float number;
  __atomic_load(from, &number, __ATOMIC_RELAXED);
  return number;
}

ACTIVE_ALWAYS_INLINE void StoreRelaxed(float number, float* to)
{
  __atomic_store(to, &number, __ATOMIC_RELAXED);
}

/** Adds to a number to which other threads may add at the same time. */
inline void AddRelaxed(std::uint32_t number, std::uint32_t* to)
{
  __atomic_fetch_add(to, number, __ATOMIC_RELAXED);
}

/** Sets bits of a word in which other threads may set bits at the same time. */
inline void AddBitsRelaxed(std::uint64_t bits, std::uint64_t* to)
{
  if ((__atomic_load_n(to, __ATOMIC_RELAXED) & bits) != bits)
  {
    __atomic_fetch_or(to, bits, __ATOMIC_RELAXED);
  }
}

ACTIVE_ALWAYS_INLINE void Prefetch(const void* address)
{
  __builtin_prefetch(address);
}

/** Returns true if the processor has the instructions of ACTIVE_FOR_AVX2. */
inline bool HasAvx2()
{
#if defined(__x86_64__)
  __builtin_cpu_init();
  return __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
    __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

/** Returns true if the processor has the instructions of ACTIVE_FOR_AVX512. */
inline bool HasAvx512()
{
#if defined(__x86_64__)
  return HasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

}

#endif
