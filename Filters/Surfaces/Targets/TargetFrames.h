// Two consecutive steps of the input at most, and the way between them.

#ifndef TargetFrames_h
#define TargetFrames_h

#include "Targets/InputShape.h"
#include "Targets/ParticleMatches.h"

#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

// What is to be known of particles besides where they are.
struct PlacedNeeds
{
  bool Fits = false;
  bool Velocities = false;
  double Duration = 0.0;      // of the way from the step to the next one [motion time]; 0: none
  bool LeavesNoise = false;   // velocities without their noise, see MotionNoise.h; needs fits
  Agreement* Ranks = nullptr; // that place the same particles together, or null
};

struct PlacedParticles
{
  std::vector<SkeletonVertex> Particles;
  ParticleFits Fits;              // of each, or empty
  std::vector<double> Velocities; // of each, x y z, NaN for unknown; or empty

  std::vector<ParticleOrigin> Origins; // kept for its memory
};

class TargetFrames
{
public:
  void Clear();

  // The step replaces itself, or else the elder of the two that are held.
  void Add(int step, std::shared_ptr<InputShape> shape);

  bool Has(int step) const { return this->Find(step) != nullptr; }

  // Null if the step is not held.
  InputShape* Find(int step) const;

  // Of the step's shape; no particles and null if it has none.
  const ParticleFrame& GetParticles(int step) const;
  vtkImplicitFunction* GetFunction(int step) const;

  // The particles at a fraction in [0,1] of the way from a step to the next one, see
  // ParticleMatches.h; those of the step itself, in their order, at 0 and as long as the next one
  // is not held.
  void PlaceParticles(
    int step, double fraction, const PlacedNeeds& needs, PlacedParticles& placed) const;

  // Of the particles of a step and those of the next one; null if not both are held.
  const ParticleMatches* FindMatches(int step) const;

  // What a user should know of how the steps were matched; empty if nothing.
  std::string DescribeMatches() const;

private:
  struct Held
  {
    int Step = -1;
    std::shared_ptr<InputShape> Shape;
  };

  const std::vector<double>& GetSharesOfMotion(Agreement* ranks) const;

  Held Earlier, Later;
  ParticleMatches Matches; // of Earlier and Later, if these are consecutive

  mutable std::vector<double> SharesOfMotion; // of the particles of Earlier; empty until asked for
};

}

#endif
