/**
 * The displacement of an implicit substep: u* = u - d |grad u|, d the way of the nearest part of
 * the surface. The product is taken at the nodes of crossed edges and extended from there, so that
 * no gradient off the surface limits the way.
 */
#ifndef SurfaceMove_h
#define SurfaceMove_h

#include "Leaves/ActiveSet.h"
#include "Substep/StepForward.h"

namespace activesurface
{

struct SubstepBuffers;

/** From target speeds to ways; lengths in voxels. A way beyond LongestWay is clamped: its leaf has
 * to be left out of the move. */
struct WayCoefficients
{
  float Factor = 0.f;     //< way per target speed
  float Uniform = 0.f;    //< way of all nodes, added to the target's
  float Relaxation = 0.f; //< q
  bool HasTargetSpeed = false;
  bool IsUpwind = false;    //< |grad u| is Godunov's
  float SourcePerWay = 1.f; //< see FindSources
  float Tension = 0.f;      //< way per curvature
};

/** The longest way of a leaf by the target and the penalties. */
float WayOf(std::size_t leaf, const WayCoefficients& coefficients, const SubstepBuffers& buffers);

/** The longest way in these leaves. */
float LargestWay(
  const LeafList& leaves, const WayCoefficients& coefficients, const SubstepBuffers& buffers);

/** The same by all terms, with Tension. */
float LargestNetWay(const LeafTable& table, const LeafList& leaves,
  const WayCoefficients& coefficients, bool isWeighted, SubstepBuffers& buffers);

/** LargestTensionWay of these leaves, by Tension, or by all terms if that is less; and
 * LargestNetWay, by all terms. */
void FindTensionWays(const LeafTable& table, const LeafList& leaves,
  const WayCoefficients& coefficients, bool isWeighted, SubstepBuffers& buffers);

/** Replaces the speeds at the nodes of crossed edges, in the affected leaves, by d |grad u|. |grad
 * u| is Godunov's, if IsUpwind; else it is central, as tension's is, and where that is below a half
 * the larger of both, without which a single node inside stays for ever. */
void FindWays(const LeafTable& table, const ActiveSet& set, const WayCoefficients& coefficients,
  SubstepBuffers& buffers);

/** In place of FindWays, where there are none: no way of the active leaves. */
void ClearWays(const LeafTable& table, const ActiveSet& set, SubstepBuffers& buffers);

/** In place of MoveSurface, where stages follow: what they subtract (StageSource), the change by
 * MoveSurface times SourcePerWay. */
GradientCounts FindSources(const LeafTable& table, const ActiveSet& set,
  const WayCoefficients& coefficients, SubstepBuffers& buffers);

/** Next of the active leaves, from extended ways; relaxes all nodes but those of crossed edges. */
GradientCounts MoveSurface(const LeafTable& table, const ActiveSet& set,
  const WayCoefficients& coefficients, SubstepBuffers& buffers);

}

#endif
