/**
 * @class   vtkActiveParticleAlgorithm
 * @brief   how particles make the target of a vtkActiveImplicitSurface, as properties
 *
 * ParticleSpacing is the one number to know: it gives each particle its own radius r, half of it,
 * its reach, and, where they are not set, VoxelSize (r) and TargetReach (6 r). Changing a property
 * starts the skin anew, unless it says another thing.
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
   * How particles make a surface, as in vtkSkeletonPotential. SUM (0): a sum of ParticleKernel at
   * ParticleThreshold, the paper's, bumpy and more than r too wide at the defaults. AVERAGED_CENTRE
   * (1) and ANISOTROPIC (2) are flat where there is a body of particles, a ball of radius r where
   * one is alone, and have the particles' volume: ANISOTROPIC keeps sheets, threads and narrow gaps
   * sharper, at fewer particles in reach. Lines of a skeleton are always a SUM. PaperFaithful() in
   * Python chooses SUM. Default: ANISOTROPIC.
   */
  vtkSetClampMacro(ParticleModel, int, SUM, ANISOTROPIC);
  vtkGetMacro(ParticleModel, int);
  void SetParticleModelToSum() { this->SetParticleModel(SUM); }
  void SetParticleModelToAveragedCentre() { this->SetParticleModel(AVERAGED_CENTRE); }
  void SetParticleModelToAnisotropic() { this->SetParticleModel(ANISOTROPIC); }
  ///@}

  ///@{
  /**
   * Usual distance of neighbouring particles [length], 2 r: the side of the cube that a particle
   * fills. Range: >= 0; 1e-30 to 1e30, or 0, which is the median distance of a particle to its
   * third nearest, with a warning that says the value (or, where KernelRadius or an array of radii
   * is given, the spacing that belongs to it). It is the least of the first time step, of the one
   * in the middle and of the last, of those with a tenth of the most particles at least; these are
   * read when the skin starts. Of an input that cannot go back in time, it is that of the first
   * particles. Default: 0.
   */
  vtkSetClampMacro(ParticleSpacing, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ParticleSpacing, double);
  ///@}

  ///@{
  /**
   * Radius of the kernel of a particle, or of a line of a skeleton [length]: the distance at which
   * its influence ends, where no array of radii is chosen. Wider is smoother and slower. (An array
   * of radii holds those of balls and tubes, which the skin shows where nothing else is near:
   * kernels end at 4.5 (ANISOTROPIC) or 6 (AVERAGED_CENTRE) times that; with SUM they end where
   * they give this ball.) Range: >= 0; 1e-30 to 1e30, or 0, which is 2 (SUM, and lines), 3
   * (AVERAGED_CENTRE) or 2.25 (ANISOTROPIC) times ParticleSpacing. Default: 0.
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
   * How a particle's influence falls off with SUM, from vtkSkeletonPotential: WYVILL (0), smooth;
   * CUBIC_SPLINE (1), narrower, the one of SPH; METABALL (2). It also weighs the arrays that the
   * skin takes from the particles. Default: WYVILL.
   */
  vtkSetClampMacro(ParticleKernel, int, 0, 2);
  vtkGetMacro(ParticleKernel, int);
  void SetParticleKernelToWyvill();
  void SetParticleKernelToCubicSpline();
  void SetParticleKernelToMetaball();
  ///@}

  ///@{
  /**
   * Level of the particles' summed influence, 1 at the centre of a single one, at which their
   * surface is with SUM: lower is thicker. Range: > 0; else all space would be inside.
   * Default: 0.5.
   */
  vtkSetMacro(ParticleThreshold, double);
  vtkGetMacro(ParticleThreshold, double);
  ///@}

  ///@{
  /**
   * Periodic box (xmin, xmax, ymin, ymax, zmin, zmax) [length] of the particles, as of a simulation
   * of molecules. A particle that leaves it through a side comes in through the other one, wherever
   * the input lists it; between two time steps it takes the shortest path. The skin is closed at
   * the sides of the box. Range: finite; an axis with min >= max is not periodic.
   * Default: (1, -1, 1, -1, 1, -1), none is.
   */
  vtkSetVector6Macro(PeriodicBounds, double);
  vtkGetVector6Macro(PeriodicBounds, double);
  ///@}

  ///@{
  /**
   * Adds to "Velocity" its component along the skin, so that it is the whole motion, as motion
   * blur needs it: the particles' own velocity, averaged with their kernels' weights. It is read
   * from the array that SetInputArrayToProcess(5, ...) chooses, else from the particles'
   * displacement since the step before (at the first step, to the next one). Particles without
   * either do not count; without any, and for other targets, the component is 0. Off: the normal
   * velocity alone. Does not restart the motion. Default: on.
   */
  vtkSetMacro(TangentialVelocity, vtkTypeBool);
  vtkGetMacro(TangentialVelocity, vtkTypeBool);
  vtkBooleanMacro(TangentialVelocity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the skin has the point arrays of the particles under it: floating-point ones and
   * colours (unsigned char, 3 or 4 components, rounded, halves up) averaged with the kernels'
   * weights, others, such as ids and names, from the particle of the largest weight; where no
   * kernel reaches, from the nearest particle. Between two steps values go evenly from one to the
   * other. Left out: ghost levels, arrays called like one of the skin's own, without a value for
   * each point, or not alike at both steps. Does not restart the motion. Default: off.
   */
  vtkSetMacro(PassTargetArrays, vtkTypeBool);
  vtkGetMacro(PassTargetArrays, vtkTypeBool);
  vtkBooleanMacro(PassTargetArrays, vtkTypeBool);
  ///@}

  enum ParticleModelType
  {
    SUM = 0,
    AVERAGED_CENTRE = 1,
    ANISOTROPIC = 2
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
