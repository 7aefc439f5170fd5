/**
 * @class vtkGridPotential
 * @brief an image, or the distance to a mesh, as an implicit function
 *
 * F(x) is interpolated trilinearly between samples on a lattice; the gradient is the exact
 * derivative of the interpolation. F is negative inside, as all implicit functions of VTK.
 *
 * @par Samples
 * - Image: the point scalars of a vtkImageData, of any type and one component. F = sample -
 *   IsoValue, or IsoValue - sample with InvertInside. Origin, spacing, extent and direction matrix
 *   are used. Beyond the image's box F is the distance to the box [length], so a body that reaches
 *   the faces is closed there. F is NaN in lattice cells with a sample of value NaN.
 * - Level set: the voxels of a sparse level set that a vtkImageData carries in place of arrays
 *   (vtkActiveVDBReader with OutputDense off). F is that of an image of these voxels. Beyond the
 *   band all voxels have the background value, + or -, so F is constant there, with gradient 0.
 * - Mesh: the signed distance [length] to the polygons and strips of a vtkPolyData, on a lattice
 *   through the origin with voxels of VoxelSize, within Reach of the mesh. Beyond, F is +-Reach
 *   with gradient 0. A closed mesh bounds a solid, whichever way its polygons are turned.
 *   Overlapping bodies are united, and voids within a body are filled. Parts thinner than a voxel
 *   may be missed.
 *
 * @par Meshes with defects
 * - Points of equal coordinates are merged.
 * - GetDefects() reports edges of only one polygon (the mesh is open), edges of more than two
 *   polygons, and omitted polygons. A polygon is omitted if a point is not finite (or above 1e100)
 *   or does not exist, or if fewer than three points differ. A warning is issued once when the mesh
 *   is read.
 * - A mesh is closed if each edge belongs to an even number of polygons: closed bodies may touch
 *   along an edge.
 * - A mesh that is not closed becomes a shell if MeshThickness > 0: F is the unsigned distance -
 *   MeshThickness / 2. Otherwise the mesh is treated as a solid: points whose generalized winding
 *   number exceeds 0.51 in magnitude are inside. A cap from rim to rim then closes each hole.
 * - Treated as a solid, a sheet has no inside. The inside is undefined if neighbouring polygons are
 *   turned to different sides.
 *
 * @par Errors
 * - Bad input is an error, issued once when the input is read and returned by GetError(). F is then
 *   1 everywhere (outside) with gradient 0, as without input.
 * - Unusable inputs: other classes of data, empty or flat images (of one pixel along an axis),
 *   arrays that are missing or have several components, axes that are not orthogonal, meshes
 *   without valid polygons, and lattices that are too large.
 * - With usable input, F and its gradient are NaN if x is not finite.
 *
 * @par Threads
 * - Several threads may evaluate at once, as long as none modifies the function or its input.
 * - The result is bitwise identical for any number of threads and for every method.
 */

#ifndef vtkGridPotential_h
#define vtkGridPotential_h

#include "vtkActiveShapesModule.h" // For export macro
#include "vtkImplicitFunction.h"

#include <memory> // For Internals
#include <string> // For names of arrays

class vtkAlgorithmOutput;
class vtkDataSet;

namespace activesurface
{
class GridSamples;
class LatticeParts;
struct SurfacePoints;
}

