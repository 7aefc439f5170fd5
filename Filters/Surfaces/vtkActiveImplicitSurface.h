/**
 * @class   vtkActiveImplicitSurface
 * @brief   a surface that follows a target through time and keeps its state
 *
 * The surface (skin) is the zero set of a potential phi, negative inside, stored on the lattice
 * nodes near this set. The skin moves along its normal, splits and merges. Source: Desbrun and
 * Cani-Gascuel, Active Implicit Surface for Animation, Graphics Interface 1998.
 *
 * Normal speed, outward positive (paper, eq. (2) to (4), section 5; sign of the tension corrected):
 *
 *     Attraction * (TargetIsoValue - F) - Tension * kappa + Transport * (v . n)
 *     + AreaStiffness * (A0 - A) / A0 + VolumeStiffness * (V0 - V) / V0
 *
 * F is the target's value; the first term has the opposite sign if the inside is above
 * TargetIsoValue. NormalizeTarget replaces F - TargetIsoValue by a distance, which TargetNoise
 * reduces. kappa is the sum of the principal curvatures, n the outward normal, v the velocity of
 * the target's particles. A and V are the skin's area and volume; A0 and V0 are TargetArea and
 * TargetVolume, or A and V at the start. Both stiffness terms need PENALTY controls.
 * Exceptions without explicit substeps (TimeIntegration): over masks, the skin is the smoothed
 * mask; over static particles, the skin stays as it starts.
 *
 * A change of a property restarts the motion, unless the property's comment says otherwise.
 * StartTime, TimeStepSize and NumberOfTimeSteps do so only if they determine the time steps. -1 is
 * the automatic value of some properties; Get...InUse returns the value in use.
 *
 * @par Input 0 (optional): target
 * - No input: TargetFunction is the target.
 * - Particles: a vtkPointSet without cells or with vertices. ParticleSpacing is the main property.
 * - Table: a vtkTable of particles. x, y, z (or Points:0 ...) are positions, other columns arrays.
 * - Blocks of particles (vtkMultiBlockDataSet, vtkPartitionedDataSet, ...): all points, block by
 *   block, with arrays common to all. If only one block has points, it may be any input listed.
 * - Skeleton: a vtkPolyData with lines, as for vtkSkeletonPotential; radii and strengths optional.
 * - Mesh: a closed vtkPolyData of polygons or strips without lines (open: see MeshThickness). F is
 *   the signed distance to the mesh.
 * - Image: a vtkImageData, whose values are F. Inside is below TargetIsoValue (with InvertTarget,
 *   above). Masks, fractions of volume: see TargetIsoValue and TargetNoise.
 *
 * @par Input 1 (optional): start, the shape at the first time
 * - No input: InitialFunction, else the target, is the shape.
 * - Mesh or image, also as the only block with points, at its first time step.
 *
 * @par Arrays of the inputs: SetInputArrayToProcess(index, ...)
 *   | Index | Unit        | Meaning                | If not chosen  |
 *   | ----- | ----------- | ---------------------- | -------------- |
 *   | 0     | length      | radii of balls, tubes  | KernelRadius   |
 *   | 1     |             | ids of particles       | point numbers  |
 *   | 2     | 1           | strengths              | 1              |
 *   | 3, 4  | that of F   | F, image at input 0, 1 | active scalars |
 *   | 5     | length/time | particles' velocities  | displacements  |
 *
 * @par Target with time steps, all of one kind
 * - Particles move in straight lines from step to step. Ids match the particles of two steps.
 *   Without ids, indices match if both steps have equally many points, and no reordering is
 *   noticed. Between two steps, a particle without a match fades out or in.
 * - Skeletons, meshes and images are blended: F = (1 - f) F0 + f F1 at a fraction f of the
 *   interval. A part that only F0 has shrinks. Except in skeletons, CreateParts grows parts that
 *   only F1 has.
 * - At a step without points or mesh cells there is no target: the skin shrinks or vanishes.
 *
 * @par Output 0: skin, a closed vtkPolyData of outward triangles (on several ranks, a part each)
 *   | Point array   | Unit        | Meaning                          |
 *   | ------------- | ----------- | -------------------------------- |
 *   | Normals       | 1           | outward normals (ComputeNormals) |
 *   | Velocity      | length/time | velocity (ComputeVelocity)       |
 *   | MeanCurvature | 1/length    | curvature (ComputeCurvature)     |
 *   | as at input 0 | as there    | of particles (PassTargetArrays)  |
 *
 * @par Output 1: potential, a vtkImageData
 * - The scalars "Potential" are a signed distance [length], negative inside, accurate within about
 *   1.5 voxels of the skin, and clamped to +-3 voxels.
 * - The extent [nodes] covers ModelBounds; the skin may leave the image. With ModelBounds unset,
 *   the extent may be empty before the first update.
 *
 * @par Output 2: history, a vtkTable, one row per time step so far (EQUILIBRIUM: start and end)
 *   | Column              | Unit          | Meaning                           |
 *   | ------------------- | ------------- | --------------------------------- |
 *   | Time                | pipeline time | time step                         |
 *   | Substeps            | 1             | count since previous row          |
 *   | MaxSpeed            | length/time   | of attraction (explicit substeps) |
 *   | Area                | length^2      | of the skin                       |
 *   | Volume              | length^3      | of the skin                       |
 *   | ActiveVoxels        | 1             | of the skin                       |
 *   | Components, Voids   | 1             | counts, of the skin               |
 *   | EulerCharacteristic | 1             | of the skin                       |
 *   | Outside             | 1             | fraction of the target            |
 *   | Event               |               | changes, joined by ", "           |
 *
 * - Outside: fraction of the target outside the skin, 0 to 1; the target beyond walls or in the
 *   obstacle is ignored. Particles and points of skeletons count if outside by more than their own
 *   radius. Over other targets, and with InvertTarget, sampled points of the inside count if more
 *   than a voxel outside. A value above 1 % can cause one warning.
 * - Event: changes of the skin's parts since the row before: "merge", "split", "vanish", "birth",
 *   "void opens", "void closes", "hole opens", "hole closes". With EQUILIBRIUM: "at rest", "at rest
 *   but for x %" (x % of the skin oscillates), or "not at rest".
 *
 * @par Time
 * - The time steps of the input are published, or StartTime + i * TimeStepSize if the input has
 *   fewer than two (TargetFunction, static particles); none with EQUILIBRIUM or Advance.
 * - The surface starts at the first time step. A later time continues from the current state,
 *   through each step in between. A repeated time keeps the skin. An earlier time continues from
 *   the last checkpoint up to that time (CheckpointInterval) or the start.
 * - A time between two steps moves a copy of the earlier step's skin. A time before the first step,
 *   after the last step, or within rounding of a step counts as that step.
 * - The motion restarts when target, initial shape, obstacle or a property of the motion changes.
 *   If an input of two or more time steps only gets more steps, the motion continues (with
 *   EQUILIBRIUM: restarts).
 * - If the input provides each time only once (NO_PRIOR_TEMPORAL_ACCESS, VTK 9.4), the steps are
 *   the requested times. Advance adds single frames.
 *
 * @par Reproducibility
 * - The skin is bitwise identical for the same time, time steps, inputs and properties, for any
 *   order of requests and any number of threads and ranks.
 * - On one process, piece 0 of several pieces has the whole skin and history; the image is split.
 *
 * @par Errors
 * - Errors of this filter empty the outputs. If the input fails before the filter executes, a
 *   filter of one process keeps the outputs of the last update.
 * - The next update resumes the motion (after lack of memory or an invalid property: restarts it).
 * - A vanished skin is valid: empty output and one warning.
 */

