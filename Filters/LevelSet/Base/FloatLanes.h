/**
 * Vectors of eight floats, for kernels compiled for several instruction sets (InstructionSets.h).
 * Results of each lane are bitwise identical to those of the same operations on single numbers.
 */
#ifndef FloatLanes_h
#define FloatLanes_h

#include "Base/CompilerBuiltins.h"

#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace activesurface
{

using Lanes = float __attribute__((vector_size(32)));
using LaneMask = std::int32_t __attribute__((vector_size(32))); //< -1: true, 0: false

/** Sets all lanes to x in a loop. GCC compiles Lanes{ x, x, ... } for the baseline instruction set
 * before inlining; that code goes through memory and is four times as slow. */
ACTIVE_ALWAYS_INLINE Lanes AllLanes(float x)
{
  Lanes all;
  ACTIVE_LANES
  for (int i = 0; i < 8; ++i)
  {
    all[i] = x;
  }
  return all;
}

ACTIVE_ALWAYS_INLINE Lanes LoadLanes(const float* from)
{
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

ACTIVE_ALWAYS_INLINE void StoreLanes(float* to, const Lanes& x)
{
  std::memcpy(to, &x, sizeof x);
}

/** The digits as integers: a copy, as compilers may read a reference to another type too early. */
ACTIVE_ALWAYS_INLINE LaneMask DigitsOf(const Lanes& x)
{
  LaneMask digits;
  std::memcpy(&digits, &x, sizeof digits);
  return digits;
}

ACTIVE_ALWAYS_INLINE Lanes Pick(const LaneMask& condition, const Lanes& yes, const Lanes& no)
{
  return reinterpret_cast<Lanes>((condition & DigitsOf(yes)) | (~condition & DigitsOf(no)));
}

ACTIVE_ALWAYS_INLINE Lanes Least(const Lanes& a, const Lanes& b)
{
  return a < b ? a : b;
}

ACTIVE_ALWAYS_INLINE Lanes Largest(const Lanes& a, const Lanes& b)
{
  return a > b ? a : b;
}

ACTIVE_ALWAYS_INLINE Lanes Clamp(const Lanes& x, float limit)
{
  return Least(Largest(x, AllLanes(-limit)), AllLanes(limit));
}

ACTIVE_ALWAYS_INLINE Lanes Size(const Lanes& x)
{
  constexpr std::int32_t digits = 0x7fffffff;
  const LaneMask all = { digits, digits, digits, digits, digits, digits, digits, digits };
  return reinterpret_cast<Lanes>(DigitsOf(x) & all);
}

/** Correctly rounded square roots. */
ACTIVE_ALWAYS_INLINE Lanes Root(const Lanes& x)
{
  Lanes root;
#ifdef __SSE2__
  __m128 halves[2];
  std::memcpy(halves, &x, sizeof x);
  halves[0] = _mm_sqrt_ps(halves[0]);
  halves[1] = _mm_sqrt_ps(halves[1]);
  std::memcpy(&root, halves, sizeof x);
#else
  for (int i = 0; i < 8; ++i)
  {
    root[i] = __builtin_sqrtf(x[i]);
  }
#endif
  return root;
}

/** x^(-1/3) to six digits; x > 0. */
ACTIVE_ALWAYS_INLINE Lanes InverseCubeRoot(const Lanes& x)
{
  // The initial value divides the exponent by -3. Four steps of Newton's method follow.
  constexpr std::int32_t start = 0x54a2fa8c;
  const Lanes third = __builtin_convertvector(DigitsOf(x), Lanes) * AllLanes(1.f / 3.f);
  const LaneMask bits = start - __builtin_convertvector(third, LaneMask);
  Lanes root;
  std::memcpy(&root, &bits, sizeof root);
  for (int step = 0; step < 4; ++step)
  {
    root = root * (AllLanes(4.f) - x * (root * root * root)) * AllLanes(1.f / 3.f);
  }
  return root;
}

/** Returns one bit for each lane: 1 if the condition is true. */
ACTIVE_ALWAYS_INLINE unsigned BitsOf(const LaneMask& condition)
{
#ifdef __SSE2__
  __m128 halves[2];
  std::memcpy(halves, &condition, sizeof condition);
  return static_cast<unsigned>(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
#else
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i)
  {
    bits |= (condition[i] & 1u) << i;
  }
  return bits;
#endif
}

/** 0 below `from`, 1 above `to`, a cubic polynomial in between; from < to. */
ACTIVE_ALWAYS_INLINE Lanes SmoothStep(float from, float to, const Lanes& x)
{
  const Lanes t = Least(
    Largest((x - AllLanes(from)) * AllLanes(1.f / (to - from)), AllLanes(0.f)), AllLanes(1.f));
  return t * t * (AllLanes(3.f) - AllLanes(2.f) * t);
}

}

#endif
