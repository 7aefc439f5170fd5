/**
 * @class vtkGridPotential
 * @brief an image, or the distance to a mesh, as an implicit function
 *
 * F(x) is interpolated trilinearly between samples on a lattice; the gradient is the exact one of
 * that interpolation. F is negative inside, as all implicit functions of VTK. The samples are
 *
 * - the point scalars of a vtkImageData, of any type and one component: F = sample - IsoValue, or
 *   IsoValue - sample with InvertInside. Origin, spacing, extent and direction matrix count. What
 * is not known is outside: beyond the image's box F is the distance to the box [length], so a body
 *   that reaches the faces is closed there. In voxels that touch a pixel of value NaN, F is NaN.
 * - the voxels of a sparse level set that a vtkImageData carries in place of arrays
 *   (vtkActiveVDBReader with OutputDense off), in the same way; beyond its band F is what the level
 *   set holds there, + or - a constant, with gradient 0.
 * - the signed distance [length] to the polygons and strips of a vtkPolyData, on a lattice through
 *   the origin with voxels of VoxelSize, within Reach of the mesh; +-Reach with gradient 0 beyond.
 *   A closed mesh bounds a solid, whichever way its polygons are turned. Bodies that overlap are
 *   united, and voids within a body are filled. What is thinner than a voxel may be missed.
 *
 * Meshes with defects. Points of equal coordinates count as one. GetDefects() tells the edges of
 * one polygon only (the mesh is open), those of more than two polygons, and the polygons that are
 * left out as a point of theirs is not finite or does not exist, or they have no area at all. There
 * is one warning when the mesh is read. A mesh is closed if each edge belongs to an even number of
 * polygons: closed bodies may touch along an edge. One that is not closed becomes a shell if
 * MeshThickness > 0: F is the unsigned distance - MeshThickness / 2. Else it is taken for a solid:
 * inside is where the mesh winds around by more than a half (generalized winding numbers), so that
 * a hole is closed by a cap from rim to rim. A sheet has no inside; nor is there one that makes
 * sense where neighbouring polygons are turned to different sides.
 *
 * Bad input is an error with a sentence, once when it is read, and GetError(). F is then 1
 * everywhere (outside) with gradient 0, as it is without input. Of no use are: other data sets,
 * flat images (of one pixel along an axis), arrays that are missing or of several components, axes
 * that are not orthogonal, meshes without polygons, and lattices too large.
 *
 * Threads. Evaluation may be called by several threads at once, as long as none modifies the
 * function or its input. The result has the same bits for any number of threads, through whichever
 * method. Where x is not finite, F and its gradient are NaN.
 */

#ifndef vtkGridPotential_h
#define vtkGridPotential_h

#include "vtkActivePotentialsModule.h" // For export macro
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