#ifndef vtkActiveImplicitSurface_h
#define vtkActiveImplicitSurface_h

#include "vtkActiveSurfacesModule.h" // for the export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for the functions

#include <memory> // for the requests

class vtkImageData;
class vtkImplicitFunction;
class vtkMultiProcessController;
class vtkPolyData;
class vtkTable;

namespace activesurface
{
class SurfaceRequests;
struct SurfaceProperties;
}

class VTKACTIVESURFACES_EXPORT vtkActiveImplicitSurface : public vtkImageAlgorithm
{
public:
  static vtkActiveImplicitSurface* New();
  vtkTypeMacro(vtkActiveImplicitSurface, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  // @name Target

  ///@{
  /** Target, instead of an input: any implicit function, negative inside. All threads evaluate
   * vtkSphere, vtkBox, vtkPlane, vtkPlanes, vtkCylinder, vtkCone, vtkQuadric, vtkSuperquadric,
   * vtkSkeletonPotential, vtkGridPotential, and a vtkImplicitBoolean of these, without a transform.
   * One thread evaluates any other function. Default: none. */
  virtual void SetTargetFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetTargetFunction();
  ///@}

  ///@{
  /** Shape of the skin at the first time, negative inside. A shape that reaches ModelBounds is
   * closed there. An error together with an input of port 1. Default: none, the skin starts on the
   * input of port 1, or else on the target. */
  virtual void SetInitialFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetInitialFunction();
  ///@}

  ///@{
  /** Obstacle that the skin may not enter, a function negative in the solid: in a rock (vtkSphere),
   * or everywhere except in the interior of a tank. The skin is closed along the obstacle.
   * Obstacles thinner than two voxels leak. A change of the obstacle restarts the motion. A saved
   * state does not contain the obstacle: set the obstacle again. Default: none. */
  virtual void SetObstacleFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetObstacleFunction();
  ///@}

  ///@{
  /** Level of the target that attracts the skin [unit of the target's values], and level of images
   * at port 1. Range: finite. Default: 0. At 0, a mask (two values, none negative) uses the middle
   * of its values, fractions of volume (0 to 1, most 0 or 1) use 0.5; the inside is above. */
  vtkSetMacro(TargetIsoValue, double);
  vtkGetMacro(TargetIsoValue, double);
  ///@}

  ///@{
  /** Makes values above TargetIsoValue the inside, also for an image at input port 1. Turn on for
   * densities. Masks and fractions of volume at TargetIsoValue 0 keep their inside. Default:
   * off. */
  vtkSetMacro(InvertTarget, vtkTypeBool);
  vtkGetMacro(InvertTarget, vtkTypeBool);
  vtkBooleanMacro(InvertTarget, vtkTypeBool);
  ///@}

  ///@{
  /** Attracts by the distance (F - TargetIsoValue) / |grad F|, instead of F - TargetIsoValue.
   * Explicit substeps clamp the distance to +-TargetReach. Off: the speed depends on the scale of
   * F. Default: on. */
  vtkSetMacro(NormalizeTarget, vtkTypeBool);
  vtkGetMacro(NormalizeTarget, vtkTypeBool);
  vtkBooleanMacro(NormalizeTarget, vtkTypeBool);
  ///@}

  ///@{
  /** Distance [length] from the target beyond which the attraction has a constant speed, Attraction
   * * TargetReach, in explicit substeps. Needs NormalizeTarget. Range: > 0, or -1, automatic: 3
   * times the ParticleSpacing, set or estimated, that an automatic VoxelSize would use; else 1/8 of
   * ModelBounds' diagonal. Default: -1. */
  vtkSetClampMacro(TargetReach, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetReach, double);
  ///@}

  ///@{
  /** Thickness [length] of the shell that an input mesh with open edges becomes. A closed mesh
   * stays a solid. A shell below about two voxels has holes. Range: >= 0, at most 1e30. Default: 0,
   * no shell: openings are closed, with a warning. */
  vtkSetClampMacro(MeshThickness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MeshThickness, double);
  ///@}

  // @name Particles

  enum ParticleModelType
  {
    SUM = 0,
    ANISOTROPIC = 1
  };

  ///@{
  /** Model of the surface of particles. SUM (0): the paper's sum of ParticleKernel at
   * ParticleThreshold; bumpy, and by default wider than the particles. ANISOTROPIC (1): ellipsoids
   * fitted to the neighbours; a body of particles has a flat surface, and an isolated particle
   * without radii is a ball of one spacing's diameter; strengths above 1 count as 1. Lines of a
   * skeleton are always a SUM. Default: ANISOTROPIC. */
  vtkSetClampMacro(ParticleModel, int, SUM, ANISOTROPIC);
  vtkGetMacro(ParticleModel, int);
  void SetParticleModelToSum() { this->SetParticleModel(SUM); }
  void SetParticleModelToAnisotropic() { this->SetParticleModel(ANISOTROPIC); }
  ///@}

  ///@{
  /** Usual distance of neighbouring particles [length]: the side of the cube that a particle fills.
   * Set ParticleSpacing for particles without radii. Range: 1e-30 to 1e30, or -1, automatic:
   * estimated, if needed, from the distances of near particles, with a warning if neither
   * KernelRadius nor radii are given. Default: -1. */
  vtkSetClampMacro(ParticleSpacing, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ParticleSpacing, double);
  ///@}

  ///@{
  /** Distance [length] at which the kernel of a particle, or of a skeleton's line, ends
   * (ANISOTROPIC: on average, in a body). Larger is smoother and slower. A chosen array of radii
   * replaces KernelRadius: an isolated particle or line of strength 1 becomes a ball or tube of its
   * radius (SUM, lines: ParticleThreshold < 1). Range: 1e-30 to 1e30, or -1, automatic: 2 (SUM,
   * lines) or 2.25 (ANISOTROPIC) times ParticleSpacing. Default: -1. */
  vtkSetClampMacro(KernelRadius, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(KernelRadius, double);
  ///@}

  ///@{
  /** Largest ratio of the axes of a particle's ellipsoid [1], with ANISOTROPIC; 1 makes balls.
   * Range: 1 to 100. Default: 4. */
  vtkSetClampMacro(Anisotropy, double, 1.0, 100.0);
  vtkGetMacro(Anisotropy, double);
  ///@}

  enum ParticleKernelType
  {
    WYVILL = 0,
    CUBIC_SPLINE = 1,
    METABALL = 2
  };

  ///@{
  /** Kernel of SUM and of skeletons: WYVILL (0), smooth; CUBIC_SPLINE (1), narrower, the kernel of
   * SPH; METABALL (2). With all models, the kernel also weights the arrays of PassTargetArrays and
   * TangentialVelocity. Default: WYVILL. */
  vtkSetClampMacro(ParticleKernel, int, WYVILL, METABALL);
  vtkGetMacro(ParticleKernel, int);
  void SetParticleKernelToWyvill() { this->SetParticleKernel(WYVILL); }
  void SetParticleKernelToCubicSpline() { this->SetParticleKernel(CUBIC_SPLINE); }
  void SetParticleKernelToMetaball() { this->SetParticleKernel(METABALL); }
  ///@}

  ///@{
  /** Level [1] of the particles' summed influence at which SUM places the surface. Without radii,
   * lower values give thicker bodies. Also the level of a skeleton. Range: > 0. Default: 0.5. */
  vtkSetMacro(ParticleThreshold, double);
  vtkGetMacro(ParticleThreshold, double);
  ///@}

  ///@{
  /** Periodic box (xmin, xmax, ymin, ymax, zmin, zmax) [length] of the particles, as of a
   * simulation of molecules. The skin is closed at the box's periodic sides. An error with
   * VolumeControl or AreaControl. Range: finite; an axis with min >= max is not periodic. Default:
   * (1, -1, 1, -1, 1, -1), no axis. */
  vtkSetVector6Macro(PeriodicBounds, double);
  vtkGetVector6Macro(PeriodicBounds, double);
  ///@}

  // @name Resolution

  ///@{
  /** Spacing of the lattice nodes [length]: the smallest detail of the skin. Half the size: up to
   * 4 times the memory and the time (explicit substeps: up to 8 times the time, with Tension 16).
   * Range: 1e-30 to 1e30, or -1, automatic: half of ParticleSpacing if set (for functions only
   * without ModelBounds); otherwise from the estimated spacing, the pixels or the bounds
   * (PARAMETERS.md). Default: -1. */
  vtkSetClampMacro(VoxelSize, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /** Box (xmin, xmax, ymin, ymax, zmin, zmax) [length] that the potential's image covers. The first
   * skin ends at this box, unless its shape is particles or masks without explicit substeps (or
   * with those of a low Attraction); later skins may leave the box. Set ModelBounds for functions
   * other than vtkSkeletonPotential and vtkGridPotential without transform. Range: finite, min <
   * max on each axis, or unset. Default: unset (1, -1, 1, -1, 1, -1), the box of the first step's
   * target and of the initial shape, with a margin. */
  vtkSetVector6Macro(ModelBounds, double);
  vtkGetVector6Macro(ModelBounds, double);
  ///@}

  ///@{
  /** Keeps the skin within ModelBounds: the target is cut off at the faces of that box, where the
   * skin is closed. Turn on for water in a box. Default: off. */
  vtkSetMacro(BoundedDomain, vtkTypeBool);
  vtkGetMacro(BoundedDomain, vtkTypeBool);
  vtkBooleanMacro(BoundedDomain, vtkTypeBool);
  ///@}

  // @name Motion

  ///@{
  /** Rate [1/time] of approach to the target: without TargetNoise and Tension, a small distance
   * falls by about a factor e in a time of 1 / Attraction. Without NormalizeTarget: [length/time]
   * per unit of the target. Over moving particles and masks, less than 2 / (TimeScale * interval of
   * time steps) causes explicit substeps. Range: >= 0, or -1, automatic: 6 / (TimeScale * interval
   * of time steps); 1 if the target is static, or with EQUILIBRIUM or PaperScheme. Default: -1. */
  vtkSetClampMacro(Attraction, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Attraction, double);
  ///@}

  ///@{
  /** Weight of surface tension [length^2/time]: adds -Tension * (sum of the principal curvatures)
   * to the speed. Tension smooths the skin, and shrinks small parts: in a target of distances, such
   * as a mesh, balls with a radius below 2.83 sqrt(Tension / Attraction) vanish. The number of
   * explicit substeps rises with Tension / VoxelSize^2. Over moving particles with automatic
   * Attraction, the first frame ignores a given Tension, with a warning unless substeps are
   * explicit. Range: >= 0, or -1, automatic: Attraction * r^2 / 2 over particles of spacing 2 r
   * (SUM, or TensionWeighting off: 0), Attraction * p^2 / 5 over masks of shortest pixel side p; 0
   * for other targets and in explicit substeps. Default: -1. */
  vtkSetClampMacro(Tension, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tension, double);
  ///@}

  ///@{
  /** Reduces Tension to 0 for isolated particles and thin threads, so that drops keep their size.
   * Off: Tension acts everywhere, and the automatic Tension over particles is 0. No effect on other
   * targets, in explicit substeps and with PaperScheme. Default: on. */
  vtkSetMacro(TensionWeighting, vtkTypeBool);
  vtkGetMacro(TensionWeighting, vtkTypeBool);
  vtkBooleanMacro(TensionWeighting, vtkTypeBool);
  ///@}

  ///@{
  /** Amplitude [length] of noise in the target's surface: within about this distance of the target
   * the skin follows slowly. The skin of still water then does not flicker. Without explicit
   * substeps, drops and threads of particles are not affected. Over masks, smoothing moves the skin
   * by at most this distance along a pixel's shortest side. Needs NormalizeTarget. Range: 0 or
   * 1e-30 to 1e30, or -1, automatic: r / 2 over particles of spacing 2 r (SUM: 0), 0.47 of a
   * pixel's shortest side over masks; 0 for other targets and in explicit substeps. Default: -1. */
  vtkSetClampMacro(TargetNoise, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetNoise, double);
  ///@}

  ///@{
  /** Fraction [1] of the particles' own velocity that carries the skin. With 1 the skin does not
   * lag behind moving particles. No effect on other targets, in explicit substeps and with
   * PaperScheme. Range: 0 to 1. Default: 1. */
  vtkSetClampMacro(Transport, double, 0.0, 1.0);
  vtkGetMacro(Transport, double);
  ///@}

  ///@{
  /** Creates a skin for parts of the target that no skin reaches: emitters, rain, spray, morphs
   * between disjoint shapes. A new part has its size in the target at once, or with ArrivalTime
   * grows from a core. Off: no part appears apart from the previous skin. No effect with
   * PaperScheme. Without ArrivalTime, no effect on skeletons, and on functions other than a
   * vtkGridPotential without transform. Default: on. */
  vtkSetMacro(CreateParts, vtkTypeBool);
  vtkGetMacro(CreateParts, vtkTypeBool);
  vtkBooleanMacro(CreateParts, vtkTypeBool);
  ///@}

  enum EvolutionModeType
  {
    TRANSIENT = 0,
    EQUILIBRIUM = 1
  };

  ///@{
  /** Motion through the time steps, or to a steady state. TRANSIENT (0): the skin follows the time
   * steps. EQUILIBRIUM (1): an update moves the skin to a steady state on the first step's target;
   * no time steps are published. The motion ends by RestTolerance, or with a warning by
   * MaximumNumberOfSubsteps. Default: TRANSIENT. */
  vtkSetClampMacro(EvolutionMode, int, TRANSIENT, EQUILIBRIUM);
  vtkGetMacro(EvolutionMode, int);
  void SetEvolutionModeToTransient() { this->SetEvolutionMode(TRANSIENT); }
  void SetEvolutionModeToEquilibrium() { this->SetEvolutionMode(EQUILIBRIUM); }
  ///@}

  ///@{
  /** Largest normal speed [voxels/time] of a steady skin, with EvolutionMode EQUILIBRIUM. Above 0,
   * the motion also ends if only an oscillation remains (not with Attraction 0). Range: >= 0.
   * Default: 0.001. */
  vtkSetClampMacro(RestTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RestTolerance, double);
  ///@}

  ///@{
  /** Largest number of substeps of a motion to a steady state (EQUILIBRIUM). Range: >= 0. Default:
   * 10000. */
  vtkSetClampMacro(MaximumNumberOfSubsteps, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfSubsteps, int);
  ///@}

  enum TimeIntegrationType
  {
    EXPLICIT = 0,
    AUTOMATIC = 1
  };

  ///@{
  /** Integration in time. EXPLICIT (0): substeps as short as stability requires. AUTOMATIC (1):
   * moving particles and masks have one step per time step, static particles and masks without an
   * initial shape do not move, all else uses EXPLICIT. Particles and masks also use EXPLICIT with
   * PaperScheme, EQUILIBRIUM, a low Attraction (after the first skin) and other settings;
   * PARAMETERS.md lists all. Default: AUTOMATIC. */
  vtkSetClampMacro(TimeIntegration, int, EXPLICIT, AUTOMATIC);
  vtkGetMacro(TimeIntegration, int);
  void SetTimeIntegrationToExplicit() { this->SetTimeIntegration(EXPLICIT); }
  void SetTimeIntegrationToAutomatic() { this->SetTimeIntegration(AUTOMATIC); }
  ///@}

  ///@{
  /** Fraction [1] of the stable time step that an explicit substep uses. Smaller values are more
   * accurate in time, and need up to 1 / CFL times as many substeps. Range: 1e-6 to 1.
   * Default: 1. */
  vtkSetMacro(CFL, double);
  vtkGetMacro(CFL, double);
  ///@}

  enum TargetEvaluationType
  {
    SHIFTED = 0,
    NODE = 1,
    CLOSEST_POINT = 2
  };

  ///@{
  /** Points at which the target is evaluated for a node's speed, in explicit substeps. SHIFTED (0):
   * the crossings of the node's edges with the skin (paper, section 4.3); a node without crossings
   * gets its neighbours' speeds (in the paper's scheme, such a node is a point itself). NODE (1):
   * the node itself; the skin freezes into a staircase (paper, Figs. 2 and 3). CLOSEST_POINT (2):
   * the skin's closest point, slower than SHIFTED. Default: SHIFTED. */
  vtkSetClampMacro(TargetEvaluation, int, SHIFTED, CLOSEST_POINT);
  vtkGetMacro(TargetEvaluation, int);
  void SetTargetEvaluationToShifted() { this->SetTargetEvaluation(SHIFTED); }
  void SetTargetEvaluationToNode() { this->SetTargetEvaluation(NODE); }
  void SetTargetEvaluationToClosestPoint() { this->SetTargetEvaluation(CLOSEST_POINT); }
  ///@}

  enum GradientSchemeType
  {
    CENTRAL = 0,
    UPWIND = 1
  };

  ///@{
  /** Differences that advect the potential in explicit substeps. CENTRAL (0): the paper's, unstable
   * by themselves. UPWIND (1): one-sided, from the side that the skin comes from. Default: UPWIND.
   */
  vtkSetClampMacro(GradientScheme, int, CENTRAL, UPWIND);
  vtkGetMacro(GradientScheme, int);
  void SetGradientSchemeToCentral() { this->SetGradientScheme(CENTRAL); }
  void SetGradientSchemeToUpwind() { this->SetGradientScheme(UPWIND); }
  ///@}

  ///@{
  /** Moves the skin by the paper's scheme, for comparison: slower and less accurate. The potential
   * is clamped to +-3 voxels, differences are central, and time steps are by eq. (6) and (7), where
   * the longest side of ModelBounds is 1. Default: off. */
  vtkSetMacro(PaperScheme, vtkTypeBool);
  vtkGetMacro(PaperScheme, vtkTypeBool);
  vtkBooleanMacro(PaperScheme, vtkTypeBool);
  ///@}

  // @name Conservation

  enum ControlType
  {
    NONE = 0,
    PENALTY = 1,
    EXACT = 2
  };

  ///@{
  /** Control of the volume of the skin (paper, section 5.2). NONE (0): none; for smoothed masks see
   * inputs.md. PENALTY (1): a speed of VolumeStiffness times the missing fraction of the volume.
   * EXACT (2): after each step or substep a uniform displacement restores the volume. Default:
   * NONE. */
  vtkSetClampMacro(VolumeControl, int, NONE, EXACT);
  vtkGetMacro(VolumeControl, int);
  void SetVolumeControlToNone() { this->SetVolumeControl(NONE); }
  void SetVolumeControlToPenalty() { this->SetVolumeControl(PENALTY); }
  void SetVolumeControlToExact() { this->SetVolumeControl(EXACT); }
  ///@}

  ///@{
  /** Speed [length/time] per missing fraction of the volume, with VolumeControl PENALTY. Larger
   * values need more substeps. With Attraction 0, a ball of radius r0 collapses if VolumeStiffness
   * * r0 < 4.233 Tension. Range: >= 0. Default: 1. */
  vtkSetClampMacro(VolumeStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VolumeStiffness, double);
  ///@}

  ///@{
  /** Volume [length^3] that VolumeControl aims at; with EXACT, the first frame has this volume,
   * too. Range: >= 0; 0 is the volume at the start. Default: 0. */
  vtkSetClampMacro(TargetVolume, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetVolume, double);
  ///@}

  ///@{
  /** Control of the skin's area (paper, section 5.1): NONE (0), PENALTY (1) or EXACT (2), as with
   * VolumeControl. EXACT is an error with VolumeControl EXACT. Default: NONE. */
  vtkSetClampMacro(AreaControl, int, NONE, EXACT);
  vtkGetMacro(AreaControl, int);
  void SetAreaControlToNone() { this->SetAreaControl(NONE); }
  void SetAreaControlToPenalty() { this->SetAreaControl(PENALTY); }
  void SetAreaControlToExact() { this->SetAreaControl(EXACT); }
  ///@}

  ///@{
  /** Speed [length/time] per missing fraction of the area, with AreaControl PENALTY. Larger values
   * need more substeps. With Attraction 0, a ball of radius r0 collapses if AreaStiffness * r0 <
   * 5.196 Tension. Range: >= 0. Default: 1. */
  vtkSetClampMacro(AreaStiffness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AreaStiffness, double);
  ///@}

  ///@{
  /** Area [length^2] that AreaControl aims at; with EXACT, the first frame has this area, too.
   * Range: >= 0; 0 is the area at the start. Default: 0. */
  vtkSetClampMacro(TargetArea, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetArea, double);
  ///@}

  // @name Time

  ///@{
  /** Motion time per pipeline time [time/pipeline time]. Attraction and Tension are rates of motion
   * time. Set 1/25 for steps 0, 1, 2 ... at 25 per second. Range: > 0. Default: 1. */
  vtkSetMacro(TimeScale, double);
  vtkGetMacro(TimeScale, double);
  ///@}

  ///@{
  /** Time at which the skin reaches a static target [pipeline time after the first time step], to
   * about 0.1 voxel: for morphs. Thin limbs grow along their length; with CreateParts, separate
   * parts grow from a core. An error with NormalizeTarget off, with the paper's scheme or, except
   * with EQUILIBRIUM, with a moving input. No other effect with EQUILIBRIUM. Range: >= 0; 0: no
   * arrival. Default: 0. */
  vtkSetClampMacro(ArrivalTime, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ArrivalTime, double);
  ///@}

  ///@{
  /** First time step [pipeline time] if the input has at most one, and time of the first frame of
   * Advance. Range: finite. Default: 0. */
  vtkSetMacro(StartTime, double);
  vtkGetMacro(StartTime, double);
  ///@}

  ///@{
  /** Interval of steps [pipeline time] if the input has at most one. Range: > 0. Default: 0.1. */
  vtkSetMacro(TimeStepSize, double);
  vtkGetMacro(TimeStepSize, double);
  ///@}

  ///@{
  /** Number of time steps if the input has at most one. Range: 1 to 1000000. Default: 11. */
  vtkSetClampMacro(NumberOfTimeSteps, int, 1, 1000000);
  vtkGetMacro(NumberOfTimeSteps, int);
  ///@}

  // @name Output

  ///@{
  /** Adds outward unit normals of the potential to the skin, the point array "Normals". Does not
   * restart the motion. Default: on. */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /** Adds the point array "Velocity" [length/time] to the skin: the normal velocity and, with
   * TangentialVelocity, the particles' velocity along the skin. Valid through splits and merges.
   * Does not restart the motion. Default: off. */
  vtkSetMacro(ComputeVelocity, vtkTypeBool);
  vtkGetMacro(ComputeVelocity, vtkTypeBool);
  vtkBooleanMacro(ComputeVelocity, vtkTypeBool);
  ///@}

  ///@{
  /** Adds the particles' mean velocity along the skin to "Velocity", as motion blur needs.
   * Particles' velocities are from the array that SetInputArrayToProcess(5, ...) chooses, else from
   * displacements between time steps. Off: only the normal velocity. Does not restart the motion.
   * Default: on. */
  vtkSetMacro(TangentialVelocity, vtkTypeBool);
  vtkGetMacro(TangentialVelocity, vtkTypeBool);
  vtkBooleanMacro(TangentialVelocity, vtkTypeBool);
  ///@}

  ///@{
  /** Largest length [length/time] of the vectors of "Velocity"; longer vectors are shortened.
   * Prevents streaks of motion blur where parts merge. Range: >= 0; 0 is about the speed of the
   * fastest particle, or no limit without moving particles. Does not restart the motion. Default:
   * 0. */
  vtkSetClampMacro(MaximumVelocity, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumVelocity, double);
  ///@}

  ///@{
  /** Adds the point array "MeanCurvature" [1/length] to the skin: the sum of the principal
   * curvatures, 2/r on a ball of radius r, clamped to +-4 per voxel. Does not restart the motion.
   * Default: off. */
  vtkSetMacro(ComputeCurvature, vtkTypeBool);
  vtkGetMacro(ComputeCurvature, vtkTypeBool);
  vtkBooleanMacro(ComputeCurvature, vtkTypeBool);
  ///@}

  ///@{
  /** Adds the point arrays of nearby particles to the skin. Floating-point arrays and colours
   * (unsigned char, 3 or 4 components) are averaged with the kernels' weights. Other arrays, such
   * as ids and names, have the value of the particle of the largest weight. Ghost levels, and
   * arrays with a name of the skin's own arrays, are omitted. Does not restart the motion. Default:
   * off. */
  vtkSetMacro(PassTargetArrays, vtkTypeBool);
  vtkGetMacro(PassTargetArrays, vtkTypeBool);
  vtkBooleanMacro(PassTargetArrays, vtkTypeBool);
  ///@}

  ///@{
  /** Computes the potential's image, output port 1, with each skin, so that GetPotential() returns
   * this image after Update(). The image needs 4 bytes for each lattice node in ModelBounds. Does
   * not restart the motion. Default: off. */
  vtkSetMacro(OutputPotential, vtkTypeBool);
  vtkGetMacro(OutputPotential, vtkTypeBool);
  vtkBooleanMacro(OutputPotential, vtkTypeBool);
  ///@}

  // @name Limits

  ///@{
  /** Interval of stored states, in time steps. A request for an earlier time recomputes at most
   * this number of steps, unless CheckpointMemory removes states. 0 stores none: a request for an
   * earlier time restarts the motion. Does not restart the motion. Range: >= 0. Default: 1. */
  vtkSetClampMacro(CheckpointInterval, int, 0, VTK_INT_MAX);
  vtkGetMacro(CheckpointInterval, int);
  ///@}

  ///@{
  /** Memory [MiB] of each rank for stored states, 5 to 8 bytes per active voxel (isolated drops:
   * about 15). When full, states are removed so that gaps between stored steps stay small. Does not
   * restart the motion. Range: >= 0. Default: 256. */
  vtkSetClampMacro(CheckpointMemory, int, 0, VTK_INT_MAX);
  vtkGetMacro(CheckpointMemory, int);
  ///@}

  ///@{
  /** Memory limit: a band of more active voxels is an error. A ball of diameter d has about 20 * (d
   * / VoxelSize)^2 active voxels. Does not restart the motion. Range: >= 1. Default: 50000000. */
  vtkSetClampMacro(MaximumNumberOfActiveVoxels, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfActiveVoxels, vtkIdType);
  ///@}

  ///@{
  /** Number of threads that move the skin. Does not change the result, nor restart the motion.
   * Range: 0 to 1024; 0: all that TBB may use. Default: 0. */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /** Ranks that compute one skin, and update, save and load together. Each rank reads a piece of
   * each input, and returns a part of the skin. Another controller does not restart the motion,
   * unless several ranks computed the skin before, or will. Default: VTK's global controller. */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  // @name

  ///@{
  /** Save or load the state of the skin as a .vdb file with metadata. SaveState saves the state at
   * the last time step up to the time of the last update; with EQUILIBRIUM there is no state.
   * LoadState loads a state into a filter with the same properties and inputs: from the state's
   * time on, the motion continues bitwise identically. With Advance, the first frame after
   * LoadState is that of the saved time. Both functions return false, with an error, on failure;
   * a state that does not fit is an error of the next update. */
  bool SaveState(const char* file);
  bool LoadState(const char* file);
  ///@}

  /** Moves the skin to the next frame, dt [pipeline time] after the last frame, in a simulation's
   * own loop. The frame becomes the input of port 0, and may be the same object with new contents.
   * The first frame is at StartTime, or at the time of a loaded state; the first dt has no effect.
   * A changed property restarts the motion at the newest frame. Returns false, with an error, for a
   * rejected frame, which does not change the skin. Also returns false if the motion to the frame
   * stops before the end (abort, MaximumNumberOfActiveVoxels): Update() or the next frame resumes.
   * Range of dt: > 0, finite. */
  bool Advance(vtkDataObject* frame, double dt);

  /** The next update restarts the motion (Advance: at StartTime). Drops a loaded state. */
  void ResetTrajectory();

  /** Turns PaperScheme on, NormalizeTarget off; chooses EXPLICIT, SHIFTED, CENTRAL and SUM. */
  void PaperFaithful();

  ///@{
  /** Numbers of target evaluations and substeps of motions since New or ResetCounters. Starts and
   * outputs are not counted. */
  vtkIdType GetTargetEvaluations();
  vtkIdType GetSubsteps();
  void ResetCounters();
  ///@}

  ///@{
  /** Values in use of properties that may be automatic (-1). 0: not used by a motion, or not known
   * yet. Other values may be without effect, as ParticleSpacing over functions, and Attraction 1
   * before the second frame of Advance. */
  double GetVoxelSizeInUse();
  double GetParticleSpacingInUse();
  double GetKernelRadiusInUse();
  double GetTargetReachInUse();
  double GetAttractionInUse();
  double GetTensionInUse();
  double GetTargetNoiseInUse();
  ///@}

  /** The skin. */
  vtkPolyData* GetOutput();

  /** The potential's image; empty unless requested, see OutputPotential. */
  vtkImageData* GetPotential();

  /** The history, on rank 0: rows up to the skin's time (EQUILIBRIUM: 2 rows). Columns: see
   * output 2. */
  vtkTable* GetHistory();

  /** The skin as an implicit function: a vtkGridPotential that any thread may evaluate in constant
   * time. Within about 1.5 voxels of the skin the values are distances [length], clamped to +-3
   * voxels; farther away only the sign is correct (several ranks: see ranks.md). The object is
   * always the same, with the new skin after each update. To follow a moving skin with another
   * filter, connect the output port instead. */
  vtkImplicitFunction* GetSkinFunction();

  vtkMTimeType GetMTime() override;

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  vtkActiveImplicitSurface();
  ~vtkActiveImplicitSurface() override;

  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  void ReportReferences(vtkGarbageCollector* collector) override;

private:
  vtkActiveImplicitSurface(const vtkActiveImplicitSurface&) = delete;
  void operator=(const vtkActiveImplicitSurface&) = delete;

  activesurface::SurfaceProperties FindProperties();

  vtkSmartPointer<vtkImplicitFunction> TargetFunction;
  vtkSmartPointer<vtkImplicitFunction> InitialFunction;
  vtkSmartPointer<vtkImplicitFunction> ObstacleFunction;
  double TargetIsoValue = 0.0;
  vtkTypeBool InvertTarget = 0;
  vtkTypeBool NormalizeTarget = 1;
  double TargetReach = -1.0;
  double MeshThickness = 0.0;
  int ParticleModel = ANISOTROPIC;
  double ParticleSpacing = -1.0;
  double KernelRadius = -1.0;
  double Anisotropy = 4.0;
  int ParticleKernel = WYVILL;
  double ParticleThreshold = 0.5;
  double PeriodicBounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  double VoxelSize = -1.0;
  double ModelBounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  vtkTypeBool BoundedDomain = 0;
  double Attraction = -1.0;
  double Tension = -1.0;
  vtkTypeBool TensionWeighting = 1;
  double TargetNoise = -1.0;
  double Transport = 1.0;
  vtkTypeBool CreateParts = 1;
  int EvolutionMode = TRANSIENT;
  double RestTolerance = 1e-3;
  int MaximumNumberOfSubsteps = 10000;
  int TimeIntegration = AUTOMATIC;
  double CFL = 1.0;
  int TargetEvaluation = SHIFTED;
  int GradientScheme = UPWIND;
  vtkTypeBool PaperScheme = 0;
  int VolumeControl = NONE;
  double VolumeStiffness = 1.0;
  double TargetVolume = 0.0;
  int AreaControl = NONE;
  double AreaStiffness = 1.0;
  double TargetArea = 0.0;
  double TimeScale = 1.0;
  double ArrivalTime = 0.0;
  double StartTime = 0.0;
  double TimeStepSize = 0.1;
  int NumberOfTimeSteps = 11;
  vtkTypeBool ComputeNormals = 1;
  vtkTypeBool ComputeVelocity = 0;
  vtkTypeBool TangentialVelocity = 1;
  double MaximumVelocity = 0.0;
  vtkTypeBool ComputeCurvature = 0;
  vtkTypeBool PassTargetArrays = 0;
  vtkTypeBool OutputPotential = 0;
  int CheckpointInterval = 1;
  int CheckpointMemory = 256;
  vtkIdType MaximumNumberOfActiveVoxels = 50000000;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

  std::unique_ptr<activesurface::SurfaceRequests> Requests;
};

#endif
