/**
 * @class   vtkActiveImplicitSurface
 * @brief   a surface that follows a target through time and keeps its state
 *
 * The surface (skin) is the zero set of a potential phi, negative inside, stored on the lattice
 * nodes near it. It moves along its normal (see vtkActiveMotionAlgorithm), splits and merges. See
 * Desbrun and Cani-Gascuel, Active Implicit Surface for Animation, Graphics Interface 1998.
 *
 * Input, port 0 (optional): the target; else TargetFunction.
 * - Particles: a vtkPointSet without cells or with vertices. All points are used, as points of a
 *   vtkSkeletonPotential. vtkActiveParticleAlgorithm has the surface of particles.
 *   SetInputArrayToProcess(0, ...) chooses an array of radii (of balls and tubes), (1, ...) of ids,
 *   (2, ...) of strengths. Without them KernelRadius, the point numbers and 1 are used. Or a
 *   vtkTable with the columns x, y, z (Points:0, Points:1, Points:2; pos_x ...), whose other
 *   columns are its arrays. Or blocks of particles (vtkMultiBlockDataSet, vtkPartitionedDataSet,
 *   ...): all points in the order of the blocks, with the arrays that all blocks have. A single
 *   block with points may be of any kind.
 * - Skeleton: a vtkPolyData with lines, as for vtkSkeletonPotential, with the same arrays.
 * - Mesh: a closed vtkPolyData of polygons or strips without lines (open ones: see MeshThickness).
 *   F is the distance to the mesh, from a vtkGridPotential.
 * - Image: a vtkImageData, whose values are F: its active point scalars, or the array chosen by (3,
 *   ...). Inside is below TargetIsoValue (InvertTarget: above; see there for masks), and within the
 *   image's box.
 *
 * With time steps, all of one kind, the target moves. Particles move in straight lines from step to
 * step. They are matched by ids (equal ids in order of position). Without ids they are matched by
 * index if both steps have the same number of particles in the same order, else not at all. A
 * particle that is missing in the next step fades out during the interval: its strength falls
 * linearly to 0. A new particle fades in. Skeletons, meshes and images are blended: F = (1 - f) F0
 * + f F1 at a fraction f of the interval. Parts that do not overlap from step to step shrink and
 * grow (see CreateParts; skeletons vanish). A step without points, or a mesh without cells, has no
 * target: the skin shrinks towards it, and vanishes.
 *
 * Input, port 1 (optional): Initial, the shape at the first time, instead of InitialFunction: a
 * mesh or an image as above, or a single block, at its first time step; (4, ...) chooses the array.
 *
 * Output, port 0: the skin, a vtkPolyData of triangles, closed, outward, with Normals. Port 1: the
 * potential as a vtkImageData with the scalars "Potential", a signed distance [length], negative
 * inside. It is accurate within about 1.5 voxels, and clamped to +-3 voxels. Its extent covers
 * ModelBounds, in lattice nodes; the image is cropped there, but the skin is not. Without
 * ModelBounds it covers the first target, enlarged by a quarter. That extent is available before
 * the first update only if port 1 is connected. Port 2: the history, a vtkTable with a row for each
 * time step so far. The columns are Time [pipeline time], Substeps and MaxSpeed (of the attraction
 * [length/time]) since the row before, Area, Volume, ActiveVoxels, Components, Voids and
 * EulerCharacteristic of the skin, Outside, and Event. Event lists changes of the skin's parts
 * since the row before, joined by ", ": "merge", "split", "vanish", "birth", "void opens", "void
 * closes", "hole opens", "hole closes". With EvolutionMode EQUILIBRIUM it is "at rest", "at rest
 * but for x %" (which oscillate), or "not at rest". Outside is the fraction of the target outside
 * the skin, in [0,1]. Particles, and points of a skeleton, are counted if they are outside by more
 * than their own radius. Other targets are measured by volume: the inside in the target's box (a
 * function's: ModelBounds) that is outside by more than a voxel. A fraction of 1 % is accurate to
 * 0.16 %. Points beyond walls are ignored. Above 1 %, unless it falls from step to step, there is
 * one warning. The first of several pieces has the whole skin and history; the image is split.
 *
 * Time: the time steps of the input are passed on. If it has fewer than two (TargetFunction, static
 * particles), StartTime + i * TimeStepSize are published. The surface starts at the first of them.
 * A later time continues from the current state, and reads the input once for each step in between.
 * The same time again costs nothing. An earlier time continues from the nearest earlier checkpoint
 * (CheckpointInterval). A time between two steps branches off the earlier step. A time before the
 * first step or after the last, or within rounding of a step, is that step. The result depends only
 * on the time and the properties, bit by bit, not on the order of requests, the number of threads
 * or of ranks. The motion restarts when the target, the initial shape or a property that shapes it
 * changes. Data without time steps that replace other data restart the motion. In situ it
 * continues: an input whose list of time steps has grown is read for the new steps only. If no time
 * can be requested twice (NO_PRIOR_TEMPORAL_ACCESS, VTK 9.4), the steps are the requested times.
 * Advance adds single frames.
 *
 * A vanished skin is valid: empty output and one warning. Errors empty the outputs. The next update
 * continues from the last finished substep.
 */

