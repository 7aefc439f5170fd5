// The particles of one step of the input.

#ifndef ParticleFrame_h
#define ParticleFrame_h

#include "ParticleFit.h"
#include "Skeleton.h"
#include "Targets/SharedFits.h"

#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkAbstractArray;
class vtkPointSet;

namespace activesurface
{

// What is known of the particles besides their positions; may be null.
struct PointArrays
{
  vtkAbstractArray* Radii = nullptr;
  vtkAbstractArray* Ids = nullptr;
  vtkAbstractArray* Strengths = nullptr;
  vtkAbstractArray* Velocities = nullptr;
  vtkPointData* Passed = nullptr; // all that the skin may be asked to have too
};

struct ParticleFrame
{
  std::vector<SkeletonVertex> Particles;
  std::vector<std::int64_t> Ids; // of the particles: from the array, else their point numbers
  bool HasIds = false;           // from the array
  bool HasRadii = false;         // from the array, else to be given by GiveRadius
  std::size_t Ignored = 0;       // points left out: not finite, or without a size
  std::vector<vtkIdType> Points; // of the input, which the particles are; empty without Passed
  ParticleFits Fits;             // of the particles; empty until they are asked for
  std::shared_ptr<const SharedFits> Shared; // in their place where ranks share them
  std::vector<double> Velocities;           // of the particles, x y z each; empty without an array
  vtkSmartPointer<vtkPointData> Passed;     // of the input's points, a copy; null if not wanted

  bool HasFits() const { return this->Shared || !this->Fits.empty(); }
  // ranks: those that have the same frame, or null. Throws as FitParticles.
  void FindFits(const FitOptions& options, Agreement* ranks);

  void GiveRadius(double radius);

  // The box of all supports; false without particles.
  bool GetBounds(double bounds[6]) const;

  // Median distance of a particle to its third nearest, among about a thousand of them: the cube
  // root of the volume per particle within 14 %, for lattices as for random points, where the
  // nearest is at .55 of it, and for sheets. 0 if no two particles have different positions.
  double GetSpacing() const;
};

// Throws std::invalid_argument for arrays that cannot be radii, ids or strengths of the points.
ParticleFrame ReadParticles(vtkPointSet* points, const PointArrays& arrays);

}

#endif