class VTKACTIVESHAPES_EXPORT vtkGridPotential : public vtkImplicitFunction
{
public:
  static vtkGridPotential* New();
  vtkTypeMacro(vtkGridPotential, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A vtkImageData, or a vtkPolyData with polygons or strips. The input is read at the first
   * evaluation after a change of the input (its MTime) or of a property. The pixels of an image are
   * not copied. Default: none, F is 1 everywhere.
   */
  void SetInput(vtkDataSet* input);
  vtkDataSet* GetInput();
  ///@}

  ///@{
  /**
   * The output of an algorithm in place of a data set, as within ParaView. The algorithm is updated
   * at the first evaluation, and again after GetMTime() (which filters call when they update) has
   * found a change upstream. The update uses the time of the last request. Default: none.
   */
  void SetInputConnection(vtkAlgorithmOutput* output);
  vtkAlgorithmOutput* GetInputConnection();
  ///@}

  ///@{
  /**
   * Image: name of the point array of samples, one number per pixel. Default: empty, the active
   * scalars or, without them, the first array of one component.
   */
  void SetScalarArrayName(const char* name);
  const char* GetScalarArrayName() const { return this->ScalarArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Image: value of the samples on the surface F = 0 [unit of the image]. Range: finite. Default:
   * 0.
   */
  vtkSetMacro(IsoValue, double);
  vtkGetMacro(IsoValue, double);
  ///@}

  ///@{
  /**
   * Image: makes values above IsoValue the inside, as in a scan of matter. Off: values below
   * IsoValue are inside, as in a distance. Default: off.
   */
  vtkSetMacro(InvertInside, vtkTypeBool);
  vtkGetMacro(InvertInside, vtkTypeBool);
  vtkBooleanMacro(InvertInside, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Mesh: spacing of the samples [length]. Memory and time of reading grow as 1 / VoxelSize^3, or
   * as 1 / VoxelSize^2 if Reach is a fixed number of voxels. Range: > 0, or -1, automatic: the
   * longest side of the mesh's bounds / 64. Default: -1.
   */
  vtkSetClampMacro(VoxelSize, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * Mesh: largest computed distance [length]; beyond, F is +-Reach. Memory and time of reading grow
   * about linearly with Reach. Values below three voxels are replaced by three voxels. Range: > 0,
   * or -1, automatic: an eighth of the diagonal of the mesh's bounds. Default: -1.
   */
  vtkSetClampMacro(Reach, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * Mesh: thickness [length] of the shell made from a mesh that is not closed (an edge belongs to
   * an odd number of polygons). A closed mesh stays a solid. A shell below about two voxels has
   * holes. Range: >= 0. Default: 0, no shell.
   */
  vtkSetClampMacro(MeshThickness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MeshThickness, double);
  ///@}

  ///@{
  /**
   * Mesh: memory limit. A mesh is an error if its distances need more voxels than this number, as
   * estimated from the mesh, VoxelSize, Reach and MeshThickness. A voxel needs about 10 bytes while
   * reading, about 20 if Reach is three voxels. Range: >= 1. Default: 500000000.
   */
  vtkSetClampMacro(MaximumNumberOfVoxels, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfVoxels, vtkIdType);
  ///@}

  /**
   * Box of the image, of the mesh or its shell, or of the active voxels of a level set [length].
   * Outside the box F is not negative, except within a voxel of a level set's box, everywhere if a
   * level set's background is inside, and where caps across the holes of several open bodies extend
   * beyond the box of a mesh. Returns false, with uninitialized bounds, without usable input. Reads
   * the input.
   */
  bool GetGridBounds(double bounds[6]);

  /**
   * Defects of the mesh as a sentence with counts; empty if there are none. Reads the input.
   */
  const char* GetDefects();

  /**
   * Error of the last reading, or a missing input, as a sentence; empty if there was none. Reads
   * the input.
   */
  const char* GetError();

  /**
   * Time of the last change of the function, its transform or its input.
   */
  vtkMTimeType GetMTime() override;

  /**
   * Read the input if a property or the input has changed since the last reading. Changes upstream
   * of a connected algorithm count if GetMTime() has found them. Call Build before EvaluateBatch;
   * the other evaluations call Build themselves.
   */
  void Build();

  ///@{
  /**
   * F, without the transform. The version for arrays reads points of three components, runs in
   * parallel and resizes its output.
   */
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override;
  void EvaluateFunction(vtkDataArray* input, vtkDataArray* output) override;
  ///@}

  /**
   * Gradient of F, without the transform: the exact derivative of the interpolation; 0 where F is
   * constant.
   */
  void EvaluateGradient(double x[3], double g[3]) override;

  /**
   * F at `count` points (x y z each), and its gradients unless `gradients` is null, without the
   * transform. Uses the state of the last Build(), in the calling thread.
   */
  VTK_WRAPEXCLUDE void EvaluateBatch(
    vtkIdType count, const double* points, double* values, double* gradients) const;

  /**
   * Set samples in place of an input, which is released. The properties do not apply to samples.
   */
  VTK_WRAPEXCLUDE void SetSamples(std::shared_ptr<const activesurface::GridSamples> samples);

  /**
   * Fraction of the surface's area, 0 to 1, that belongs to parts thinner than `thickness`, from
   * some thousand points of the surface. Returns 0 if the fraction is unavailable: without usable
   * input, for an open mesh without a shell, and for a level set that an image carries. Reads the
   * input.
   */
  VTK_WRAPEXCLUDE double FindThinShare(double thickness);

  /**
   * The connected parts and the voids of the region F < `level`, without the transform; null if
   * unavailable. The result for the last level is cached. Reads the input.
   */
  VTK_WRAPEXCLUDE std::shared_ptr<const activesurface::LatticeParts> FindParts(double level);

  /**
   * Points near the surface F = `level`, without the transform; none if unavailable. Reads the
   * input.
   */
  VTK_WRAPEXCLUDE activesurface::SurfacePoints FindSurface(double level);

  ///@{
  /**
   * Issue a warning for defects of the mesh and an error for bad input. If off, only GetDefects()
   * and GetError() report them. Default: true.
   */
  VTK_WRAPEXCLUDE void SetWarnOfDefects(bool warn) { this->WarnOfDefects = warn; }
  VTK_WRAPEXCLUDE void SetReportErrors(bool report) { this->ReportErrors = report; }
  ///@}

protected:
  vtkGridPotential();
  ~vtkGridPotential() override;

private:
  vtkGridPotential(const vtkGridPotential&) = delete;
  void operator=(const vtkGridPotential&) = delete;

  void ReadSamples();
  std::shared_ptr<const activesurface::GridSamples> MakeSamples();

  double IsoValue = 0.0;
  double VoxelSize = -1.0;
  double Reach = -1.0;
  double MeshThickness = 0.0;
  vtkIdType MaximumNumberOfVoxels = 500000000;
  vtkTypeBool InvertInside = 0;
  bool WarnOfDefects = true;
  bool ReportErrors = true;
  std::string ScalarArrayName;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
