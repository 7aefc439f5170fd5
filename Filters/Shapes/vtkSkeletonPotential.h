/**
 * @class vtkSkeletonPotential
 * @brief sum of compact kernels around points and line segments, as an implicit function
 *
 * F is negative inside, as all implicit functions of VTK. With ParticleModel SUM, the default:
 *
 *     F(x) = Threshold - sum of strength * W(distance / radius)
 *
 * The sum over all elements (distance: from x to the element) and its gradient are exact. The cost
 * depends on the number of supports around x, not on the number of elements.
 *
 * @par Kernels, with q = distance / radius, W(0) = 1 and W(q >= 1) = 0
 *   | Kernel       | W               | W for larger q       | q0     |
 *   | ------------ | --------------- | -------------------- | ------ |
 *   | WYVILL       | (1-q^2)^3       |                      | 0.4542 |
 *   | CUBIC_SPLINE | 1 - 6q^2 + 6q^3 | 2 (1-q)^3, q > 1/2   | 0.3611 |
 *   | METABALL     | 1 - 3q^2        | 3/2 (1-q)^2, q > 1/3 | 0.4226 |
 *
 * The influence of an element ends at its radius. The surface F = 0 of an isolated element is where
 * W(q) = Threshold / strength: at q0 with the defaults (Threshold 0.5, strength 1).
 *
 * @par Elements
 * - Segments: each piece of the lines and polylines of a vtkPolyData. Radius and strength are those
 *   of the point of the segment closest to x, linear between the ends. If the radius or the
 *   strength changes along the segment, the gradient jumps across the planes through the ends. A
 *   piece that occurs twice counts once.
 * - Points: every point that is the end of no segment, and every point of a vertex cell. Without
 *   lines, and in any other vtkPointSet, all points are elements, whatever the cells.
 * - SetInputConnection also accepts a vtkTable and composite data sets of points, as
 *   vtkActiveImplicitSurface does.
 *
 * @par Joints
 * - Joints do not bulge: the contribution of a point shared by m segments, which each segment
 *   includes, is subtracted m - 1 times.
 * - A straight line has the same potential however it is cut. A bent line or a branching is rounded
 *   on the inner side of the bend and equal to a single segment elsewhere.
 * - Ends of segments that are equal in position, radius and strength are one point. To thicken a
 *   joint, give its point a vertex cell.
 *
 * @par Particles as a body of fluid: ParticleModel ANISOTROPIC
 * - An ellipsoid is fitted to the neighbourhood of each point (Yu, Turk 2013), as by
 *   vtkActiveImplicitSurface.
 * - F is computed in single precision, to about 1e-6.
 * - An isolated point is a ball of its own radius r: half of ParticleSpacing or, if automatic, the
 *   point's radius / 4.5.
 * - The surface of a body passes at about the distance r outside its outermost points: the surface
 *   over a flat layer is a plane, and N points in a box have a volume of about N (2 r)^3.
 * - Only points are possible; lines need SUM. Points of strength <= 0 add nothing. Kernel and
 *   Threshold apply only to SUM.
 *
 * With c_i the centre of an ellipsoid, G_i the matrix of its shape, s_i the strength of its point,
 * normalized by the neighbours, and the sum over all i with q_i < 1:
 *
 *     F(x) = 1/2 - 1/2 sum of s_i (1 - q_i^2)^3, q_i = |G_i (x - c_i)|
 *
 * @par Errors
 * - Elements are ignored if a coordinate, radius or strength is not finite (or above 1e100), a
 *   radius is <= 0 (or below 1e-100), or a point does not exist. GetNumberOfIgnoredElements()
 *   counts ignored elements. A warning is issued once when the input is read.
 * - After an error, such as a named array that is missing or does not have one number per point, F
 *   is 1/2 everywhere: all space is outside. Without input or elements F is Threshold (1/2 with
 *   ANISOTROPIC) everywhere.
 * - F and its gradient are NaN if x is not finite.
 *
 * @par Threads
 * - Several threads may evaluate at once, as long as none modifies the function or its input.
 * - The result is bitwise identical for any number of threads and for every method. With SUM,
 *   contributions are added in this order: points and then joints, each by point id, then segments
 *   by cell.
 */

#ifndef vtkSkeletonPotential_h
#define vtkSkeletonPotential_h

#include "vtkActiveShapesModule.h" // For export macro
#include "vtkImplicitFunction.h"

#include <memory> // For Internals
#include <string> // For names of arrays

class vtkAlgorithmOutput;
class vtkPointSet;

