// The particles of one step of the input, and their way to those of the next.
//
// A particle moves in a straight line from one step to the next, and its radius and strength change
// evenly. Particles are matched by their ids, or by their index where there are none and the steps
// have equally many, else not at all. One without a partner in the next step dies: at a fraction f
// of the way it has 1 - f of its strength. One without a partner in the step before is born: it has
// f of its strength. So their sum is continuous in time, whatever the steps hold.

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

// Which particles of two steps are the same.
struct ParticleMatches
{
  static constexpr std::size_t NoPartner = static_cast<std::size_t>(-1);

  std::vector<std::size_t> Partners; // for each earlier one its place among the later, or NoPartner
  std::vector<std::size_t> Births;   // of the later ones, by ascending place
};

ParticleMatches MatchParticles(const ParticleFrame& earlier, const ParticleFrame& later);

// Replaces particles by those at a fraction in [0,1] of the way from the earlier step to the later:
// the earlier ones in their order, then the births in theirs, none that has faded to nothing.
void InterpolateParticles(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, double fraction, std::vector<SkeletonVertex>& particles);

}

#endif