class VTKACTIVEPOTENTIALS_EXPORT vtkGridPotential : public vtkImplicitFunction
{
public:
  static vtkGridPotential* New();
  vtkTypeMacro(vtkGridPotential, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A vtkImageData, or a vtkPolyData with polygons or strips. It is read at the first evaluation
   * after a change (of its MTime). The pixels of an image are not copied. Default: none, F is 1
   * everywhere.
   */
  void SetInput(vtkDataSet* input);
  vtkDataSet* GetInput();
  ///@}

  ///@{
  /**
   * The output of an algorithm in place of a data set, as within ParaView. It is brought up to date
   * at the first evaluation, and again after GetMTime() (which filters ask for when they update)
   * has found a change upstream; at the time that it was last asked for. Default: none.
   */
  void SetInputConnection(vtkAlgorithmOutput* output);
  vtkAlgorithmOutput* GetInputConnection();
  ///@}

  ///@{
  /**
   * Image: name of the point array of samples, one number per pixel. Default: empty, the active
   * scalars, and without them the first array of one component.
   */
  void SetScalarArrayName(const char* name);
  const char* GetScalarArrayName() const { return this->ScalarArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Image: the sample on the surface F = 0 [unit of the image]. Range: finite. Default: 0.
   */
  vtkSetMacro(IsoValue, double);
  vtkGetMacro(IsoValue, double);
  ///@}

  ///@{
  /**
   * Image: whether inside is above IsoValue, as in a scan of matter, in place of below, as in a
   * distance. Default: off.
   */
  vtkSetMacro(InvertInside, vtkTypeBool);
  vtkGetMacro(InvertInside, vtkTypeBool);
  vtkBooleanMacro(InvertInside, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Mesh: distance of the samples [length]. Memory and time of reading grow with its inverse to the
   * third power, or to the second at a fixed number of voxels in Reach. Range: >= 0. Default: 0,
   * the longest side of the mesh's bounds / 64.
   */
  vtkSetClampMacro(VoxelSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * Mesh: how far from it distances are kept [length]; beyond, F is +-Reach. Memory and time of
   * reading are proportional to it. Less than three voxels count as three. Range: >= 0.
   * Default: 0, an eighth of the diagonal of the mesh's bounds.
   */
  vtkSetClampMacro(Reach, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * Mesh: thickness [length] of the shell that is made of a mesh that is not closed, as an edge
   * belongs to an odd number of polygons; a closed one is a solid all the same. Below about two
   * voxels the shell has holes.
   * Range: >= 0. Default: 0, no shell.
   */
  vtkSetClampMacro(MeshThickness, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MeshThickness, double);
  ///@}

  ///@{
  /**
   * Mesh: guard; the distances are refused, with an error, if they would need more voxels than this
   * by an estimate from where the mesh is and Reach. A voxel takes about 10 bytes while reading.
   * Range: >= 1. Default: 500000000.
   */
  vtkSetClampMacro(MaximumNumberOfVoxels, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfVoxels, vtkIdType);
  ///@}

  /**
   * Box outside which F is not negative [length]: that of the image, of the mesh or its shell, or
   * of the samples. False, and uninitialized bounds, if there is none. Reads the input.
   */
  bool GetGridBounds(double bounds[6]);

  /**
   * What is wrong with the mesh, a sentence with counts; empty if nothing is. Reads the input.
   */
  const char* GetDefects();

  /**
   * Why F is 1 everywhere, a sentence; empty if it is not. Reads the input.
   */
  const char* GetError();

  /**
   * Own changes, those of the transform and those of the input.
   */
  vtkMTimeType GetMTime() override;

  /**
   * Read the input if anything has changed since it was last read. All methods do so, except
   * EvaluateBatch.
   */
  void Build();

  ///@{
  /**
   * F, without the transform. The version for arrays takes three components, runs in parallel and
   * resizes its output.
   */
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override;
  void EvaluateFunction(vtkDataArray* input, vtkDataArray* output) override;
  ///@}

  /**
   * Gradient of F, without the transform: the exact one of the interpolation; 0 where F is
   * constant.
   */
  void EvaluateGradient(double x[3], double g[3]) override;

  /**
   * F, and its gradients unless that is null, at `count` points (x y z each), without the
   * transform. As of the last Build(), in the calling thread.
   */
  VTK_WRAPEXCLUDE void EvaluateBatch(
    vtkIdType count, const double* points, double* values, double* gradients) const;

  /**
   * Samples in place of an input, which is let go. None of the properties applies to them.
   */
  VTK_WRAPEXCLUDE void SetSamples(std::shared_ptr<const activesurface::GridSamples> samples);

  /**
   * Share of the surface's area, 0 to 1, of parts that are thinner than a length, from some
   * thousand points of it; 0 where that is not known: without input, of an open mesh that is no
   * shell, and of a level set that an image carries. Reads the input.
   */
  VTK_WRAPEXCLUDE double FindThinShare(double thickness);

  /**
   * The connected parts of what is below a level, and its hollows, without the transform; null if
   * they are not known. They are found once. Reads the input.
   */
  VTK_WRAPEXCLUDE std::shared_ptr<const activesurface::LatticeParts> FindParts(double level);

  /**
   * Places near the surface of that level, without the transform; none if they are not known. Reads
   * the input.
   */
  VTK_WRAPEXCLUDE activesurface::SurfacePoints FindSurface(double level);

  ///@{
  /**
   * Whether defects of the mesh are a warning, and bad input an error, or are only told by
   * GetDefects() and GetError(). Default: true.
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
  double VoxelSize = 0.0;
  double Reach = 0.0;
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
