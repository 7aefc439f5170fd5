/**
 * One forward Euler step of the potential at the active nodes, in one sweep over the leaves:
 *
 *   u' = u - dt V/h |grad u|                  advection: ENO2 one-sided differences, Godunov's
 *                                             choice; or central differences
 *          + dt w Tension kappa |grad u| / h^2  central differences; w: weight of tension, or 1
 *          - q sign(u) (|grad u| - 1)         reinitialisation, at nodes without a crossed edge
 *
 * kappa |grad u| is computed as one product, which is bounded: it needs no clamp, so the last voxel
 * vanishes in time and necks pinch off as they should.
 */
#ifndef StepForward_h
#define StepForward_h

#include "Leaves/ActiveSet.h"
#include "Substep/RowKernels.h"

#include <cmath>

namespace activesurface
{

struct SubstepBuffers;

/** Coefficients of one substep; lengths in voxels. */
struct StepCoefficients
{
  float Advection = 0.f;  //< dt / h
  float Tension = 0.f;    //< dt Tension / h^2
  float Relaxation = 0.f; //< q
  float Uniform = 0.f;    //< speed of all nodes, added to the target's
  bool HasTargetSpeed = false;
  bool IsWeighted = false; //< whether the buffers' weights multiply Tension
  bool Central = false;    //< central differences in the advective term
  float Most = HUGE_VALF;  //< |u| that Next has at most [voxels]

  bool Moves() const { return this->HasTargetSpeed || this->Uniform != 0.f; }
};

/** |u| [voxels] that nothing sound reaches, and from which no single operation overflows. */
constexpr float UnboundedPotential = 1e12f;

ACTIVE_ALWAYS_INLINE unsigned IsUnbounded(float u)
{
  return !(std::fabs(u) < UnboundedPotential); // nor is NaN below it
}

/** Whether one of these nodes of a row is. */
ACTIVE_ALWAYS_INLINE unsigned AnyUnbounded(const float* u, unsigned nodes)
{
  const RowMask& counts = MaskOfBits(nodes);
  unsigned any = 0;
  ACTIVE_LANES
  for (int z = 0; z < 8; ++z)
  {
    any |= (counts[z] > 0.f ? 1u : 0u) & IsUnbounded(u[z]);
  }
  return any;
}

/** A row after a step: what it is at active nodes, else what it was. */
ACTIVE_ALWAYS_INLINE void TakeActive(
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

/** Gradient norms at the nodes of layer 0, counted on the potential before the step. */
struct GradientCounts
{
  std::size_t Nodes = 0;  //< nodes in all leaves
  std::size_t Flat = 0;   //< norm below 1/sqrt 2, in active leaves
  std::size_t Steep = 0;  //< norm above sqrt 2, in active leaves
  bool Unbounded = false; //< Next is not finite somewhere, or not below UnboundedPotential
};

/** Sets the speed AtSurface of these leaves: the largest |change of u| / |grad u| at the nodes of
 * crossed edges, whose target speeds have to be known. Above `enough` it may be that of any node.
 * coefficients: those of a step of length 1. */
void FindRates(LeafTable& table, const LeafList& leaves, const StepCoefficients& coefficients,
  double enough, const SubstepBuffers& buffers);

/** Next of the active leaves, from the values of all active nodes (Jacobi). */
GradientCounts StepForward(const LeafTable& table, const ActiveSet& set,
  const StepCoefficients& coefficients, SubstepBuffers& buffers);

/** The counts of the active leaves, which a pass has left in the buffers. */
GradientCounts SumOfCounts(
  const LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers);

/** Copies Next to the potential of the active leaves and finds its signs. All active nodes of the
 * affected leaves count as updated. */
void CommitStep(LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers);

/** Multiplies the potential by a power of two: exact, and the surface does not move. */
void ScalePotential(LeafTable& table, float factor);

}

#endif
