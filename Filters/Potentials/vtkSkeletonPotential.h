/**
 * @class vtkSkeletonPotential
 * @brief sum of compact kernels around points and line segments, as an implicit function
 *
 * F(x) = Threshold - sum over elements of strength * W(distance to the element / radius),
 *
 * negative inside, as all implicit functions of VTK; the sum and its gradient are exact, and cost
 * a time that depends on the number of supports around x, not on that of elements. With q =
 * distance / radius, the kernel W falls from W(0) = 1 to W(q >= 1) = 0:
 *
 *     WYVILL        (1 - q^2)^3
 *     CUBIC_SPLINE  1 - 6 q^2 + 6 q^3 (q <= 1/2),  2 (1 - q)^3 (q > 1/2)
 *     METABALL      1 - 3 q^2 (q <= 1/3),  3/2 (1 - q)^2 (q > 1/3)
 *
 * The surface F = 0 of an isolated element is not at its radius, which is where its influence ends,
 * but where W(q) = Threshold / strength. At the defaults (Threshold 0.5, strength 1) that is at
 * 0.4542 (WYVILL), 0.3611 (CUBIC_SPLINE) or 0.4226 (METABALL) of the radius.
 *
 * Elements, from the input:
 * - segments: each piece of the lines and polylines of a vtkPolyData. Radius and strength run
 *   linearly between the two ends and are taken at the point of the segment that is closest to x.
 *   Where they change, the gradient jumps across the planes through the ends.
 *   A piece that occurs twice counts once.
 * - points: every point that is the end of no segment, and every point of a vertex cell. Without
 *   lines, and in any other vtkPointSet, these are all points, whatever the cells.
 *
 * A vtkTable and composite data sets are points too, through SetInputConnection, as
 * vtkActiveImplicitSurface takes them.
 *
 * Joints do not bulge. Where m segments share a point, its own contribution, which each of them
 * includes, is taken off m - 1 times. A straight line thus has the same potential however it is
 * cut; a bent one, or a branching, is rounded on the inner side of the bend and equal to a single
 * segment elsewhere. Only a shared point id makes a joint, not equal coordinates. To thicken a
 * joint, give its point a vertex cell.
 *
 * Particles as a body of fluid. ParticleModel AVERAGED_CENTRE and ANISOTROPIC look at what is
 * around each point, and fit it so that a lone point is a ball of its own radius r, half of
 * ParticleSpacing, and the surface of a body passes r outside of its outermost points: a layer is a
 * plane, N points in a box have a volume of about N (2 r)^3. Points alone, as lines are sums; those
 * of strength <= 0 are left out. Kernel and Threshold are those of SUM; F is 0 on the surface and,
 * with AVERAGED_CENTRE, a length. With x_i the points around x and c, r' the means of their
 * positions and fitted radii, weighted by (1 - q^2)^2:
 *
 *     AVERAGED_CENTRE  F(x) = |x - c| - g r'
 *     ANISOTROPIC      F(x) = 1/2 - sum of s_i (1 - q_i^2)^3, q_i = |G_i (x - c_i)|
 *
 * g goes from 1 to -1 far from all points, where c would make bridges between parts (a remedy for
 * the fault that Solenthaler, Schlaefli and Pajarola 2007 describe). Sources: Zhu, Bridson 2005;
 * Yu, Turk 2013.
 *
 * Bad input. Elements with a coordinate, radius or strength that is not finite (or above 1e100), or
 * with a radius <= 0 (or below 1e-100), are ignored: GetNumberOfIgnoredElements(), and one warning
 * when the input is read. A named array that is missing or has not one number per point is an
 * error; F is then Threshold everywhere, as it is without input or elements. Where x is not
 * finite, F and its gradient are NaN.
 *
 * Threads. Evaluation may be called by several threads at once, as long as none modifies the
 * function or its input. The result has the same bits for any number of threads, through whichever
 * method, as contributions are always added in the same order: points, then joints, by point id,
 * then segments by cell.
 */

#ifndef vtkSkeletonPotential_h
#define vtkSkeletonPotential_h

#include "vtkActivePotentialsModule.h" // For export macro
#include "vtkImplicitFunction.h"

#include <memory> // For Internals
#include <string> // For names of arrays

class vtkAlgorithmOutput;
class vtkPointSet;

