// Particles of one step of the input.

#ifndef ParticleFrame_h
#define ParticleFrame_h

#include "Frames/ParticleList.h"

#include "vtkActiveParticlesModule.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

class vtkAbstractArray;
class vtkPointSet;

namespace activesurface
{

// Arrays of the input points; each may be null.
struct PointArrays
{
  vtkAbstractArray* Radii = nullptr;
  vtkAbstractArray* Ids = nullptr;
  vtkAbstractArray* Strengths = nullptr;
  vtkAbstractArray* Velocities = nullptr;
  vtkPointData* Passed = nullptr; // all arrays that the skin may show
};

// Totals of a distributed frame over all ranks or, from Describe, over one rank.
struct WholeFrame
{
  std::size_t Points = 0;
  std::size_t Particles = 0; // usable points
  double Low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  double High[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL }; // box of the particles' positions

  void Add(const WholeFrame& other)
  {
    this->Particles += other.Particles;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      this->High[axis] = std::max(this->High[axis], other.High[axis]);
    }
  }
};

struct VTKACTIVEPARTICLES_EXPORT ParticleFrame
{
  ParticleList Particles;
  std::vector<std::int64_t> Ids; // from the id array, else point indices in the whole input
  bool HasIds = false;           // true if Ids are from the id array
  bool HasRadii = false;         // true if radii are from an array; otherwise call GiveRadius
  double ReachPerRadius = 1.0;   // support radius / radius in the array, see UseRadii
  bool HasVelocities = false;    // true if Velocities are from an array
  std::size_t Ignored = 0;       // omitted points, see SkeletonVertex::IsUsable
  std::vector<vtkIdType> Points; // input point of each particle; empty: all, in order
  std::vector<std::array<double, 3>> Velocities; // of each particle, if HasVelocities
  vtkSmartPointer<vtkPointData> Passed; // copy of the input's point arrays; null if not wanted
  std::optional<WholeFrame> Whole; // only of a distributed frame, whose particles have one radius

  std::size_t CountAllPoints() const
  {
    return this->Whole ? this->Whole->Points : this->Particles.size() + this->Ignored;
  }
  std::size_t CountAllParticles() const
  {
    return this->Whole ? this->Whole->Particles : this->Particles.size();
  }
  // Returns this rank's particle count and box. Points is 0.
  WholeFrame Describe() const;

  vtkIdType GetPoint(std::size_t particle) const
  {
    return this->Points.empty() ? static_cast<vtkIdType>(particle) : this->Points[particle];
  }

  // Reorders particles, ids and velocities: the particle order[i] gets the index i.
  void Permute(const std::vector<std::size_t>& order);

  // Sets the support radius of all particles.
  void GiveRadius(double radius);
  // Converts the array's radii to support radii. reachPerRadius: support radius / radius.
  void UseRadii(double reachPerRadius);

  // Adds an offset to all positions.
  void MoveBy(const double offset[3]);

  // Computes the box of the supports of the particles of all ranks. Returns false without
  // particles.
  bool GetBounds(double bounds[6]) const;
};

// Reads the usable points, in the order of ParticleOrder.h. Throws std::invalid_argument for arrays
// that cannot be radii, ids, strengths or velocities of the points.
VTKACTIVEPARTICLES_EXPORT ParticleFrame ReadParticles(
  vtkPointSet* points, const PointArrays& arrays);

}

#endif
