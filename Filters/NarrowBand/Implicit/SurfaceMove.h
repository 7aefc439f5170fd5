/**
 * The displacement of an implicit substep: u* = u - d |grad u|, d the displacement of the nearest
 * part of the surface. The product is taken at the nodes of crossed edges and extended from there,
 * so that no gradient off the surface limits the displacement.
 */
#ifndef SurfaceMove_h
#define SurfaceMove_h

#include "Leaves/ActiveSet.h"
#include "Substep/StepForward.h"

namespace activesurface
{

struct SubstepBuffers;

/** Below it a central gradient tells no direction. */
constexpr float FlatGradientSquare = .25f;

/** From target speeds to displacements; lengths in voxels. A displacement beyond
 * LongestDisplacement is clamped: its leaf has to be left out of the move. */
struct MoveCoefficients
{
  float Factor = 0.f;     //< displacement per target speed
  float Uniform = 0.f;    //< displacement of all nodes, added to the target's
  float Relaxation = 0.f; //< q
  bool HasTargetSpeed = false;
  bool IsUpwind = false;             //< |grad u| is Godunov's
  bool IsBalanced = false;           //< by tension, see FindSources
  float SourcePerDisplacement = 1.f; //< see FindSources
  float Tension = 0.f;               //< displacement per curvature
};

/** The longest displacement of a leaf by the target and the penalties. */
float DisplacementOf(
  std::size_t leaf, const MoveCoefficients& coefficients, const SubstepBuffers& buffers);

/** The longest displacement in these leaves. */
float LargestDisplacement(
  const LeafList& leaves, const MoveCoefficients& coefficients, const SubstepBuffers& buffers);

/** Replaces the speeds at the nodes of crossed edges, in the affected leaves, by d |grad u|. |grad
 * u| is Godunov's, if IsUpwind; else it is central, as tension's is, and where that is below a half
 * the larger of both, without which a single node inside stays for ever. */
void FindDisplacements(const LeafTable& table, const ActiveSet& set,
  const MoveCoefficients& coefficients, SubstepBuffers& buffers);

/** In place of FindDisplacements, where there are none: no displacement of the active leaves. */
void ClearDisplacements(const LeafTable& table, const ActiveSet& set, SubstepBuffers& buffers);

/** In place of MoveSurface, where stages follow: what they subtract (StageSource), the change by
 * MoveSurface times SourcePerDisplacement. If IsBalanced, what tension balances, by the leaves'
 * Balances, is proportional to |grad u| of each node off the surface, as tension is. */
GradientCounts FindSources(const LeafTable& table, const ActiveSet& set,
  const MoveCoefficients& coefficients, SubstepBuffers& buffers);

/** Next of the active leaves, from extended displacements; relaxes all nodes but those of crossed
 * edges. */
GradientCounts MoveSurface(const LeafTable& table, const ActiveSet& set,
  const MoveCoefficients& coefficients, SubstepBuffers& buffers);

}

#endif
