// The particles of one step of the input, and their way to those of the next.
//
// A particle moves in a straight line from one step to the next, and its radius and strength change
// evenly. Particles are matched by their ids, or by their index where there are none and the steps
// have equally many. A particle without a partner in the next step stays as it is until then; one
// without a partner in the step before is not there before its own step.

#ifndef ParticleFrame_h
#define ParticleFrame_h

#include "Skeleton.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkAbstractArray;
class vtkPointSet;

namespace activesurface
{

// What is known of the particles besides their positions; may be null.
struct ParticleArrays
{
  vtkAbstractArray* Radii = nullptr;
  vtkAbstractArray* Ids = nullptr;
  vtkAbstractArray* Strengths = nullptr;
};

struct ParticleFrame
{
  std::vector<SkeletonVertex> Particles;
  std::vector<std::int64_t> Ids; // of the particles: from the array, else their point numbers
  bool HasIds = false;           // from the array
  bool HasRadii = false;         // else to be given by GiveRadius
  std::size_t Ignored = 0;       // points left out: not finite, or without a size

  void GiveRadius(double radius);

  // The box of all supports; false without particles.
  bool GetBounds(double bounds[6]) const;

  // Median distance of a particle to its nearest neighbour, among about a thousand of them; 0 if no
  // two particles have different positions.
  double GetSpacing() const;
};

// Throws std::invalid_argument for arrays that cannot be radii, ids or strengths of the points.
ParticleFrame ReadParticles(vtkPointSet* points, const ParticleArrays& arrays);

// For each of the earlier particles its place among the later ones, or NoPartner.
constexpr std::size_t NoPartner = static_cast<std::size_t>(-1);
std::vector<std::size_t> FindPartners(const ParticleFrame& earlier, const ParticleFrame& later);

// Moves earlier particles on, by a fraction in [0,1] of their way to their partners.
void MoveToPartners(const ParticleFrame& later, const std::vector<std::size_t>& partners,
  double fraction, std::vector<SkeletonVertex>& particles);

}

#endif
