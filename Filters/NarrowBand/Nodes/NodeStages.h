/**
 * Distances to the target at the nodes, and the stages that bring the potential to them:
 *
 *   w' = b g kappa |grad w| + a s (psi - w)
 *
 * over one unit of time, a = Attraction dt, b = Tension dt / h^2, g the weight of tension, psi the
 * signed distance to the target [voxels], kappa the sum of the principal curvatures. s is 1, but
 * in a body of particles small where psi - w is within the noise of their surface. At a fixed
 * point attraction and tension are in balance, exactly as in the equation of motion.
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
  float Decay = 0.f;       //< a, > 0
  float Tension = 0.f;     //< b, >= 0
  float Noise = 0.f;       //< of the target's surface [voxels]; 0: none
  bool IsWeighted = false; //< whether bulks weigh the tension; else g = 1
};

/** In [0,1], at the points of a LeafMotion. */
using LeafBulk = std::array<float, LeafMotion::Points>;

struct NodeFields
{
  const NodeLeaves& Leaves;
  const NodeArrays& Psi;
  const std::vector<LeafBulk>& Bulk;
  const std::vector<char>&
    IsFar; //< leaves that stay as they are: Potential, Room and Psi are alike
  NodeArrays& Potential;
  NodeArrays& Room; //< overwritten
  const NodeHalo& Halo;
};

/** psi = G / |grad G| by central differences, at most NodeLimit in size; G is 1 where nothing is
 * near. Outside the rows of the shell psi has the limit. */
void FindDistances(const NodeLeaves& leaves, const NodeArrays& potential, NodeArrays& psi);

/** Number of stages for which the tension is stable. */
int CountStages(const StageCoefficients& coefficients);

/** The share of a change of psi [voxels] that the potential follows in the frame. */
float FindFollowedShare(const StageCoefficients& coefficients, float change, float bulk);

void RunStages(const NodeFields& fields, const StageCoefficients& coefficients);

}

#endif
