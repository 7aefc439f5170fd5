/**
 * @class   vtkActiveMotionAlgorithm
 * @brief   the motion strategy of a vtkActiveImplicitSurface, as properties
 *
 * Normal speed of the skin, outward positive (eq. (2) to (4) and section 5 of Desbrun and
 * Cani-Gascuel 1998, the sign of the tension corrected):
 *
 *   V = Attraction * (TargetIsoValue - F) - Tension * kappa
 *       + Transport * (v . n) + AreaStiffness * (A0 - A) / A0 + VolumeStiffness * (V0 - V) / V0
 *
 * F is the target, or the distance to it, reduced within TargetNoise. kappa is the sum of the
 * principal curvatures, v the velocity of the target's particles. The last two terms belong to
 * AreaControl and VolumeControl PENALTY.
 * Changing any of these properties restarts the motion.
 */

#ifndef vtkActiveMotionAlgorithm_h
#define vtkActiveMotionAlgorithm_h

#include "vtkActiveClockAlgorithm.h"
#include "vtkActiveSurfacesModule.h" // for the export macro

class VTKACTIVESURFACES_EXPORT vtkActiveMotionAlgorithm : public vtkActiveClockAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkActiveMotionAlgorithm, vtkActiveClockAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Rate [1/time] at which the skin approaches the target: the distance falls by a factor e in a
   * time of 1 / Attraction. With NormalizeTarget off its unit is [length/time] per unit of the
   * target. Range: >= 0. Default: 1; over a moving input that means more, see AutomaticAttraction.
   */
  vtkSetClampMacro(Attraction, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Attraction, double);
  ///@}

  ///@{
  /**
   * Replaces an Attraction of 1, the default, by a value that follows an input with time steps.
   * That value is 6 over the time from a step to the next one, so that 1/400 of a distance is left.
   * Any other Attraction is used unchanged, and so is 1 over other targets and with PaperScheme.
   * Default: on.
   */
  vtkSetMacro(AutomaticAttraction, vtkTypeBool);
  vtkGetMacro(AutomaticAttraction, vtkTypeBool);
  vtkBooleanMacro(AutomaticAttraction, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Weight of surface tension [length^2/time]: adds -Tension * (sum of the principal curvatures) to
   * the speed. It smooths, and shrinks parts that the target does not hold. A ball without a target
   * has radius sqrt(r0^2 - 4 * Tension * t). The distance to a ball of radius R holds a ball of
   * radius R/2 + sqrt(R^2/4 - 2 * Tension / Attraction), or none where R < 2.83 sqrt(Tension /
   * Attraction). Targets whose F / |grad F| is larger inside hold smaller balls: particles down to
   * about 2.4; a vtkSphere, whose F is r^2 - R^2, one of radius sqrt(R^2 - 4 * Tension /
   * Attraction). There are at least 4 * Tension * time / VoxelSize^2 substeps. Range: >= 0.
   * Default: 0, none, or see AutomaticSmoothing.
   */
  vtkSetClampMacro(Tension, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tension, double);
  ///@}

  ///@{
  /**
   * Amplitude [length] of noise in the target's surface. A skin within this distance of the target
   * follows slowly, at 3 % of Attraction. Beyond, it soon follows at full Attraction; in a body of
   * particles from 1.5 times the distance on. Particles move the skin of a body, as by Transport,
   * only if they move together: velocities within the error of their mean are ignored. Drops and
   * threads follow as before. The skin of a fluid in a steady state is therefore smooth and does
   * not move, and is at most this distance from the target. With NormalizeTarget. Range: >= 0.
   * Default: 0, none, or see AutomaticSmoothing.
   */
  vtkSetClampMacro(TargetNoise, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetNoise, double);
  ///@}

  ///@{
  /**
   * Replaces a Tension and a TargetNoise of 0, the defaults, by values from the spacing 2 r of
   * particles: Attraction * r^2 / 2, if TensionWeighting is on, and r / 2. Any other value is used
   * unchanged. So is 0 over other targets, with ParticleModel SUM, with PaperScheme, and where
   * other explicit substeps are needed (see TimeIntegration). Default: on.
   */
  vtkSetMacro(AutomaticSmoothing, vtkTypeBool);
  vtkGetMacro(AutomaticSmoothing, vtkTypeBool);
  vtkBooleanMacro(AutomaticSmoothing, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Fraction of the stable time step that a substep uses. Smaller values are more accurate in time,
   * and take 1 / CFL times as long. Range: 1e-6 to 1. Default: 1.
   */
  vtkSetMacro(CFL, double);
  vtkGetMacro(CFL, double);
  ///@}

  ///@{
  /**
   * Applies Tension where particles are a body of fluid, and reduces it to zero for an isolated
   * particle or a thread of few: drops keep their size. The weight depends on a particle's
   * neighbours within 3.6 spacings. A third of Tension acts with half of a
   * body's neighbours, all of it with three quarters of them. Of no use to other targets, in
   * explicit substeps and with PaperScheme. Default: on.
   */
  vtkSetMacro(TensionWeighting, vtkTypeBool);
  vtkGetMacro(TensionWeighting, vtkTypeBool);
  vtkBooleanMacro(TensionWeighting, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Fraction [1] of the particles' own velocity that carries the skin: adds Transport * (v . n) to
   * the speed. v is the mean velocity of nearby particles, from their motion to the next time step.
   * With 1 the skin does not lag behind moving particles. Of no use to other targets, in explicit
   * substeps and with PaperScheme. Range: 0 to 1. Default: 1.
   */
  vtkSetClampMacro(Transport, double, 0.0, 1.0);
  vtkGetMacro(Transport, double);
  ///@}

  ///@{
  /**
   * Creates a skin for parts of the target that no skin reaches: emitters, rain, spray, morphs
   * between shapes that do not overlap. A part appears with its size in that substep. Voids that
   * only the target has, deep inside the skin, are created, too. Of a mesh or an image, or a
   * vtkGridPotential as a function, that is a connected part, or a void, that the skin does not
   * meet at all. Of particles, it is a part that the skin does not reach by itself. Parts that
   * Tension would remove are not created. Off: a skin only appears where the previous skin has
   * been. Of no use to skeletons of lines, to other functions and to the PaperScheme. Default: on.
   */
  vtkSetMacro(CreateParts, vtkTypeBool);
  vtkGetMacro(CreateParts, vtkTypeBool);
  vtkBooleanMacro(CreateParts, vtkTypeBool);
  ///@}

  enum ControlType
  {
    NONE = 0,
    PENALTY = 1,
    EXACT = 2
  };

  ///@{
  /**
   * Control of the volume of the skin (paper, section 5.2). NONE (0). PENALTY (1): a speed in
   * proportion to the missing fraction. A ball of radius r0 without a target keeps missing a
   * fraction e, e (1 - e)^(1/3) = 2 Tension / (VolumeStiffness r0), and collapses where
   * VolumeStiffness * r0 < 4.233 Tension. EXACT (2): a uniform displacement after each substep
   * restores the volume, to 1e-6 and through splits to 1e-5, without stiffness; a substep then
   * takes three times as long.
   * Default: NONE.
   */
  vtkSetClampMacro(VolumeControl, int, NONE, EXACT);
  vtkGetMacro(VolumeControl, int);
  void SetVolumeControlToNone() { this->SetVolumeControl(NONE); }
  void SetVolumeControlToPenalty() { this->SetVolumeControl(PENALTY); }
  void SetVolumeControlToExact() { this->SetVolumeControl(EXACT); }
  ///@}

  ///@{
  /**
   * Control of the area of the skin (paper, section 5.1): NONE (0), PENALTY (1) or EXACT (2), as
   * with VolumeControl. The offset of a penalty is e (1 - e)^(1/2) = 2 Tension / (AreaStiffness
   * r0), its least stiffness 5.196 Tension / r0. Not EXACT together with VolumeControl EXACT: one
   * displacement cannot restore both. Default: NONE.
   */
  vtkSetClampMacro(AreaControl, int, NONE, EXACT);
  vtkGetMacro(AreaControl, int);
  void SetAreaControlToNone() { this->SetAreaControl(NONE); }
  void SetAreaControlToPenalty() { this->SetAreaControl(PENALTY); }
  void SetAreaControlToExact() { this->SetAreaControl(EXACT); }
  ///@}

  ///@{
  /**
   * Speed [length/time] per missing fraction of the volume, with VolumeControl PENALTY. There are
   * at least VolumeStiffness * time * area / volume substeps. Range: >= 0. Default: 1.
   */
  vtkSetClampMacro(VolumeStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VolumeStiffness, double);
  ///@}

  ///@{
  /**
   * Speed [length/time] per missing fraction of the area, with AreaControl PENALTY.
   * Range: >= 0. Default: 1.
   */
  vtkSetClampMacro(AreaStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AreaStiffness, double);
  ///@}

  ///@{
  /**
   * Volume [length^3] that VolumeControl conserves, with EXACT from the first frame on. Range: >=
   * 0; 0 is that of the skin at the start. Default: 0.
   */
  vtkSetClampMacro(TargetVolume, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetVolume, double);
  ///@}

  ///@{
  /**
   * Area [length^2] that AreaControl conserves, with EXACT from the first frame on. Range: >= 0; 0
   * is that of the skin at the start. Default: 0.
   */
  vtkSetClampMacro(TargetArea, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetArea, double);
  ///@}

  enum TargetEvaluationType
  {
    SHIFTED = 0,
    NODE = 1,
    CLOSEST_POINT = 2
  };

  ///@{
  /**
   * Points at which the target is evaluated for the speed of a lattice node. SHIFTED (0): the
   * crossings of the node's edges with the skin (paper, section 4.3), extended from there. NODE
   * (1): the node itself, which freezes into a staircase (the paper's Figs. 2 and 3). CLOSEST_POINT
   * (2): the closest point of the skin, as smooth as SHIFTED and four times the evaluations.
   * Default: SHIFTED.
   */
  vtkSetClampMacro(TargetEvaluation, int, SHIFTED, CLOSEST_POINT);
  vtkGetMacro(TargetEvaluation, int);
  void SetTargetEvaluationToShifted() { this->SetTargetEvaluation(SHIFTED); }
  void SetTargetEvaluationToNode() { this->SetTargetEvaluation(NODE); }
  void SetTargetEvaluationToClosestPoint() { this->SetTargetEvaluation(CLOSEST_POINT); }
  ///@}

  enum TimeIntegrationType
  {
    EXPLICIT = 0,
    AUTOMATIC = 1
  };

  ///@{
  /**
   * Integration in time. EXPLICIT (0): substeps as short as the fastest part of the skin needs.
   * AUTOMATIC (1): over particles one step for each time step, else EXPLICIT. That step carries the
   * skin, evaluates the target once, at lattice nodes near its surface, and relaxes the skin
   * towards it. Particles use EXPLICIT, with a warning, for features that only substeps support: an
   * Attraction that shortens distances by less than e^2 in a time step, penalties, InvertTarget,
   * TargetIsoValue (with SUM: at least ParticleThreshold), EQUILIBRIUM, CreateParts or
   * NormalizeTarget off, TargetEvaluation and GradientScheme other than by default, PaperScheme.
   * Explicit substeps ignore Transport, TensionWeighting and AutomaticSmoothing. Default:
   * AUTOMATIC.
   */
  vtkSetClampMacro(TimeIntegration, int, EXPLICIT, AUTOMATIC);
  vtkGetMacro(TimeIntegration, int);
  void SetTimeIntegrationToExplicit() { this->SetTimeIntegration(EXPLICIT); }
  void SetTimeIntegrationToAutomatic() { this->SetTimeIntegration(AUTOMATIC); }
  ///@}

  enum GradientSchemeType
  {
    CENTRAL = 0,
    UPWIND = 1
  };

  ///@{
  /**
   * Differences that advect the potential: CENTRAL (0), the paper's, which are unstable by
   * themselves, or UPWIND (1), one-sided, from the side that the skin comes from. Default: UPWIND.
   */
  vtkSetClampMacro(GradientScheme, int, CENTRAL, UPWIND);
  vtkGetMacro(GradientScheme, int);
  void SetGradientSchemeToCentral() { this->SetGradientScheme(CENTRAL); }
  void SetGradientSchemeToUpwind() { this->SetGradientScheme(UPWIND); }
  ///@}

  ///@{
  /**
   * Moves the skin by the paper's own scheme. The scheme has thresholds at 3 voxels, plain means of
   * the samples (or TargetEvaluation) and F at the nodes beyond, central differences, its time
   * steps (6) and (7) in a box of unit size. For comparison: it is slower and less accurate.
   * Default: off.
   */
  vtkSetMacro(PaperScheme, vtkTypeBool);
  vtkGetMacro(PaperScheme, vtkTypeBool);
  vtkBooleanMacro(PaperScheme, vtkTypeBool);
  ///@}

protected:
  vtkActiveMotionAlgorithm() = default;
  ~vtkActiveMotionAlgorithm() override = default;

private:
  vtkActiveMotionAlgorithm(const vtkActiveMotionAlgorithm&) = delete;
  void operator=(const vtkActiveMotionAlgorithm&) = delete;

  double Attraction = 1.0;
  vtkTypeBool AutomaticAttraction = 1;
  double Tension = 0.0;
  double TargetNoise = 0.0;
  vtkTypeBool AutomaticSmoothing = 1;
  vtkTypeBool TensionWeighting = 1;
  double Transport = 1.0;
  vtkTypeBool CreateParts = 1;
  double CFL = 1.0;
  int VolumeControl = NONE;
  int AreaControl = NONE;
  double VolumeStiffness = 1.0;
  double AreaStiffness = 1.0;
  double TargetVolume = 0.0;
  double TargetArea = 0.0;
  int TargetEvaluation = SHIFTED;
  int TimeIntegration = AUTOMATIC;
  int GradientScheme = UPWIND;
  vtkTypeBool PaperScheme = 0;
};

#endif
