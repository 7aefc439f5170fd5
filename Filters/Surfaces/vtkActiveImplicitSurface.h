/**
 * @class   vtkActiveImplicitSurface
 * @brief   a living skin: a surface that follows a target through time and keeps its state
 *
 * The surface is the zero set of a potential phi, negative inside, stored on the lattice nodes near
 * it. It moves along its normal: attracted by a target, resisting curvature, holding its area or
 * volume; vtkActiveMotionAlgorithm has the speed and its properties. It splits and merges.
 * See Desbrun and Cani-Gascuel, Active Implicit Surface for Animation, Graphics Interface 1998.
 *
 * Input, port 0 (optional): the target; else TargetFunction.
 * - Particles: a vtkPointSet without cells or with vertices; all its points count, as points of a
 *   vtkSkeletonPotential. vtkActiveParticleAlgorithm has what they make. SetInputArrayToProcess(0,
 *   ...) chooses an array of radii (of balls and tubes), (1, ...) of ids, (2, ...) of strengths;
 * without them KernelRadius, the point numbers and 1 hold. Or a vtkTable with the columns x, y, z
 * (Points:0, Points:1, Points:2; pos_x ...), whose other columns are its arrays. Or blocks of
 * particles (vtkMultiBlockDataSet, vtkPartitionedDataSet, ...): all points in the order of the
 * blocks, with the arrays that all of these have. A single block with points may be of any kind.
 * - Skeleton: a vtkPolyData with lines, as vtkSkeletonPotential takes it, with the same arrays.
 * - Mesh: a closed vtkPolyData of polygons or strips without lines (open ones: see MeshThickness).
 *   F is the distance to it, as vtkGridPotential gives it.
 * - Image: a vtkImageData, whose values are F: its active point scalars, or the array chosen by
 *   (3, ...). Inside is below TargetIsoValue (InvertTarget: above; see there for masks), and within
 * the image's box.
 *
 * With time steps, all of one kind, the target moves. Particles go in straight lines from step to
 * step, matched by ids (equal ones by place), else by number if both steps have equally many, in
 * one order, else not at all. One that is missing in the next step fades out on the way, its
 * strength falling evenly to 0; a new one fades in. Skeletons, meshes and images are blended, F =
 * (1 - f) F0 + f F1 at a fraction f of the way: what does not overlap from step to step shrinks
 * here and grows there (see CreateParts; skeletons vanish). A step without points, or a mesh
 * without cells, is no target: the skin shrinks towards it, and vanishes.
 *
 * Input, port 1 (optional): Initial, the shape at the first time, instead of InitialFunction: a
 * mesh or an image as above, or a block alone, at its first time step; (4, ...) chooses the array.
 *
 * Output, port 0: the skin, a vtkPolyData of triangles, closed, outward, with Normals. Port 1: the
 * potential as a vtkImageData with the scalars "Potential", a signed distance [length], negative
 * inside, good within about 1.5 voxels, clamped to +-3 voxels. Its extent covers ModelBounds, in
 * lattice nodes; the image is cropped there, the skin never. Without ModelBounds it covers the
 * first target, enlarged by a quarter: known before the first update only if port 1 is connected.
 * Port 2: the history, a vtkTable with a row for each time step so far: Time [pipeline time],
 * Substeps and MaxSpeed (that the target gives [length/time]) since the row before, Area, Volume,
 * ActiveVoxels, Components, Voids and EulerCharacteristic of the skin, Outside, and Event, what has
 * happened to its parts since: "merge", "split", "vanish", "birth", "void opens", "void closes",
 * "hole opens", "hole closes", joined by ", "; with EvolutionMode EQUILIBRIUM instead "at rest",
 * "at rest but for x %" (which oscillate), or "not at rest". The first of several pieces holds all
 * of the skin and the history; the image is split. Outside is the share of the target that the skin
 * has lost, in [0,1]: of particles, and points of a skeleton, by number, those that are outside by
 * more than their own radius; of other targets by volume, what is outside by more than a voxel, of
 * the inside in the target's box (a function's: ModelBounds), to .16 % at 1 %. Beyond walls nothing
 * counts. Above 1 %, unless it falls from step to step, one warning says so.
 *
 * Time: the time steps of the input are passed on. If it has fewer than two (TargetFunction, static
 * particles), StartTime + i * TimeStepSize are published. The surface starts at the first of them.
 * A request for a later time continues from the state that is held, and the input is asked once for
 * each step in between; the same time again costs nothing; an earlier one continues from the
 * nearest checkpoint before it (CheckpointInterval). A time between two steps branches off the
 * earlier one. A time before the first step or after the last, or within rounding of a step, is
 * that step. The result depends on the time and the properties only, bit by bit, not on the order
 * of requests, the number of threads or of ranks. The motion restarts when the target, the initial
 * shape or a property that shapes it changes. In situ it continues: an input whose list of time
 * steps has grown at its end is the same input, and is asked for the new steps only; where no time
 * can be had twice (NO_PRIOR_TEMPORAL_ACCESS, VTK 9.4), the steps are the times asked for; Advance
 * takes frames one by one. Data without time steps that replace others restart the motion.
 *
 * A vanished skin is legal: empty output and one warning. Errors empty the outputs. The next update
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
   * Target, negative inside, instead of an input: any implicit function. Those of VTK that only
   * read themselves (vtkSphere, vtkBox, vtkPlane, vtkPlanes, vtkCylinder, vtkCone, vtkQuadric,
   * vtkSuperquadric, vtkSkeletonPotential, vtkGridPotential; vtkImplicitBoolean of such), without a
   * transform, are evaluated by all threads, others by one. Restarts the motion. Default: none.
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
   * What the skin may not enter, negative inside: a rock (a vtkSphere as it is), a container's wall
   * (the function of its inside with the sign turned round, as by a vtkImplicitBoolean). The skin
   * ends on it, closed, whatever moves it. It is known at the lattice's nodes from F / |grad F|,
   * sampled once where the skin comes within 8 voxels; thinner than two voxels it leaks. It stands
   * still: a change, of its transform too, restarts the motion. It is no part of a saved state, so
   * set it again. Threads as for TargetFunction. Default: none.
   */
  virtual void SetObstacleFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetObstacleFunction();
  ///@}

  ///@{
  /**
   * Level of the target that attracts the skin [unit of the target's values]; of images at port 1
   * too. Range: finite. Default: 0, which for an image that is a mask (of two values, none
   * negative) or has fractions of volume (0 to 1, most of them 0 or 1) is the level between, with
   * the inside above it.
   */
  vtkSetMacro(TargetIsoValue, double);
  vtkGetMacro(TargetIsoValue, double);
  ///@}

  ///@{
  /**
   * Whether the target's inside is where its values are above TargetIsoValue; of images at port 1
   * too. Default: off, below.
   */
  vtkSetMacro(InvertTarget, vtkTypeBool);
  vtkGetMacro(InvertTarget, vtkTypeBool);
  vtkBooleanMacro(InvertTarget, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the distance (F - TargetIsoValue) / |grad F|, clamped to +-TargetReach, attracts
   * instead of F - TargetIsoValue itself. Attraction then is a rate whatever the scale of the
   * target, and where the target is flat the skin goes at a constant speed. Off: the speed is as
   * uneven as F, and steep targets cost many small substeps. Default: on.
   */
  vtkSetMacro(NormalizeTarget, vtkTypeBool);
  vtkGetMacro(NormalizeTarget, vtkTypeBool);
  vtkBooleanMacro(NormalizeTarget, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Distance [length] from the target beyond which it attracts no faster: the largest speed is
   * Attraction * TargetReach. A larger one brings far skins sooner, for more substeps.
   * Range: >= 0; 0 is 3 ParticleSpacing over particles whose spacing is known, else an eighth of
   * the bounds' diagonal. Default: 0.
   */
  vtkSetClampMacro(TargetReach, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetReach, double);
  ///@}

  ///@{
  /**
   * Distance of the lattice nodes [length]: the smallest detail that the skin can show. Nodes are
   * at its multiples. Halving it takes 4 times the memory, 8 (with Tension 16) times the time.
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
   * evaluation for each lattice node, and which the potential's image covers; the skin may leave it
   * later. Range: finite, min < max on each axis, or unset. Default: unset (1, -1, 1, -1, 1, -1),
   * the box of the first target and the initial shape (inputs, vtkSkeletonPotential and
   * vtkGridPotential have one), enlarged by an eighth of its longest side, with images two voxels.
   */
  vtkSetVector6Macro(ModelBounds, double);
  vtkGetVector6Macro(ModelBounds, double);
  ///@}

  ///@{
  /**
   * Whether the skin may not leave ModelBounds: it comes to rest on the faces of that box, closed,
   * as the target is cut off there. Range: on or off. Default: off.
   */
  vtkSetMacro(BoundedDomain, vtkTypeBool);
  vtkGetMacro(BoundedDomain, vtkTypeBool);
  vtkBooleanMacro(BoundedDomain, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Thickness [length] of the shell that an input mesh with open edges becomes; a closed one stays
   * a solid. Below about two voxels the shell has holes. Range: >= 0, at most 1e30. Default: 0, no
   * shell: holes are closed from rim to rim, by winding numbers, with a warning.
   */
  vtkSetClampMacro(MeshThickness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MeshThickness, double);
  ///@}

  ///@{
  /**
   * Whether the skin has outward unit normals, the point array "Normals", from the potential.
   * Does not restart the motion. Default: on.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the skin has the point array "Velocity" [length/time]: its normal velocity by the
   * equation of motion and, over particles, their velocity along the skin (TangentialVelocity).
   * Right through splits and merges, as no points are followed. Costs an evaluation of the target.
   * Does not restart the motion. Default: off.
   */
  vtkSetMacro(ComputeVelocity, vtkTypeBool);
  vtkGetMacro(ComputeVelocity, vtkTypeBool);
  vtkBooleanMacro(ComputeVelocity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Largest length [length/time] of the vectors of "Velocity"; longer ones lose of their component
   * along the normal. Where the skin catches up, as in the notch of two parts that have just
   * merged, its own speed is up to Attraction * TargetReach, which blurs into streaks. Range: >= 0;
   * 0 is the speed of the fastest particle that is in both steps, its radius' change included (or
   * by SetInputArrayToProcess(5, ...) with TangentialVelocity), on the way from the step before (at
   * the first step, to the next one); no bound if none moves, or for other targets. Does not
   * restart the motion. Default: 0.
   */
  vtkSetClampMacro(MaximumVelocity, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumVelocity, double);
  ///@}

  ///@{
  /**
   * Whether the skin has the point array "MeanCurvature": the sum of the principal curvatures
   * [1/length], 2/r on a ball of radius r, negative in hollows, at most 4 per voxel. Does not
   * restart the motion. Default: off.
   */
  vtkSetMacro(ComputeCurvature, vtkTypeBool);
  vtkGetMacro(ComputeCurvature, vtkTypeBool);
  vtkBooleanMacro(ComputeCurvature, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the potential's image, output port 1, is made with each skin, so that GetPotential()
   * has it after Update(); Update(1) makes it in any case. It takes 4 bytes for each lattice node
   * in the bounds. Does not restart the motion. Default: off.
   */
  vtkSetMacro(OutputPotential, vtkTypeBool);
  vtkGetMacro(OutputPotential, vtkTypeBool);
  vtkBooleanMacro(OutputPotential, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The ranks that make one skin, and update, save and load together: each brings its piece of the
   * inputs and has its part of the skin. Restarts the motion. Default: VTK's global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * Saves the state of the skin at the last time step up to the time of the last update, as a .vdb
   * with metadata; and loads it into this or another filter with the same properties and inputs:
   * then any time from that of the state on continues from there, to the same bytes. False, and an
   * error, if there is no state, or the file cannot be read, or not be written as a whole.
   */
  bool SaveState(const char* file);
  bool LoadState(const char* file);
  ///@}

  /**
   * In a simulation's own loop: takes the skin to the next frame, dt [pipeline time] after the last
   * one; to the same bytes as over the finished series. The frame is what input port 0 takes, and
   * is its input from then on; it may be the same object, written over, each time. The first one is
   * at StartTime, whatever its dt. GetOutput() is at the newest frame, whatever time is asked for.
   * A property that restarts the motion restarts it there. Velocities do not know the frame to
   * come. False, and an error, if there is no skin. A frame that is refused is as if it had not
   * been; one to which the motion got only half-way (an abort, MaximumNumberOfActiveVoxels) counts:
   * Update() or the next frame goes on. Range of dt: > 0, finite.
   */
  bool Advance(vtkDataObject* frame, double dt);

  /** Forgets the motion so far: the next update starts anew, and the next Advance at StartTime. */
  void ResetTrajectory();

  /** The paper's choices: PaperScheme on, SHIFTED, CENTRAL, NormalizeTarget off, SUM. */
  void PaperFaithful();

  ///@{
  /** Points at which the target was evaluated, and substeps, since the start or ResetCounters. */
  vtkIdType GetTargetEvaluations();
  vtkIdType GetSubsteps();
  void ResetCounters();
  ///@}

  ///@{
  /**
   * What the skin was made with, where a property leaves it to the filter: units of the properties.
   * 0 where there is none, and as long as the inputs are not read: before the first update.
   */
  double GetVoxelSizeInUse();
  double GetParticleSpacingInUse();
  double GetAttractionInUse();
  double GetTensionInUse();
  ///@}

  /** The skin. */
  vtkPolyData* GetOutput();

  /** The potential's image; empty unless it was asked for, see OutputPotential. */
  vtkImageData* GetPotential();

  /** One row for each time step on the way to the skin, see above. */
  vtkTable* GetHistory();

  /**
   * The skin as an implicit function: a vtkGridPotential, which any thread may evaluate in a time
   * that does not depend on the size of the skin. Trilinear, of the right side everywhere, a
   * first-order distance [length] within about 1.5 voxels of the skin, clamped to +-3 voxels.
   * Always the same object, after each update that of the new skin; outside everywhere before the
   * first and after an error. As the target of another surface it restarts that one with each
   * change: to follow a moving skin, connect its output port instead.
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
