// The particles of one step of the input.

#ifndef ParticleFrame_h
#define ParticleFrame_h

#include "ParticleFit.h"
#include "Targets/ParticleList.h"

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

// What is known of the particles besides their positions; may be null.
struct PointArrays
{
  vtkAbstractArray* Radii = nullptr;
  vtkAbstractArray* Ids = nullptr;
  vtkAbstractArray* Strengths = nullptr;
  vtkAbstractArray* Velocities = nullptr;
  vtkPointData* Passed = nullptr; // all that the skin may be asked to have too
};

// All particles of a frame of which each rank has a part.
struct WholeFrame
{
  std::size_t Points = 0;
  std::size_t Particles = 0; // points that can be used
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

struct ParticleFrame
{
  ParticleList Particles;
  std::vector<std::int64_t> Ids; // from the array, else point numbers in the whole input
  bool HasIds = false;           // from the array
  bool HasRadii = false;         // from the array, else to be given by GiveRadius
  double ReachPerRadius = 1.0;   // of the array: particles have their reaches, see UseRadii
  bool HasVelocities = false;    // from an array
  mutable bool HasFits = false;
  std::size_t Ignored = 0;       // points left out: not finite, or without a size
  std::vector<vtkIdType> Points; // of the input, which the particles are; empty: all, in order
  mutable ParticleFits Fits;     // of the particles, once they were found, see ParticleTrack.h
  std::vector<std::array<double, 3>> Velocities; // of the particles, if there are
  vtkSmartPointer<vtkPointData> Passed; // of the input's points, a copy; null if not wanted
  std::optional<WholeFrame> Whole;      // of which this is a part; then all have one radius

  std::size_t CountAllPoints() const
  {
    return this->Whole ? this->Whole->Points : this->Particles.size() + this->Ignored;
  }
  std::size_t CountAllParticles() const
  {
    return this->Whole ? this->Whole->Particles : this->Particles.size();
  }
  // Without the points of all ranks.
  WholeFrame Describe() const;

  vtkIdType GetPoint(std::size_t particle) const
  {
    return this->Points.empty() ? static_cast<vtkIdType>(particle) : this->Points[particle];
  }

  // The reach of each.
  void GiveRadius(double radius);
  // The reaches that belong to the radii of the array, which are those of balls.
  void UseRadii(double reachPerRadius);

  // To other positions, which fits are to be found for again.
  void MoveBy(const double offset[3]);

  // The box of the supports of all; false without particles.
  bool GetBounds(double bounds[6]) const;
};

// Throws std::invalid_argument for arrays that cannot be radii, ids or strengths of the points.
ParticleFrame ReadParticles(vtkPointSet* points, const PointArrays& arrays);

}

#endif
