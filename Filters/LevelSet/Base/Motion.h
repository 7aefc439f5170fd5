/**
 * The motion strategy: the terms that move the surface, as plain numbers.
 *
 * Normal speed, outward positive (eq. (2) to (4) and section 5 of the paper, see NarrowBand.h; sign
 * of the tension corrected):
 *   V = Attraction * (iso - F(x)) + Transport * (v . n) - w * Tension * kappa
 *       + AreaStiffness * (A0 - A) / A0 + VolumeStiffness * (B0 - B) / B0
 * F - iso: the target's value (Target.h), v: the target's velocity, n: the outward normal, w:
 * weight of tension. In explicit substeps w is 1, and there is no term of Transport. The node
 * scheme uses the signed distance to the target instead of F - iso (Nodes/NodeStages.h). kappa =
 * div n is the SUM of the principal curvatures (2/r on a sphere), so a sphere with only Tension
 * obeys r^2 = r0^2 - 4 Tension t. A and B are the area and the volume of the skin, A0 and B0 the
 * values to conserve. The terms of AreaStiffness and VolumeStiffness act only in explicit substeps
 * with Control::Penalty.
 */
#ifndef Motion_h
#define Motion_h

#include "Base/Walls.h"

#include <cstddef>
#include <functional>
#include <limits>

namespace activesurface
{

class Obstacle;

/** Control of area or volume. Penalty: a speed proportional to the deficit, as in the paper. Exact:
 * a uniform displacement after each explicit substep or frame of the node scheme. */
enum class Control
{
  None,
  Penalty,
  Exact
};

/**
 * Points at which the target is evaluated for the speed of a node. Shifted: the crossings of
 * lattice edges; nodes without a crossed edge get extended speeds, or in the paper's scheme the
 * speed at the node itself. Node: the node itself. ClosestPoint: the closest point of the surface.
 */
enum class TargetEvaluation
{
  Shifted,
  Node,
  ClosestPoint
};

/** Scheme of a substep. Explicit: forward Euler, with substeps limited by CFL. Nodes: one step per
 * NarrowBand::Advance, at nodes near the target's surface (see nodes.md). */
enum class TimeIntegration
{
  Explicit,
  Nodes
};

/** Differences of the advective term: central, or one-sided (upwind). */
enum class GradientScheme
{
  Central,
  Upwind
};

struct Motion
{
  /** Rate at which the surface approaches the target [1/time if the target is a distance]. >= 0. */
  double Attraction = 1.0;

  /** Weight of the curvature [length^2/time]. Negative values are backward diffusion and blow up.
   */
  double Tension = 0.0;

  /**
   * Fraction of the target's velocity with which the surface is carried, in [0,1]. With 1 the
   * surface follows a moving target nearly without lag. Used only by TimeIntegration::Nodes.
   */
  double Transport = 0.0;

  /** If true, a weight from the target's bulk (LeafMotion) multiplies Tension. Used only by
   * TimeIntegration::Nodes. */
  bool WeightedTension = false;

  /**
   * Fraction of the stable time step 1 / (2.6 Vmax/h + Attraction L + 4 Tension/h^2 + the rates of
   * the penalties); h: voxel size, L: target slope, Vmax: largest |target speed| plus |speed of the
   * penalties|. The paper's scheme has another stable step (Front/PaperStep.h). 1 is the largest
   * stable value: 1.08 lets noise grow, 1.2 destroys the surface.
   */
  double CFL = 1.0;

  /** Upper bound of an explicit substep [time], > 0. The target is evaluated once, at the beginning
   * of the substep. */
  double LongestStep = std::numeric_limits<double>::infinity();

  ///@{
  /** At most one may be Exact: one displacement cannot restore two numbers. */
  Control AreaControl = Control::None;
  Control VolumeControl = Control::None;
  ///@}

  ///@{
  /** Speed of a penalty [length/time] per relative deficit. >= 0. A sphere moved only by tension
   * and one penalty keeps a deficit e; r0 is its radius without deficit:
   *   volume: e = 1 - B/B0, e (1 - e)^(1/3) = 2 Tension / (VolumeStiffness r0),
   *   area:   e = 1 - A/A0, e (1 - e)^(1/2) = 2 Tension / (AreaStiffness r0).
   * The sphere collapses if VolumeStiffness r0 < 4.233 Tension, or AreaStiffness r0 < 5.196
   * Tension. */
  double AreaStiffness = 1.0;
  double VolumeStiffness = 1.0;
  ///@}

