/**
 * The scheme of the paper (NarrowBand.h), for comparison. front.md compares it with this library's
 * front scheme.
 *
 * - The potential is clamped to the thresholds, +- 3 voxels (section 3.2). A node that enters
 *   layers 0 to 2 is activated and keeps its value. An active node outside these layers is
 *   deactivated when its value reaches a threshold.
 * - The target at a node with crossed edges is the plain mean at the crossings (4.3). For other
 *   nodes, and with another TargetEvaluation than Shifted, see NodePoints.h.
 * - Curvature (5) and gradient use central differences; the curvature is clamped to +-4 per voxel.
 * - Time steps (6) and (7): V dt <= h, and dt <= h^2 / (2 Tension |grad f|). Here f = -phi / (3 h)
 *   is the paper's potential. The units of (7) are inconsistent; (7) is evaluated in a box of unit
 *   size.
 * - The gradient norm is not maintained.
 */
#ifndef PaperStep_h
#define PaperStep_h

#include "Leaves/ActiveSet.h"

namespace activesurface
{

struct SubstepBuffers;

/** The thresholds [voxels]. */
constexpr float PaperThreshold = 3.f;

struct PaperLimits
{
  double Speed = 0.0;        //< largest |V| [length/time]
  double GradientNorm = 0.0; //< largest |grad phi|
};

/**
 * Completes the speed in the buffers: adds `uniform` and subtracts tension * curvature. If
 * `attracted`, the buffers have to contain the target's speed; otherwise the contents of the
 * buffers are ignored. tension: Tension / h [length/time].
 */
PaperLimits FindPaperSpeed(
  const LeafTable& table, bool attracted, double uniform, double tension, SubstepBuffers& buffers);

/** Returns the smaller step of the paper's equations (6) and (7); infinite if nothing moves.
 * boxSize: longest side of the bounds, the unit of length of |grad f|. */
double PaperTimeStep(const PaperLimits& limits, double tension, double voxelSize, double boxSize);

/** Sets Next from the complete speed. advection: dt / h. */
void StepPaper(const LeafTable& table, double advection, SubstepBuffers& buffers);

/** Finds the layers, then activates and deactivates nodes. BandLeaf::Active has to contain the
 * nodes that were active before the substep. */
void RebuildPaperBand(LeafTable& table, ActiveSet& set, PotentialTree& tree);

/** Prepares a band for a change to the paper's scheme (RebuildPaperBand) if isPaper, otherwise to
 * this library's scheme (RebuildLayers). The paper's scheme begins with all nodes of the layers
 * active. HoldsStaleValue is set at all nodes. */
void BeginScheme(LeafTable& table, bool isPaper);

}

#endif
