/**
 * The motion strategy: what makes the surface move, as plain numbers.
 *
 * Normal speed, outward positive (eq. (2) to (4) of the paper, sign of the tension corrected):
 *   V = Attraction * (iso - F(x)) - Tension * kappa,   kappa = div n, the SUM of the principal
 *   curvatures (2/r on a sphere), so that a sphere under tension alone obeys r^2 = r0^2 - 4 Tension
 * t.
 */
#ifndef Motion_h
#define Motion_h

#include <cstddef>
#include <functional>

namespace activesurface
{

struct Motion
{
  /** Rate [1/time for a distance-like target] at which the surface closes in on the target. >= 0.
   */
  double Attraction = 1.0;

  /** Weight of the curvature [length^2/time]. Negative values are backward diffusion and blow up.
   */
  double Tension = 0.0;

  /**
   * Fraction of the stable time step 1 / (2.6 Vmax/h + Attraction L + 4 Tension/h^2). 1 is the
   * largest stable value: 1.08 lets noise grow, 1.2 destroys the surface.
   */
  double CFL = 1.0;
};

/** What one call of NarrowBand::Advance did. */
struct AdvanceReport
{
  std::size_t Substeps = 0;
  std::size_t TargetEvaluations = 0; //< sample points at which the target was evaluated
  std::size_t DroppedSamples = 0;    //< sample points whose target value was not finite
  double MaxSpeed = 0.0;             //< largest |Attraction (iso - F)| met [length/time]
  bool Vanished = false;             //< the surface is empty at the end
  bool Aborted = false;              //< the progress function said stop; time is where it stopped
};

/** Told the fraction done, in [0,1], before each substep; returns false to stop there. */
using ProgressFunction = std::function<bool(double)>;

}

#endif
