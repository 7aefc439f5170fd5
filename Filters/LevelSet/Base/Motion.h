/**
 * The motion strategy: what makes the surface move, as plain numbers.
 *
 * Normal speed, outward positive (eq. (2) to (4) and section 5 of the paper, sign of the tension
 * corrected):
 *   V = Attraction * (iso - F(x)) + Transport * (v . n) - w * Tension * kappa
 *       + AreaStiffness * (A0 - A) / A0 + VolumeStiffness * (V0 - V) / V0
 * v: the target's velocity, n: the outward normal, w: weight of tension. Substeps: v = 0, w = 1;
 * kappa = div n, the SUM of the principal curvatures (2/r on a sphere), so that a sphere under
 * tension alone obeys r^2 = r0^2 - 4 Tension t; A and V the area and the volume of the skin.
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

/** How area or volume is controlled: not at all; by a penalty speed proportional to the deficit
 * (the paper); or exactly, by a uniform displacement after each substep. */
enum class Control
{
  None,
  Penalty,
  Exact
};

/** Where the target is evaluated for the speed of a node: at the crossed edges, from which speeds
 * are extended; at the node itself; or at the closest point of the surface. */
enum class TargetEvaluation
{
  Shifted,
  Node,
  ClosestPoint
};

/** Scheme of a substep: forward Euler within the stable step of the fastest part; or for the
 * whole interval at once, at nodes near the target's surface (see nodes.md). */
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
  /** Rate at which the surface approaches the target [1/time for a distance-like target]. >= 0. */
  double Attraction = 1.0;

  /** Weight of the curvature [length^2/time]. Negative values are backward diffusion and blow up.
   */
  double Tension = 0.0;

  /**
   * Share of the target's own velocity that carries the surface along, in [0,1]. With 1 it follows
   * without a lag whatever moves as the target says, at any Attraction. Not in the paper's scheme.
   */
  double Transport = 0.0;

  /** Whether the target's weights multiply Tension. Not in the paper's scheme. */
  bool WeightedTension = false;

  /**
   * Fraction of the stable time step 1 / (2.6 Vmax/h + Attraction L + 4 Tension/h^2 + the rates
   * of the penalties). 1 is the largest stable value: 1.08 lets noise grow, 1.2 destroys the
   * surface.
   */
  double CFL = 1.0;

  /** Upper bound of a substep. The target is evaluated once per substep, at its beginning. > 0. */
  double LongestStep = std::numeric_limits<double>::infinity();

  ///@{
  /** Not both Exact: one displacement cannot restore two numbers. */
  Control AreaControl = Control::None;
  Control VolumeControl = Control::None;
  ///@}

  ///@{
  /** Speed of a penalty [length/time] per relative deficit. >= 0. A sphere under tension keeps the
   * offset e = 1 - V/V0 with e (1 - e)^(1/3) = 2 Tension / (VolumeStiffness r0), and collapses if
   * VolumeStiffness r0 < 4.233 Tension; for the area e (1 - e)^(1/2) and 5.196. */
  double AreaStiffness = 1.0;
  double VolumeStiffness = 1.0;
  ///@}

  ///@{
  /** The value to be held; 0: the value at the start. >= 0. */
  double TargetArea = 0.0;
  double TargetVolume = 0.0;
  ///@}

  TargetEvaluation Evaluation = TargetEvaluation::Shifted;
  GradientScheme Gradient = GradientScheme::Upwind;

  /** Nodes needs a target with nodes and an Attraction by which distances fall by e^2 at least, and
   * knows no penalties. */
  TimeIntegration Integration = TimeIntegration::Explicit;

  /** The paper's own scheme instead of this library's, for comparison: see PaperStep.h. */
  bool Paper = false;

  Walls Box;
  /** Beyond the sides of a periodic box, up to the walls, the node scheme repeats the surface. */
  Periods Period;

  /** What the surface may not enter, the caller's; null: nothing. It learns the leaves where the
   * surface comes. */
  Obstacle* Solid = nullptr;

  /** Whether parts of the target that no skin reaches, and hollows of it deep inside the skin, get
   * a skin, where the target has regions. Not in the paper's scheme. */
  bool CreateParts = false;
};

/** Whether the target gives the surface a speed. */
inline bool HasTargetSpeed(const Motion& motion)
{
  return motion.Attraction > 0.0;
}

/** When NarrowBand::AdvanceToSteadyState ends. */
struct SteadyStateCriterion
{
  /** Largest normal speed at the sample points [voxels/time]. If it is not 0, the surface is also
   * steady if the rest of its motion is an oscillation; see Displacement.h. */
  double Tolerance = 1e-3;
  /** A sample point that has come farther in a window of substeps moves [voxels]. */
  static constexpr double Still = .02;
  /** Largest share of the sample points that may move in a steady state. */
  static constexpr double FewMoving = .05;
  std::size_t MaximumSubsteps = 10000;
};

/** What NarrowBand::Advance or AdvanceToSteadyState did. */
struct AdvanceReport
{
  std::size_t Substeps = 0;
  std::size_t SkippedSubsteps = 0;   //< substeps skipped, as all leaves had converged
  std::size_t TargetEvaluations = 0; //< points at which the target was evaluated
  std::size_t DroppedSamples = 0;    //< points whose target value was not finite
  std::size_t UniformPulls = 0;      //< substeps in which a control EXACT undid all attraction
  std::size_t CreatedParts = 0;      //< parts and hollows, see Motion::CreateParts
  double MaxSpeed = 0.0;             //< largest |target speed| [length/time]
  bool Vanished = false;             //< the surface is empty at the end
  bool Aborted = false;              //< the progress function stopped it; the time is that reached
  bool IsSteady = false;             //< AdvanceToSteadyState came to rest
  /** Largest normal speed at the sample points in the last substep of AdvanceToSteadyState
   * [voxels/time]. */
  double SurfaceSpeed = std::numeric_limits<double>::infinity();
  /** Of AdvanceToSteadyState: 0 where the speed has met the tolerance, else the share of the
   * surface that moved in the last window, see Displacement.h; not a number before the first has
   * ended. */
  double MovingShare = 0.0;
  double MovingDistance = 0.0; //< likewise, by how far on the average [voxels]
};

/** Receives the fraction done, in [0,1], before each substep; returns false to stop there. */
using ProgressFunction = std::function<bool(double)>;

}

#endif
