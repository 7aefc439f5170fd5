/**
 * What standard C++17 lacks and GCC and Clang have: bits of words, relaxed loads of plain numbers,
 * prefetching, inlining, and functions for one instruction set. Another compiler needs this header.
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

// Of functions, and of lambdas behind their parameters: what is called from a kernel is compiled
// with its instructions only when it becomes a part of it.
#define ACTIVE_ALWAYS_INLINE inline __attribute__((always_inline))
#define ACTIVE_INLINED __attribute__((always_inline))

// Before a loop over a few lanes: GCC unrolls it before it looks for vectors, and then finds none.
#ifdef __clang__
#define ACTIVE_LANES _Pragma("clang loop unroll(disable)")
#else
#define ACTIVE_LANES _Pragma("GCC unroll 1")
#endif

namespace activesurface
{

/** Number of the lowest bit of a word that is not 0. */
ACTIVE_ALWAYS_INLINE int LowestBit(std::uint64_t word)
{
  return __builtin_ctzll(word);
}

/** Number of bits set. The baseline instruction set has no instruction for it. */
inline int CountBits(std::uint64_t word)
{
  word -= (word >> 1) & 0x5555555555555555ull;
  word = (word & 0x3333333333333333ull) + ((word >> 2) & 0x3333333333333333ull);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0full;
  return static_cast<int>((word * 0x0101010101010101ull) >> 56);
}

/** A number that another thread may write with StoreRelaxed meanwhile: one value or the other. */
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

/** Adds to a number that other threads add to meanwhile. */
inline void AddRelaxed(std::uint32_t number, std::uint32_t* to)
{
  __atomic_fetch_add(to, number, __ATOMIC_RELAXED);
}

/** Sets bits in a word that other threads set bits in meanwhile. */
inline void AddBitsRelaxed(std::uint64_t bits, std::uint64_t* to)
{
  if ((__atomic_load_n(to, __ATOMIC_RELAXED) & bits) != bits)
  {
    __atomic_fetch_or(to, bits, __ATOMIC_RELAXED);
  }
}

/** Asks for the cache line of an address ahead of its use. */
ACTIVE_ALWAYS_INLINE void Prefetch(const void* address)
{
  __builtin_prefetch(address);
}

/** Whether the processor has what ACTIVE_FOR_AVX2 or ACTIVE_FOR_AVX512 ask for. */
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
