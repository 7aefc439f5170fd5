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
 * F is the target, or the distance to it, less within TargetNoise; kappa the sum of the principal
 * curvatures; v the velocity of the target's particles; the last two terms belong to AreaControl
 * and VolumeControl PENALTY.
 * Changing any of these properties starts the skin anew.
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
   * Rate [1/time] at which the skin closes in on the target: the distance falls by a factor e in a
   * time of 1 / Attraction. With NormalizeTarget off its unit is [length/time] per unit of the
   * target. Range: >= 0. Default: 1; over a moving input that means more, see AutomaticAttraction.
   */
  vtkSetClampMacro(Attraction, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Attraction, double);
  ///@}

  ///@{
  /**
   * Whether an Attraction of 1, the default, stands for one that follows an input with time steps:
   * 6 over the time from a step to the next one, so that 1/400 of a distance is left. Any other
   * Attraction holds as it is, and so does 1 over other targets and with PaperScheme. Default: on.
   */
  vtkSetMacro(AutomaticAttraction, vtkTypeBool);
  vtkGetMacro(AutomaticAttraction, vtkTypeBool);
  vtkBooleanMacro(AutomaticAttraction, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Weight of surface tension [length^2/time]: adds -Tension * (sum of the principal curvatures) to
   * the speed. It smooths, and shrinks what the target does not hold: a ball under tension alone
   * has radius sqrt(r0^2 - 4 * Tension * t). The distance to a ball of radius R holds one of radius
   * R/2 + sqrt(R^2/4 - 2 * Tension / Attraction), or none where R < 2.83 sqrt(Tension /
   * Attraction); targets whose F / |grad F| is larger within hold smaller ones: particles down to
   * about 2.4, a vtkSphere, whose F is r^2 - R^2, one of radius sqrt(R^2 - 4 * Tension /
   * Attraction). Substeps are 4 * Tension * time / VoxelSize^2 at least. Range: >= 0. Default: 0,
   * none, or see AutomaticSmoothing.
   */
  vtkSetClampMacro(Tension, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tension, double);
  ///@}

  ///@{
  /**
   * How far [length] the target's surface may be off by noise. Where the skin is nearer to it, it
   * follows slowly, at 3 % of Attraction; beyond, soon at all of it; in a body of particles
   * from 1.5 times as far on. Particles move the skin of a body, as by Transport, only if they do
   * so together: what the error of the mean of their velocities explains is left out. Drops and
   * threads follow as before. So the skin of a fluid at rest is smooth and stands still, and is no
   * more than this from the target. With NormalizeTarget. Range: >= 0. Default: 0, none, or see
   * AutomaticSmoothing.
   */
  vtkSetClampMacro(TargetNoise, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetNoise, double);
  ///@}

  ///@{
  /**
   * Whether a Tension and a TargetNoise of 0, the defaults, stand for values by the spacing 2 r of
   * particles: Attraction * r^2 / 2, where TensionWeighting is on, and r / 2. Any other value holds
   * as it is, and so does 0 over other targets, with ParticleModel SUM, with PaperScheme, and
   * where other explicit substeps are taken (see TimeIntegration). Default: on.
   */
  vtkSetMacro(AutomaticSmoothing, vtkTypeBool);
  vtkGetMacro(AutomaticSmoothing, vtkTypeBool);
  vtkBooleanMacro(AutomaticSmoothing, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Fraction of the stable time step that a substep takes. Smaller is more exact in time, and takes
   * 1 / CFL times as long. Range: 1e-6 to 1. Default: 1.
   */
  vtkSetMacro(CFL, double);
  vtkGetMacro(CFL, double);
  ///@}

  ///@{
  /**
   * Whether Tension acts where particles are a body of fluid, and fades to none where one is alone
   * or in a thread of few: drops keep their size. A particle's neighbours within 3
   * (AVERAGED_CENTRE) or 3.6 spacings decide: where half of a body's are around a third of Tension
   * acts, all of it with three quarters of them. Of no use to other targets, in explicit substeps
   * and with PaperScheme. Default: on.
   */
  vtkSetMacro(TensionWeighting, vtkTypeBool);
  vtkGetMacro(TensionWeighting, vtkTypeBool);
  vtkBooleanMacro(TensionWeighting, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Share [1] of the particles' own velocity that carries the skin: adds Transport * (v . n), v the
   * mean velocity of the particles around, from their way to the next time step, to the speed. With
   * 1 the skin does not lag behind particles that move. Of no use to other targets, in explicit
   * substeps and with PaperScheme. Range: 0 to 1. Default: 1.
   */
  vtkSetClampMacro(Transport, double, 0.0, 1.0);
  vtkGetMacro(Transport, double);
  ///@}

  ///@{
  /**
   * Whether parts of the target that no skin reaches get one, with the size that they have in the
   * substep in which they appear: emitters, rain, spray, morphs between shapes that do not overlap.
   * Hollows that only the target has, deep inside the skin, open likewise. Of a mesh or an image,
   * or a vtkGridPotential as a function, that is a connected part, or a hollow, that the skin does
   * not meet at all; of particles, one that the skin does not get to by itself. What Tension would
   * take away is not created. Off: a skin is only where the skin before has been. Of no use to
   * skeletons of lines, to other functions and to the PaperScheme. Default: on.
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
   * How the volume of the skin is held (paper, section 5.2). NONE (0). PENALTY (1): a speed in
   * proportion to what is missing; a ball of radius r0 under tension alone keeps missing a share e
   * of it, e (1 - e)^(1/3) = 2 Tension / (VolumeStiffness r0), and collapses where VolumeStiffness
   * * r0 < 4.233 Tension. EXACT (2): a uniform displacement after each substep restores it, to 1e-6
   * and through splits to 1e-5, without stiffness; a substep then takes three times as long.
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
   * How the area of the skin is held (paper, section 5.1): NONE (0), PENALTY (1) or EXACT (2), as
   * with VolumeControl. The offset of a penalty is e (1 - e)^(1/2) = 2 Tension / (AreaStiffness
   * r0), its least stiffness 5.196 Tension / r0. Not EXACT together with VolumeControl: one
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
   * Speed [length/time] per share of the volume that is missing, with VolumeControl PENALTY.
   * Substeps are VolumeStiffness * time * area / volume at least. Range: >= 0. Default: 1.
   */
  vtkSetClampMacro(VolumeStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VolumeStiffness, double);
  ///@}

  ///@{
  /**
   * Speed [length/time] per share of the area that is missing, with AreaControl PENALTY.
   * Range: >= 0. Default: 1.
   */
  vtkSetClampMacro(AreaStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AreaStiffness, double);
  ///@}

  ///@{
  /**
   * Volume [length^3] that VolumeControl holds, with EXACT from the first frame on. Range: >= 0;
   * 0 is that of the skin at the start. Default: 0.
   */
  vtkSetClampMacro(TargetVolume, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetVolume, double);
  ///@}

  ///@{
  /**
   * Area [length^2] that AreaControl holds, with EXACT from the first frame on. Range: >= 0; 0 is
   * that of the skin at the start. Default: 0.
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
   * Where the target is evaluated for the speed of a lattice node. SHIFTED (0): where its edges
   * cross the skin (paper, section 4.3), extended from there. NODE (1): at the node, which freezes
   * into a staircase (the paper's Figs. 2 and 3). CLOSEST_POINT (2): at the closest point of the
   * skin, as smooth as SHIFTED and four times the evaluations. Default: SHIFTED.
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
   * How time is integrated. EXPLICIT (0): substeps as short as the fastest part of the skin needs.
   * AUTOMATIC (1): over particles one step for each time step, which carries the skin, evaluates
   * the target once, at lattice nodes near its surface, and relaxes the skin towards it; else
   * EXPLICIT. Particles take EXPLICIT too, with a warning, for what only substeps support: an
   * Attraction that shortens distances by less than e^2 in a time step, penalties, InvertTarget,
   * TargetIsoValue (not with ParticleModel SUM), EQUILIBRIUM, CreateParts or NormalizeTarget off,
   * TargetEvaluation and GradientScheme other than by default, PaperScheme. Explicit substeps know
   * neither Transport nor TensionWeighting and AutomaticSmoothing. Default: AUTOMATIC.
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
   * Differences with which the potential is advected: CENTRAL (0), the paper's, which is not stable
   * by itself, or UPWIND (1), from where the skin comes. Default: UPWIND.
   */
  vtkSetClampMacro(GradientScheme, int, CENTRAL, UPWIND);
  vtkGetMacro(GradientScheme, int);
  void SetGradientSchemeToCentral() { this->SetGradientScheme(CENTRAL); }
  void SetGradientSchemeToUpwind() { this->SetGradientScheme(UPWIND); }
  ///@}

  ///@{
  /**
   * Whether the paper's own scheme moves the skin: thresholds at 3 voxels, plain means of the
   * samples (or TargetEvaluation) and F at the nodes beyond, central differences, its time steps
   * (6) and (7) in a box of unit size. For comparison: it is slower, and worse. Default: off.
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
