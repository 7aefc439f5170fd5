/**
 * Distances to the target at the nodes, and the stages of a frame of the node scheme, which solve
 * for the potential w:
 *
 *   w' = b g kappa |grad w| + a s (psi - w)
 *
 * over one unit of time, the frame's duration dt. a = Attraction dt, b = Tension dt / h^2 (h: voxel
 * size), g is the weight of tension, psi the signed distance to the target [voxels], kappa the sum
 * of the principal curvatures. s is small in a body of particles where |psi - w| is within the
 * noise of the body's surface, otherwise about 1. Where the two terms nearly balance in a body with
 * noise, both are reduced by the same factor. At a fixed point the two terms balance exactly, for
 * any number of stages.
 *
 * Around a target with NodeFreedom there is no attraction, w stays within psi +- slack, and each
 * stage also shifts w to keep the volume. Slack is the half-width of the freedom. The unit of psi,
 * w and slack is then NodeFreedom::Unit instead of a voxel.
 */
#ifndef NodeStages_h
#define NodeStages_h

#include "Nodes/NodeHalo.h"
#include "Nodes/NodeLeaves.h"

#include <array>
#include <vector>

namespace activesurface
{

struct StageCoefficients
{
  float Decay = 0.f;       //< a; 0 with NodeFreedom
  float Tension = 0.f;     //< b, >= 0
  float Noise = 0.f;       //< of the target's surface [voxels]; 0: none
  bool IsWeighted = false; //< true: g depends on the bulk; false: g = 1
};

/** Bulk in [0,1] at the points of a LeafMotion. */
using LeafBulk = std::array<float, LeafMotion::Points>;

struct NodeFields
{
  const NodeLeaves& Leaves;
  const NodeArrays& Psi;
  const std::vector<LeafBulk>& Bulk;
  const std::vector<char>& IsFar; //< leaves that no stage changes: Potential = Room = Psi
  NodeArrays& Potential;
  NodeArrays& Room; //< overwritten
  const NodeHalo& Halo;
  const NodeArrays* Slack; //< null: none
  float Unit;              //< NodeFreedom::Unit
};

/** Sets psi = G / |grad G| by central differences, divided by the freedom's Unit and clamped to
 * +-NodeLimit; with a freedom, also the slack = HalfWidth / |grad G| / Unit. A smaller |grad G|
 * than LeastSlope counts as LeastSlope. G is `potential`, which is + or - 1 outside the rows of the
 * shell. Where |grad G| vanishes, psi is + or - NodeLimit, unless LeastSlope > 0. */
void FindDistances(const NodeLeaves& leaves, const NodeArrays& potential,
  const NodeFreedom& freedom, NodeArrays& psi, NodeArrays& slack);

/** Returns the fraction of a change of psi [voxels] that the potential follows in a frame by
 * attraction. */
float FindFollowedShare(const StageCoefficients& coefficients, float change, float bulk);

void RunStages(const NodeFields& fields, const StageCoefficients& coefficients);

}

#endif
