/**
 * The paper's own scheme, for comparison; what it differs in is worse, see README.md.
 *
 * - The potential is clamped to +- 3 voxels, the thresholds (section 3.2): a node is woken when the
 *   surface comes near, keeps its value, and is retired when the value reaches a threshold.
 * - A node with crossed edges takes the plain mean of the target at their crossings (4.3), one
 *   without the target at itself.
 * - Curvature (5) and gradient by central differences, the curvature at most 4 per voxel.
 * - Time steps (6) and (7): V dt <= h, and dt <= h^2 / (2 Tension |grad f|) where f = phi / 3 h is
 *   the paper's potential. (7) has no consistent unit; it is taken in a box of unit size.
 * - No slope maintenance.
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
  double Speed = 0.0; //< largest |V| [length/time]
  double Slope = 0.0; //< largest |grad phi|
};

/**
 * Makes the speed in the buffers, the target's if it attracts, else anything, the whole of it:
 * adds `uniform` and takes off tension * curvature. tension: Tension / h [length/time].
 */
PaperLimits FindPaperSpeed(
  const LeafTable& table, bool attracted, double uniform, double tension, SubstepBuffers& buffers);

/** Equations (6) and (7); boxSize: longest side of the box that counts as the unit. */
double PaperTimeStep(const PaperLimits& limits, double tension, double voxelSize, double boxSize);

/** Next, from the whole speed. advection: dt / h. */
void StepPaper(const LeafTable& table, double advection, SubstepBuffers& buffers);

/** Layers, then wakes and retires nodes; Active holds those of before. */
void RebuildPaperBand(LeafTable& table, ActiveSet& set, PotentialTree& tree);

}

#endif
