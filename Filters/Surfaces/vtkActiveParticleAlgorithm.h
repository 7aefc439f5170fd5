/**
 * @class   vtkActiveParticleAlgorithm
 * @brief   the target of a vtkActiveImplicitSurface made by particles, as properties
 *
 * ParticleSpacing is the main property. It sets each particle's own radius r, half of the spacing,
 * its kernel radius and, where these are not set, VoxelSize (r) and TargetReach (6 r). Changing a
 * property restarts the motion, except where its comment says otherwise.
 */

#ifndef vtkActiveParticleAlgorithm_h
#define vtkActiveParticleAlgorithm_h

#include "vtkActiveMotionAlgorithm.h"
#include "vtkActiveSurfacesModule.h" // for the export macro

class VTKACTIVESURFACES_EXPORT vtkActiveParticleAlgorithm : public vtkActiveMotionAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkActiveParticleAlgorithm, vtkActiveMotionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Model of the surface of particles, as in vtkSkeletonPotential. SUM (0): a sum of ParticleKernel
   * at ParticleThreshold, the paper's, bumpy and more than r too wide at the defaults. ANISOTROPIC
   * (1), ellipsoids fitted to the neighbours, is flat for a body of particles and a ball of radius r
   * for an isolated one, and has the particles' volume. Lines of a skeleton are always a SUM.
   * PaperFaithful() in Python chooses SUM. Default: ANISOTROPIC.
   */
  vtkSetClampMacro(ParticleModel, int, SUM, ANISOTROPIC);
  vtkGetMacro(ParticleModel, int);
  void SetParticleModelToSum() { this->SetParticleModel(SUM); }
  void SetParticleModelToAnisotropic() { this->SetParticleModel(ANISOTROPIC); }
  ///@}

  ///@{
  /**
   * Usual distance of neighbouring particles [length], 2 r: the side of the cube that a particle
   * fills. Range: >= 0; 1e-30 to 1e30, or 0, which is the median distance of a particle to its
   * third nearest, with a warning that says the value (or, where KernelRadius or an array of radii
   * is given, the spacing that belongs to it). The estimate is the least of those of the first, the
   * middle and the last time step. Steps with less than a tenth of the largest number of particles
   * are ignored. These steps are read when the skin starts. If the input cannot go back in time,
   * the estimate is that of the first particles. Default: 0.
   */
  vtkSetClampMacro(ParticleSpacing, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ParticleSpacing, double);
  ///@}

  ///@{
  /**
   * Radius of the kernel of a particle, or of a line of a skeleton [length]: the distance at which
   * its influence ends, unless an array of radii is chosen. Larger values are smoother and slower.
   * (An array of radii has the radii of the balls and tubes that the skin shows for isolated
   * elements. Kernels end at 4.5 times that radius, with SUM where an isolated element gets that
   * radius.) Range: >= 0; 1e-30 to 1e30, or 0, which is 2 (SUM, and lines) or 2.25 (ANISOTROPIC)
   * times ParticleSpacing. Default: 0.
   */
  vtkSetClampMacro(KernelRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(KernelRadius, double);
  ///@}

  ///@{
  /**
   * Largest ratio of the axes of a particle's influence [1], with ANISOTROPIC: 1 for balls.
   * Range: 1 to 100. Default: 4.
   */
  vtkSetClampMacro(Anisotropy, double, 1.0, 100.0);
  vtkGetMacro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * Decrease of a particle's influence with distance, with SUM, from vtkSkeletonPotential: WYVILL
   * (0), smooth; CUBIC_SPLINE (1), narrower, the kernel of SPH; METABALL (2). It also weights the
   * arrays that the skin gets from the particles. Default: WYVILL.
   */
  vtkSetClampMacro(ParticleKernel, int, 0, 2);
  vtkGetMacro(ParticleKernel, int);
  void SetParticleKernelToWyvill();
  void SetParticleKernelToCubicSpline();
  void SetParticleKernelToMetaball();
  ///@}

  ///@{
  /**
   * Level of the particles' summed influence at which SUM places the surface: lower values give
   * thicker bodies. An isolated particle has an influence of 1 at its centre. Range: > 0; else all
   * space would be inside.
   * Default: 0.5.
   */
  vtkSetMacro(ParticleThreshold, double);
  vtkGetMacro(ParticleThreshold, double);
  ///@}

  ///@{
  /**
   * Periodic box (xmin, xmax, ymin, ymax, zmin, zmax) [length] of the particles, as of a simulation
   * of molecules. A particle that leaves the box through a side enters through the opposite side,
   * wherever the input lists it. Between two time steps it moves on the shortest path. The skin is
   * closed at the sides of the box. Range: finite; an axis with min >= max is not periodic.
   * Default: (1, -1, 1, -1, 1, -1), none is.
   */
  vtkSetVector6Macro(PeriodicBounds, double);
  vtkGetVector6Macro(PeriodicBounds, double);
  ///@}

  ///@{
  /**
   * Adds the tangential component to "Velocity", so that the array is the whole motion of the skin,
   * as motion blur needs. The component is the velocity of the particles, averaged with the weights
   * of their kernels. Velocities are read from the array that SetInputArrayToProcess(5, ...)
   * chooses, else found from the displacement since the previous step (at the first step, to the
   * next one). Particles with neither are ignored. The component is 0 if no particle has a
   * velocity, and for other targets. Off: only the normal velocity. Does not restart the motion.
   * Default: on.
   */
  vtkSetMacro(TangentialVelocity, vtkTypeBool);
  vtkGetMacro(TangentialVelocity, vtkTypeBool);
  vtkBooleanMacro(TangentialVelocity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Adds the point arrays of nearby particles to the skin. Floating-point arrays and colours
   * (unsigned char, 3 or 4 components, rounded, halves up) are averaged with the kernels' weights.
   * Others, such as ids and names, come from the particle of the largest weight. Points outside all
   * kernels use the nearest particle. Values are linear between two steps. Arrays are omitted if
   * they are ghost levels, have a name of the skin's own arrays, lack a value for a point, or are
   * not alike at both steps. Does not restart the motion. Default: off.
   */
  vtkSetMacro(PassTargetArrays, vtkTypeBool);
  vtkGetMacro(PassTargetArrays, vtkTypeBool);
  vtkBooleanMacro(PassTargetArrays, vtkTypeBool);
  ///@}

  enum ParticleModelType
  {
    SUM = 0,
    ANISOTROPIC = 1
  };

protected:
  vtkActiveParticleAlgorithm() = default;
  ~vtkActiveParticleAlgorithm() override = default;

private:
  vtkActiveParticleAlgorithm(const vtkActiveParticleAlgorithm&) = delete;
  void operator=(const vtkActiveParticleAlgorithm&) = delete;

  int ParticleModel = ANISOTROPIC;
  double PeriodicBounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  double ParticleSpacing = 0.0;
  double KernelRadius = 0.0;
  double Anisotropy = 4.0;
  int ParticleKernel = 0;
  double ParticleThreshold = 0.5;
  vtkTypeBool TangentialVelocity = 1;
  vtkTypeBool PassTargetArrays = 0;
};

#endif
