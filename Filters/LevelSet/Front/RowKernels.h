/**
 * The terms of the evolution equation on a row of eight nodes.
 *
 * Plain loops without branches, which the compiler vectorises. u points at the row in a LeafBlock;
 * differences are per voxel. No floats are summed across a row, and contraction to fused
 * multiply-add is off, so results are bitwise identical for any vector width.
 */
#ifndef RowKernels_h
#define RowKernels_h

#include "Base/InstructionSets.h"
#include "Leaves/LeafBlock.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace activesurface
{

using RowMask = std::array<float, 8>; //< 1 where a bit is set, else 0

constexpr std::array<RowMask, 256> MakeRowMasks()
{
  std::array<RowMask, 256> all{};
  for (unsigned b = 0; b < 256; ++b)
  {
    for (unsigned z = 0; z < 8; ++z)
    {
      all[b][z] = (b >> z) & 1u ? 1.f : 0.f;
    }
  }
  return all;
}

inline constexpr std::array<RowMask, 256> RowMasks = MakeRowMasks();

/** The eight bits of a row as numbers 0 or 1. */
ACTIVE_ALWAYS_INLINE const RowMask& MaskOfBits(unsigned bits)
{
  return RowMasks[bits];
}

/** Returns a or b, whichever has the smaller magnitude, if their signs are equal; else 0. */
ACTIVE_ALWAYS_INLINE float MinMod(float a, float b)
{
  return std::max(std::min(a, b), 0.f) + std::min(std::max(a, b), 0.f);
}

/** Godunov's upwind |du|^2 on one axis, for outward and for inward motion of the surface. */
struct UpwindSquares
{
  float Outward;
  float Inward;
};

/** ENO2: one-sided differences, each corrected by half the MinMod of two second differences. */
ACTIVE_ALWAYS_INLINE UpwindSquares UpwindDifferences(const float* u, int stride)
{
  const float behind = u[0] - u[-stride];
  const float ahead = u[stride] - u[0];
  const float here = ahead - behind;
  const float bendBehind = u[0] - 2.f * u[-stride] + u[-2 * stride];
  const float bendAhead = u[0] - 2.f * u[stride] + u[2 * stride];
  const float minus = behind + .5f * MinMod(here, bendBehind);
  const float plus = ahead - .5f * MinMod(here, bendAhead);
  const float outward = std::max(std::max(minus, -plus), 0.f);
  const float inward = std::max(std::max(-minus, plus), 0.f);
  return { outward * outward, inward * inward };
}

/** next -= advection * V * |grad u| + q * sign(u) * (|grad u| - 1). V: speed, q: relaxation. */
ACTIVE_ALWAYS_INLINE void AddTransport(
  const float* u, const float* speed, float advection, const RowMask& relaxation, float* next)
{
  for (int z = 0; z < 8; ++z)
  {
    const UpwindSquares x = UpwindDifferences(u + z, LeafBlock::X);
    const UpwindSquares y = UpwindDifferences(u + z, LeafBlock::Y);
    const UpwindSquares w = UpwindDifferences(u + z, LeafBlock::Z);
    const float outward = std::sqrt(x.Outward + y.Outward + w.Outward);
    const float inward = std::sqrt(x.Inward + y.Inward + w.Inward);
    const float norm = speed[z] > 0.f ? outward : inward;
    const float excess = u[z] < 0.f ? 1.f - inward : outward - 1.f;
    next[z] -= advection * speed[z] * norm + relaxation[z] * excess;
  }
}

/** Squared gradient norms by central differences. */
ACTIVE_ALWAYS_INLINE void CentralGradientSquares(const float* u, float* squares)
{
  constexpr int X = LeafBlock::X, Y = LeafBlock::Y, Z = LeafBlock::Z;
  ACTIVE_LANES
  for (int z = 0; z < 8; ++z)
  {
    const float* c = u + z;
    const float gx = .5f * (c[X] - c[-X]), gy = .5f * (c[Y] - c[-Y]), gz = .5f * (c[Z] - c[-Z]);
    squares[z] = gx * gx + gy * gy + gz * gz;
  }
}

/** Counts gradient norms below 1/sqrt 2 and above sqrt 2, at the nodes of these bits. */
ACTIVE_ALWAYS_INLINE void CountGradients(const float* u, unsigned bits, int& flat, int& steep)
{
  float squares[8];
  CentralGradientSquares(u, squares);
  const RowMask& counts = MaskOfBits(bits);
  int flatter = 0, steeper = 0;
  ACTIVE_LANES
  for (int z = 0; z < 8; ++z)
  {
    flatter += (counts[z] > 0.f ? 1 : 0) & (squares[z] < .5f ? 1 : 0);
    steeper += (counts[z] > 0.f ? 1 : 0) & (squares[z] > 2.f ? 1 : 0);
  }
  flat += flatter;
  steep += steeper;
}

/** next -= advection * V * |grad u|, by central differences, for comparison with the paper. */
ACTIVE_ALWAYS_INLINE void AddCentralTransport(
  const float* u, const float* speed, float advection, float* next)
{
  float squares[8];
  CentralGradientSquares(u, squares);
  ACTIVE_LANES
  for (int z = 0; z < 8; ++z)
  {
    next[z] -= advection * speed[z] * std::sqrt(squares[z]);
  }
}

/** Limit of |u| [voxels]: products of three smaller values are finite. */
constexpr float UnboundedPotential = 1e12f;

/** Returns nonzero if |u| of one of these nodes reaches UnboundedPotential or is NaN. */
ACTIVE_ALWAYS_INLINE unsigned AnyUnbounded(const float* u, unsigned nodes)
{
  const RowMask& counts = MaskOfBits(nodes);
  unsigned any = 0;
  ACTIVE_LANES
  for (int z = 0; z < 8; ++z)
  {
    any |= (counts[z] > 0.f ? 1u : 0u) & (std::fabs(u[z]) < UnboundedPotential ? 0u : 1u);
  }
  return any;
}

/** Sets a row after a step: the new value at active nodes, else the old value. */
ACTIVE_ALWAYS_INLINE void ReplaceActive(
  const float* was, const float* is, unsigned active, float* next)
{
  const RowMask& takes = MaskOfBits(active);
  ACTIVE_LANES
  for (int z = 0; z < 8; ++z)
  {
    const float old = was[z], now = is[z];
    next[z] = takes[z] > 0.f ? now : old;
  }
}

}

#endif
