// Particles between two time steps of the input (ParticleMatches.h).

#ifndef ParticleTrack_h
#define ParticleTrack_h

#include "Frames/ParticleMatches.h"
#include "ParticleNodes.h"

#include "vtkActiveParticlesModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace activesurface
{

// Particles at a fraction in [0,1] of the interval between two steps, interpolated on request. At
// 0, or without a later step: the particles of the earlier step. Otherwise: the particles of the
// earlier step, then the particles that only the later step has, in the order of each step.
// Particles whose strength has faded to zero are omitted. In a periodic box each particle is
// replaced by its copies in the box and in the margin (PeriodicBox::GetMargin).
class VTKACTIVEPARTICLES_EXPORT ParticleTrack final : public NodeParticles
{
public:
  // The caller owns the frames. later and matches may both be null. Throws std::invalid_argument if
  // a side of the periodic box is shorter than a quarter of PeriodicBox::GetMargin. For a track
  // that begins at the later of two steps, exchange the frames, invert the matches, and set a
  // duration < 0.
  ParticleTrack(const ParticleFrame& earlier, const ParticleFrame* later,
    std::shared_ptr<const ParticleMatches> matches, const PeriodicBox& box, double fraction);

  const ParticleFrame& GetEarlier() const { return *this->Earlier; }
  const ParticleFrame* GetLater() const { return this->Later; }
  double GetFraction() const { return this->Fraction; }

  std::size_t Size() const override { return this->Count; }
  SkeletonVertex Get(std::size_t n) const override;
  ParticleOrigin GetOrigin(std::size_t n) const
  {
    return this->OriginOf(this->Copies.empty() ? this->KeptAt(n) : this->Copies[n].Particle);
  }

  // Replaces the contents of the lists by the particles and their indices in the frames.
  void List(std::vector<SkeletonVertex>& particles) const;
  void List(std::vector<SkeletonVertex>& particles, std::vector<ParticleOrigin>& origins) const;

  // Sets the duration from step to step for FindVelocity [pipeline time * TimeScale]. At 0,
  // FindVelocity returns false.
  void SetDuration(double duration) { this->Duration = duration; }
  bool FindVelocity(std::size_t n, double (&velocity)[3]) const override;
  // Returns the velocity x y z of each particle, NaN where unknown: interpolated from the frames if
  // a frame has velocities, otherwise by FindVelocity.
  std::vector<double> ListVelocities() const;

  // Interpolates a value linearly; a particle in only one step keeps the value of that step.
  double Interpolate(double earlier, double later, const ParticleOrigin& origin) const;

private:
  // n: index among all particles, including faded ones.
  ParticleOrigin OriginOf(std::size_t n) const;
  SkeletonVertex Place(const ParticleOrigin& origin) const;
  SkeletonVertex Between(const ParticleOrigin& origin) const;
  std::size_t KeptAt(std::size_t n) const { return this->Kept.empty() ? n : this->Kept[n]; }
  void ListKept(std::size_t all);
  void ListCopies();
  void CheckBox(double margin) const;

  struct Copy
  {
    std::uint32_t Particle;        // index among all particles, including faded ones
    std::array<int, 3> BoxLengths; // displacement in lengths of the box
  };

  const ParticleFrame* Earlier;
  const ParticleFrame* Later;
  std::shared_ptr<const ParticleMatches> Matches;
  PeriodicBox Box;
  double Fraction;
  double Duration = 0.0;
  std::size_t Count = 0;
  std::vector<std::uint32_t> Kept; // empty if none has faded
  std::vector<Copy> Copies;        // empty without a periodic box
};

}

#endif
