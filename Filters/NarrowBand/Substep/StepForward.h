/**
 * One forward Euler step of the potential at the active nodes, in one sweep over the leaves:
 *
 *   u' = u - dt V/h |grad u|                  advection: ENO2 one-sided differences, Godunov's
 *                                             choice; or central differences
 *          + dt Tension kappa |grad u| / h^2  central differences
 *          - q sign(u) (|grad u| - 1)         slope relaxation, at nodes without a crossed edge
 *
 * kappa |grad u| is formed as one product, which is bounded by itself: no clamp, so that the last
 * voxel vanishes in time and necks pinch off as they should.
 */
#ifndef StepForward_h
#define StepForward_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

struct SubstepBuffers;

/** Coefficients of one substep; lengths in voxels. */
struct StepCoefficients
{
  float Advection = 0.f;  //< dt / h
  float Tension = 0.f;    //< dt Tension / h^2
  float Relaxation = 0.f; //< q
  float Uniform = 0.f;    //< speed of all nodes, besides the target's
  bool Attracted = false; //< whether there are target speeds
  bool Central = false;   //< differences of the advective part

  bool Moves() const { return this->Attracted || this->Uniform != 0.f; }
};

/** Slopes of the nodes of layer 0, counted on the potential before the step. */
struct SlopeCounts
{
  std::size_t Nodes = 0; //< of all leaves
  std::size_t Flat = 0;  //< slope below 1/sqrt 2, in active leaves
  std::size_t Steep = 0; //< slope above sqrt 2, in active leaves
};

/** How fast the surface moves at the nodes of crossed edges, whose target speeds have to be known:
 * the change of u over its slope. The largest one of each of these leaves becomes its speed
 * AtSurface; one that is above `enough` may be any that is. coefficients: of a step of length 1. */
void FindRates(LeafTable& table, const LeafList& leaves, const StepCoefficients& coefficients,
  double enough, const SubstepBuffers& buffers);

/** Next of the active leaves, from the values of all active nodes (Jacobi). */
SlopeCounts StepForward(const LeafTable& table, const ActiveSet& set,
  const StepCoefficients& coefficients, SubstepBuffers& buffers);

/** Makes Next the potential of the active leaves, with its signs; the active nodes of the affected
 * leaves count as advanced, also those that have stayed. */
void TakeNext(LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers);

/** Multiplies the potential by a power of two: exact, and the surface stays where it is. */
void ScalePotential(LeafTable& table, float factor);

}

#endif