class VTKACTIVEPOTENTIALS_EXPORT vtkSkeletonPotential : public vtkImplicitFunction
{
public:
  static vtkSkeletonPotential* New();
  vtkTypeMacro(vtkSkeletonPotential, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum KernelType
  {
    WYVILL = 0,
    CUBIC_SPLINE = 1,
    METABALL = 2
  };

  enum ParticleModelType
  {
    SUM = 0,
    AVERAGED_CENTRE = 1,
    ANISOTROPIC = 2
  };

  ///@{
  /**
   * Points and segments, see above. They are read at the first evaluation after a change of the
   * data set, its points or its arrays (of their MTime). Default: none, F is Threshold everywhere.
   */
  void SetInput(vtkPointSet* input);
  vtkPointSet* GetInput();
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
   * Distance [length] at which the influence of an element ends, where no array says it.
   * Range: >= 0; 1e-100 to 1e100, else all elements are ignored, with a warning. Default: 1.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Name of the point array of radii [length], one number > 0 per point, in place of Radius.
   * Radii may differ by any factor; each halving met costs a share of an evaluation.
   * Default: empty, none.
   */
  void SetRadiusArrayName(const char* name);
  const char* GetRadiusArrayName() const { return this->RadiusArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Name of the point array of strengths [1], one number per point; negative ones carve. Range of
   * the numbers: -1e100 to 1e100. Default: empty, all elements have strength 1.
   */
  void SetStrengthArrayName(const char* name);
  const char* GetStrengthArrayName() const { return this->StrengthArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * How influence falls off with distance: WYVILL (0), twice differentiable, the cheapest;
   * CUBIC_SPLINE (1), the kernel of SPH, narrower; METABALL (2). Default: WYVILL.
   */
  vtkSetClampMacro(Kernel, int, WYVILL, METABALL);
  vtkGetMacro(Kernel, int);
  void SetKernelToWyvill() { this->SetKernel(WYVILL); }
  void SetKernelToCubicSpline() { this->SetKernel(CUBIC_SPLINE); }
  void SetKernelToMetaball() { this->SetKernel(METABALL); }
  ///@}

  ///@{
  /**
   * Sum of influences [1] on the surface F = 0, and the value of F away from all elements: lower is
   * thicker. Range: > 0; else all space would be inside, which is an error. Default: 0.5.
   */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /**
   * How points make a surface: SUM (0), of Kernel; AVERAGED_CENTRE (1), flat where the points are a
   * body of fluid, a ball of its own radius where one is alone; ANISOTROPIC (2), kernels that are
   * stretched along their neighbourhood, which keeps thin sheets and edges sharp, at a higher cost.
   * With lines only SUM is possible, else an error. Default: SUM.
   */
  vtkSetClampMacro(ParticleModel, int, SUM, ANISOTROPIC);
  vtkGetMacro(ParticleModel, int);
  void SetParticleModelToSum() { this->SetParticleModel(SUM); }
  void SetParticleModelToAveragedCentre() { this->SetParticleModel(AVERAGED_CENTRE); }
  void SetParticleModelToAnisotropic() { this->SetParticleModel(ANISOTROPIC); }
  ///@}

  ///@{
  /**
   * Usual distance of neighbours [length], twice a point's own radius; of no use to SUM.
   * Range: >= 0; 1e-100 to 1e100, or 0 for 1 / 3 (AVERAGED_CENTRE) or 1 / 2.25 (ANISOTROPIC) of a
   * point's Radius. Default: 0.
   */
  vtkSetClampMacro(ParticleSpacing, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ParticleSpacing, double);
  ///@}

  ///@{
  /**
   * Largest ratio of a kernel's axes [1], of ANISOTROPIC: 1 for balls. Range: 1 to 100. Default: 4.
   */
  vtkSetClampMacro(Anisotropy, double, 1.0, 100.0);
  vtkGetMacro(Anisotropy, double);
  ///@}

  /**
   * Box of all influence [length]: points and ends of segments, enlarged by their radii. F is
   * Threshold outside. False, and uninitialized bounds, without elements. Reads the input.
   */
  bool GetSkeletonBounds(double bounds[6]);

  /**
   * Number of points and segments left out because of a number of theirs. Reads the input.
   */
  vtkIdType GetNumberOfIgnoredElements();

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
   * Exact gradient of F, without the transform; 0 away from all elements.
   */
  void EvaluateGradient(double x[3], double g[3]) override;

  /**
   * F, and its gradients unless that is null, at `count` points (x y z each), without the
   * transform. As of the last Build(), in the calling thread.
   */
  VTK_WRAPEXCLUDE void EvaluateBatch(
    vtkIdType count, const double* points, double* values, double* gradients) const;

  /**
   * Point elements in place of an input, which is let go: x y z each, and radii and strengths
   * unless null (Radius, 1). Copied; without allocation where there have been as many before, here
   * and in the next Build(). For moving particles: elements are ignored without a warning.
   */
  VTK_WRAPEXCLUDE void SetElements(
    vtkIdType count, const double* positions, const double* radii, const double* strengths);

protected:
  vtkSkeletonPotential();
  ~vtkSkeletonPotential() override;

private:
  vtkSkeletonPotential(const vtkSkeletonPotential&) = delete;
  void operator=(const vtkSkeletonPotential&) = delete;

  void SetName(std::string& member, const char* name);
  void ReadElements();
  void FitBody();
  vtkIdType AddOwnElements();

  double Radius = 1.0;
  double Threshold = 0.5;
  int Kernel = WYVILL;
  int ParticleModel = SUM;
  double ParticleSpacing = 0.0;
  double Anisotropy = 4.0;
  std::string RadiusArrayName;
  std::string StrengthArrayName;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