#ifndef vtkActiveImplicitSurface_h
#define vtkActiveImplicitSurface_h

#include "vtkActiveParticleAlgorithm.h"
#include "vtkActiveSurfacesModule.h" // for the export macro
#include "vtkSmartPointer.h"         // for the functions

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

class VTKACTIVESURFACES_EXPORT vtkActiveImplicitSurface : public vtkActiveParticleAlgorithm
{
public:
  static vtkActiveImplicitSurface* New();
  vtkTypeMacro(vtkActiveImplicitSurface, vtkActiveParticleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Target, negative inside, instead of an input: any implicit function. All threads evaluate
   * functions that only read their own data (vtkSphere, vtkBox, vtkPlane, vtkPlanes, vtkCylinder,
   * vtkCone, vtkQuadric, vtkSuperquadric, vtkSkeletonPotential, vtkGridPotential;
   * vtkImplicitBoolean of such) without a transform; else one thread does. Restarts the motion.
   * Default: none.
   */
  virtual void SetTargetFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetTargetFunction();
  ///@}

  ///@{
  /**
   * Shape of the skin at the first time, negative inside, closed within a voxel of ModelBounds. Not
   * together with input port 1. Restarts the motion. Default: none, the skin starts on the input of
   * port 1, or else on the target, as it is at the first time.
   */
  virtual void SetInitialFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetInitialFunction();
  ///@}

  ///@{
  /**
   * Obstacle that the skin may not enter, negative inside: a rock (a vtkSphere), a container's wall
   * (the function of its inside with the sign inverted, as by a vtkImplicitBoolean). The skin ends
   * on the obstacle, closed, whatever moves the skin. The obstacle is sampled once at lattice
   * nodes, as F / |grad F|, where the skin comes within 8 voxels. Obstacles thinner than two voxels
   * leak. The obstacle is static: a change, of its transform too, restarts the motion. It is not
   * part of a saved state, so set it again. Threads as for TargetFunction. Default: none.
   */
  virtual void SetObstacleFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetObstacleFunction();
  ///@}

  ///@{
  /**
   * Level of the target that attracts the skin [unit of the target's values]; of images at port 1
   * too. Range: finite. Default: 0, which for masks (images of two values, none negative) or
   * fractions of volume (0 to 1, most of them 0 or 1) is the level between, with the inside above.
   */
  vtkSetMacro(TargetIsoValue, double);
  vtkGetMacro(TargetIsoValue, double);
  ///@}

  ///@{
  /**
   * Puts the inside above TargetIsoValue; for images at port 1 too. Default: off, below.
   */
  vtkSetMacro(InvertTarget, vtkTypeBool);
  vtkGetMacro(InvertTarget, vtkTypeBool);
  vtkBooleanMacro(InvertTarget, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Attracts by the distance (F - TargetIsoValue) / |grad F|, clamped to +-TargetReach, instead of
   * F - TargetIsoValue. Attraction is then a rate for any scale of the target. Where the target is
   * flat, the skin moves at constant speed. Off: the speed is as uneven as F, and steep targets
   * cost many small substeps. Default: on.
   */
  vtkSetMacro(NormalizeTarget, vtkTypeBool);
  vtkGetMacro(NormalizeTarget, vtkTypeBool);
  vtkBooleanMacro(NormalizeTarget, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Distance [length] from the target beyond which the attraction is constant: the largest speed is
   * Attraction * TargetReach. Larger values move distant skins faster, for more substeps.
   * Range: >= 0; 0 is 3 ParticleSpacing over particles whose spacing is known, else an eighth of
   * the bounds' diagonal. Default: 0.
   */
  vtkSetClampMacro(TargetReach, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetReach, double);
  ///@}

  ///@{
  /**
   * Spacing of the lattice nodes [length]: the smallest detail that the skin can show. Nodes are at
   * its multiples. Half the size needs 4 times the memory, 8 (with Tension 16) times the time.
   * Range: >= 0; 1e-30 to 1e30, or 0, which is half of ParticleSpacing over particles (also of the
   * estimated one, unless ParticleModel is SUM or ModelBounds are set), else a 64th of the bounds'
   * longest side, over images at most a pixel (the smallest spacing) or a 1000th. Default: 0.
   */
  vtkSetClampMacro(VoxelSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * Box (xmin, xmax, ymin, ymax, zmin, zmax) [length] in which the initial shape is sampled, one
   * evaluation for each lattice node, and which the potential's image covers. The skin may leave
   * the box later. Range: finite, min < max on each axis, or unset. Default: unset (1, -1, 1, -1,
   * 1, -1), the box of the first target and the initial shape (inputs, vtkSkeletonPotential and
   * vtkGridPotential have one), enlarged by an eighth of its longest side, with images two voxels.
   */
  vtkSetVector6Macro(ModelBounds, double);
  vtkGetVector6Macro(ModelBounds, double);
  ///@}

  ///@{
  /**
   * Keeps the skin within ModelBounds: the target is cut off at the faces of that box, and the skin
   * ends on them, closed. Range: on or off. Default: off.
   */
  vtkSetMacro(BoundedDomain, vtkTypeBool);
  vtkGetMacro(BoundedDomain, vtkTypeBool);
  vtkBooleanMacro(BoundedDomain, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Thickness [length] of the shell that an input mesh with open edges becomes; a closed mesh stays
   * a solid. Below about two voxels the shell has holes. Range: >= 0, at most 1e30. Default: 0, no
   * shell: holes are closed from rim to rim, by winding numbers, with a warning.
   */
  vtkSetClampMacro(MeshThickness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MeshThickness, double);
  ///@}

  ///@{
  /**
   * Adds outward unit normals of the potential to the skin, the point array "Normals".
   * Does not restart the motion. Default: on.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds the point array "Velocity" [length/time]: the normal velocity by the equation of motion
   * and, over particles, their velocity along the skin (TangentialVelocity). Valid through splits
   * and merges. Costs an evaluation of the target. Does not restart the motion. Default: off.
   */
  vtkSetMacro(ComputeVelocity, vtkTypeBool);
  vtkGetMacro(ComputeVelocity, vtkTypeBool);
  vtkBooleanMacro(ComputeVelocity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Largest length [length/time] of the vectors of "Velocity"; longer vectors lose part of their
   * component along the normal. A skin that catches up, as in the notch of two parts that have just
   * merged, moves at up to Attraction * TargetReach, which blurs into streaks. Range: >= 0; 0 is
   * the speed of the fastest particle that is in both steps, its radius' change included (or by
   * SetInputArrayToProcess(5, ...) with TangentialVelocity), over the interval since the step
   * before (at the first step, to the next one); no bound if none moves, or for other targets. Does
   * not restart the motion. Default: 0.
   */
  vtkSetClampMacro(MaximumVelocity, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumVelocity, double);
  ///@}

  ///@{
  /**
   * Adds the point array "MeanCurvature" [1/length] to the skin: the sum of the principal
   * curvatures. The sum is 2/r on a ball of radius r, negative where the skin is concave, and at
   * most 4 per voxel. Does not restart the motion. Default: off.
   */
  vtkSetMacro(ComputeCurvature, vtkTypeBool);
  vtkGetMacro(ComputeCurvature, vtkTypeBool);
  vtkBooleanMacro(ComputeCurvature, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Makes the potential's image, output port 1, with each skin, so that GetPotential() has it after
   * Update(); Update(1) always makes it. The image needs 4 bytes for each lattice node in the
   * bounds. Does not restart the motion. Default: off.
   */
  vtkSetMacro(OutputPotential, vtkTypeBool);
  vtkGetMacro(OutputPotential, vtkTypeBool);
  vtkBooleanMacro(OutputPotential, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Ranks that compute one skin, and update, save and load together. Each provides a piece of the
   * inputs and outputs a part of the skin. Restarts the motion. Default: VTK's global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * Save or load the state of the skin as a .vdb file with metadata. SaveState saves the last time
   * step up to the time of the last update. LoadState loads it into a filter with the same
   * properties and inputs. Any time from that of the state on then continues from there, bitwise
   * identically. Return false, with an error, if there is no state, or reading or writing fails.
   */
  bool SaveState(const char* file);
  bool LoadState(const char* file);
  ///@}

  /**
   * For a simulation's own loop: moves the skin to the next frame, dt [pipeline time] after the
   * last one. The result is bitwise identical to that over the finished series. The frame becomes
   * the input of port 0; it may be the same object with new contents. The first frame is at
   * StartTime, whatever its dt. GetOutput() is at the newest frame, whatever time is requested. A
   * property that restarts the motion restarts it at that frame. Velocities do not use the next
   * frame. Returns false, with an error, if there is no skin. A refused frame changes nothing. A
   * frame at which the motion stopped before its end (an abort, MaximumNumberOfActiveVoxels)
   * counts: Update() or the next frame resumes. Range of dt: > 0, finite.
   */
  bool Advance(vtkDataObject* frame, double dt);

  /** Restarts the motion: at the next update, or at StartTime with the next Advance. */
  void ResetTrajectory();

  /** Sets the paper's choices: PaperScheme on, SHIFTED, CENTRAL, NormalizeTarget off, SUM. */
  void PaperFaithful();

  ///@{
  /** Numbers of target evaluations and substeps since the start or ResetCounters. */
  vtkIdType GetTargetEvaluations();
  vtkIdType GetSubsteps();
  void ResetCounters();
  ///@}

  ///@{
  /**
   * Actual values where a property leaves the choice to the filter, in the units of the properties.
   * 0 if there is none, and before the first update has read the inputs.
   */
  double GetVoxelSizeInUse();
  double GetParticleSpacingInUse();
  double GetAttractionInUse();
  double GetTensionInUse();
  ///@}

  /** The skin. */
  vtkPolyData* GetOutput();

  /** The potential's image; empty unless it was requested, see OutputPotential. */
  vtkImageData* GetPotential();

  /** One row for each time step up to the skin, see above. */
  vtkTable* GetHistory();

  /**
   * The skin as an implicit function: a vtkGridPotential that any thread may evaluate in constant
   * time. It is trilinear and has the correct sign everywhere. It is a first-order distance
   * [length] within about 1.5 voxels of the skin, clamped to +-3 voxels. The object is always the
   * same, with the new skin after each update. It is outside everywhere before the first update and
   * after an error. As the target of another surface it restarts that one with each change: to
   * follow a moving skin, connect its output port instead.
   */
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
  vtkSmartPointer<vtkMultiProcessController> Controller;
  double TargetIsoValue = 0.0;
  vtkTypeBool InvertTarget = 0;
  vtkTypeBool NormalizeTarget = 1;
  double TargetReach = 0.0;
  double VoxelSize = 0.0;
  vtkTypeBool BoundedDomain = 0;
  double ModelBounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  double MeshThickness = 0.0;
  vtkTypeBool ComputeNormals = 1;
  vtkTypeBool ComputeVelocity = 0;
  double MaximumVelocity = 0.0;
  vtkTypeBool ComputeCurvature = 0;
  vtkTypeBool OutputPotential = 0;

  std::unique_ptr<activesurface::SurfaceRequests> Requests;
};

#endif