  ///@{
  /** The area [length^2] and the volume [length^3] to conserve; 0: the value at the start. >= 0. */
  double TargetArea = 0.0;
  double TargetVolume = 0.0;
  ///@}

  TargetEvaluation Evaluation = TargetEvaluation::Shifted;
  GradientScheme Gradient = GradientScheme::Upwind;

  /** With TimeIntegration::Nodes the target's GetNodes must not be null, and Attraction should
   * reduce distances by a factor e^2 or more per NarrowBand::Advance. The band does not check these
   * conditions, and ignores penalties. */
  TimeIntegration Integration = TimeIntegration::Explicit;

  /** If true, uses the paper's own scheme, for comparison: see PaperStep.h. */
  bool Paper = false;

  Walls Box;
  /** The periodic box. The node scheme repeats the surface beyond the sides of this box, up to the
   * walls (Box). */
  Periods Period;

  /**
   * Obstacle that the surface may not enter, owned by the caller; null: none. The obstacle is
   * sampled in the leaves of the band; by the node scheme, in the leaves near the target's surface,
   * and in leaves inside the target near walls or obstacle.
   */
  Obstacle* Solid = nullptr;

  /** If true, explicit substeps search the target's regions. Parts of the target that no skin
   * reaches, and hollows deep inside the skin, then get a skin; exceptions in Start/NewParts.h.
   * After a penalty has removed the whole surface, the next search is in the next frame. Invalid
   * with Paper; no effect without Attraction, or with TimeIntegration::Nodes, which needs no
   * search. */
  bool CreateParts = false;
};

/** Returns true if the target gives the surface a speed. */
inline bool HasTargetSpeed(const Motion& motion)
{
  return motion.Attraction > 0.0;
}

/** Condition that ends NarrowBand::AdvanceToSteadyState. */
struct SteadyStateCriterion
{
  /** Largest normal speed of a steady surface at the sample points [voxels/time]. If the tolerance
   * is not 0, a surface that only oscillates is steady too; see Displacement.h. */
  double Tolerance = 1e-3;
  /** A sample point that moves farther than this in a window of substeps counts as moved [voxels].
   */
  static constexpr double Still = .02;
  /** Largest fraction of moved sample points that counts as an oscillation; see SteadyWindow. */
  static constexpr double FewMoving = .05;
  std::size_t MaximumSubsteps = 10000;
};

/** Result of NarrowBand::Advance or AdvanceToSteadyState. */
struct AdvanceReport
{
  std::size_t Substeps = 0;
  std::size_t SkippedSubsteps = 0;   //< substeps skipped, because no leaf had to move
  std::size_t TargetEvaluations = 0; //< points at which the target was evaluated
  std::size_t DroppedSamples = 0;    //< points whose target value was not finite
  std::size_t UniformPulls = 0;      //< substeps in which an exact control cancelled all attraction
  std::size_t CreatedParts = 0;      //< parts and hollows, see Motion::CreateParts
  double MaxSpeed = 0.0;             //< largest |target speed| in explicit substeps [length/time]
  bool Vanished = false;             //< the surface is empty at the end
  bool Aborted = false;              //< the progress function cancelled the motion
  bool IsSteady = false;             //< AdvanceToSteadyState reached a steady state
  /** Largest normal speed at the sample points in the last substep of AdvanceToSteadyState
   * [voxels/time]. */
  double SurfaceSpeed = std::numeric_limits<double>::infinity();
  /**
   * Result of AdvanceToSteadyState: 0 if the speed is within the tolerance, otherwise the fraction
   * of the surface that moved in the last window of substeps (see Displacement.h). NaN before the
   * end of the first window.
   */
  double MovingShare = 0.0;
  double MovingDistance = 0.0; //< like MovingShare, but the mean displacement [voxels]
};

/** Called repeatedly with the completed fraction, in [0,1]; returns false to cancel. */
using ProgressFunction = std::function<bool(double)>;

}

#endif