class VTKACTIVESHAPES_EXPORT vtkSkeletonPotential : public vtkImplicitFunction
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
    ANISOTROPIC = 1
  };

  ///@{
  /**
   * Points and line segments. The data set is read at the first evaluation after a change of the
   * data set, its points or its arrays (of their MTime). Default: none, F is Threshold (1/2 with
   * ANISOTROPIC) everywhere.
   */
  void SetInput(vtkPointSet* input);
  vtkPointSet* GetInput();
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
   * Distance [length] at which the influence of an element ends, unless an array of radii is
   * chosen. Range: >= 0; outside 1e-100 to 1e100 all elements are ignored, with a warning. Default:
   * 1.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Name of the point array of radii [length], one number > 0 per point, in place of Radius. Radii
   * may differ by any factor; each factor of two adds to the cost of an evaluation. Default: empty,
   * none.
   */
  void SetRadiusArrayName(const char* name);
  const char* GetRadiusArrayName() const { return this->RadiusArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Name of the point array of strengths [1], one number per point. Negative strengths reduce the
   * sum. Range of the numbers: -1e100 to 1e100. Default: empty, all elements have strength 1.
   */
  void SetStrengthArrayName(const char* name);
  const char* GetStrengthArrayName() const { return this->StrengthArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Kernel: decrease of influence with distance. WYVILL (0): twice differentiable, the cheapest.
   * CUBIC_SPLINE (1): the kernel of SPH, narrower. METABALL (2). Default: WYVILL.
   */
  vtkSetClampMacro(Kernel, int, WYVILL, METABALL);
  vtkGetMacro(Kernel, int);
  void SetKernelToWyvill() { this->SetKernel(WYVILL); }
  void SetKernelToCubicSpline() { this->SetKernel(CUBIC_SPLINE); }
  void SetKernelToMetaball() { this->SetKernel(METABALL); }
  ///@}

  ///@{
  /**
   * Sum of influences [1] on the surface F = 0, and the value of F away from all elements. Lower
   * values give thicker bodies. Range: > 0; else F would not be positive away from all elements,
   * which is an error. Default: 0.5.
   */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /**
   * Model of the surface of points. SUM (0): the sum of Kernel. ANISOTROPIC (1): flat for a body of
   * fluid, a ball of its own radius for an isolated point. Lines with ANISOTROPIC are an error.
   * Default: SUM.
   */
  vtkSetClampMacro(ParticleModel, int, SUM, ANISOTROPIC);
  vtkGetMacro(ParticleModel, int);
  void SetParticleModelToSum() { this->SetParticleModel(SUM); }
  void SetParticleModelToAnisotropic() { this->SetParticleModel(ANISOTROPIC); }
  ///@}

  ///@{
  /**
   * Distance of neighbouring points [length], twice a point's own radius; not used by SUM. Range:
   * 1e-100 to 1e100, or -1, automatic: each point's radius (Radius or array) / 2.25. Default: -1.
   */
  vtkSetClampMacro(ParticleSpacing, double, -1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ParticleSpacing, double);
  ///@}

  ///@{
  /**
   * Largest ratio of an ellipsoid's axes [1], with ANISOTROPIC. 1 makes balls. Range: 1 to 100.
   * Default: 4.
   */
  vtkSetClampMacro(Anisotropy, double, 1.0, 100.0);
  vtkGetMacro(Anisotropy, double);
  ///@}

  /**
   * Box of all influence [length]: points and ends of segments, enlarged by their radii, or the
   * ellipsoids of ANISOTROPIC. F is constant outside the box. Returns false, with uninitialized
   * bounds, without elements. Reads the input.
   */
  bool GetSkeletonBounds(double bounds[6]);

  /**
   * Number of points and segments that are ignored because of an unusable number or a missing
   * point. Reads the input.
   */
  vtkIdType GetNumberOfIgnoredElements();

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
   * Gradient of F, without the transform; 0 away from all elements.
   */
  void EvaluateGradient(double x[3], double g[3]) override;

  /**
   * F at `count` points (x y z each), and its gradients unless `gradients` is null, without the
   * transform. Uses the state of the last Build(), in the calling thread.
   */
  VTK_WRAPEXCLUDE void EvaluateBatch(
    vtkIdType count, const double* points, double* values, double* gradients) const;

  /**
   * Replace the input, which is released, by points, such as moving particles. positions: x y z
   * each. radii, strengths: null for Radius and 1. The data are copied. With SUM, SetElements and
   * the next Build() allocate no memory if an earlier call had at least as many points. Unusable
   * points are ignored without a warning.
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
  double ParticleSpacing = -1.0;
  double Anisotropy = 4.0;
  std::string RadiusArrayName;
  std::string StrengthArrayName;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
