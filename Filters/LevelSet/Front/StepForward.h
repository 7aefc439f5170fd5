/**
 * One forward Euler step of the potential at the active nodes, in one sweep over the leaves:
 *
 *   u' = u - dt V/h |grad u|                  advection: ENO2 one-sided differences and
 *                                             Godunov's scheme, or central differences
 *          + dt Tension kappa |grad u| / h^2  central differences
 *          - q sign(u) (|grad u| - 1)         reinitialisation, at nodes without a crossed edge
 *
 * V: speed without tension [length/time], h: voxel size, q: see RelaxationFor; |grad u| and kappa
 * per voxel. kappa |grad u| is computed as one product, which is bounded without a clamp of kappa.
 * The last voxel of a part eventually vanishes, and necks pinch off.
 */
#ifndef StepForward_h
#define StepForward_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

struct SubstepBuffers;

/** Coefficients of one substep; h: voxel size. */
struct StepCoefficients
{
  float Advection = 0.f;  //< dt / h
  float Tension = 0.f;    //< dt Tension / h^2
  float Relaxation = 0.f; //< q
  float Uniform = 0.f;    //< speed of all nodes, added to the target speed [length/time]
  bool HasTargetSpeed = false;
  bool Central = false; //< central differences in the advective term

  bool Moves() const { return this->HasTargetSpeed || this->Uniform != 0.f; }
};

/** Gradient norms at the nodes of layer 0, counted on the potential before the step. */
struct GradientCounts
{
  std::size_t Nodes = 0;  //< nodes in all leaves
  std::size_t Flat = 0;   //< norm below 1/sqrt 2, in active leaves
  std::size_t Steep = 0;  //< norm above sqrt 2, in active leaves
  bool Unbounded = false; //< Next is not finite or reaches UnboundedPotential

  /** Factor of the potential: 2 if most nodes are Flat, 0.5 if most nodes are Steep, else 1. */
  float GetScale() const
  {
    return 2 * this->Flat > this->Nodes ? 2.f : 2 * this->Steep > this->Nodes ? .5f : 1.f;
  }
};

/** Sets the speed AtSurface of these leaves: the largest |change of u| / |grad u| at the nodes of
 * crossed edges. The target speeds at these nodes have to be valid. If the largest speed exceeds
 * `enough`, any speed above `enough` may be stored instead. coefficients: those of a step of dt =
 * h. */
void FindRates(LeafTable& table, const LeafList& leaves, const StepCoefficients& coefficients,
  double enough, const SubstepBuffers& buffers);

/** Sets Next of the active leaves from the values before the step (Jacobi). */
GradientCounts StepForward(const LeafTable& table, const ActiveSet& set,
  const StepCoefficients& coefficients, SubstepBuffers& buffers);

/** Sums the counts that a pass has stored in the buffers for the active leaves; Nodes is counted in
 * all leaves of this rank. */
GradientCounts SumOfCounts(
  const LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers);

/** Copies Next to the potential of the active leaves and finds the signs. Marks all active nodes of
 * the affected leaves as updated, and invalidates the speeds of these leaves. */
void CommitStep(LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers);

/** Multiplies the potential by a power of two: exact, and the surface does not move. */
void ScalePotential(LeafTable& table, float factor);

}

#endif
