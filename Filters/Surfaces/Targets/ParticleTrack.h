// The particles between two time steps of the input, see ParticleMatches.h.

#ifndef ParticleTrack_h
#define ParticleTrack_h

#include "ParticleNodes.h"
#include "Targets/ParticleMatches.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// The particles at a fraction in [0,1] of the time between two steps, each interpolated when it is
// asked for: at 0, and without a later step, those of the earlier step; else those of the earlier
// step in their order, then the births in theirs, without those that have faded to nothing. In a
// periodic box, in place of each one its copies in the box and the margin.
class ParticleTrack final : public NodeParticles
{
public:
  // All are the caller's. later, and so matches, may be null.
  ParticleTrack(const ParticleFrame& earlier, const ParticleFrame* later,
    const ParticleMatches* matches, const PeriodicBox& box, double fraction);

  const ParticleFrame& GetEarlier() const { return *this->Earlier; }
  const ParticleFrame* GetLater() const { return this->Later; }

  std::size_t Size() const override { return this->Count; }
  SkeletonVertex Get(std::size_t n) const override;
  ParticleOrigin GetOrigin(std::size_t n) const
  {
    return this->OriginOf(this->Copies.empty() ? this->KeptAt(n) : this->Copies[n].Particle);
  }

  // Replaces lists by the particles and their origins.
  void List(std::vector<SkeletonVertex>& particles, std::vector<ParticleOrigin>& origins) const;

  // Replaces fits by those of the particles; the frames' are found. One that fades shrinks with its
  // volume: a lone particle grows from nothing.
  void InterpolateFits(ParticleFits& fits) const;

  // Sets the duration from step to step [motion time], by which FindVelocity divides; at 0 it finds
  // no velocity.
  void SetDuration(double duration) { this->Duration = duration; }
  bool FindVelocity(std::size_t n, double (&velocity)[3]) const override;

  // The caller's, as long as the track is in use.
  void SetFits(const ParticleFits& fits) { this->Fits = &fits; }
  const ParticleFits& GetFits() const override { return *this->Fits; }

private:
  // n: of all, with those that have faded.
  ParticleOrigin OriginOf(std::size_t n) const;
  SkeletonVertex Place(const ParticleOrigin& origin) const;
  SkeletonVertex Between(const ParticleOrigin& origin) const;
  std::size_t KeptAt(std::size_t n) const { return this->Kept.empty() ? n : this->Kept[n]; }
  void ListKept(std::size_t all);
  void ListCopies();
  void CheckBox(double margin) const;

  struct Copy
  {
    std::uint32_t Particle;        // of all, with those that have faded
    std::array<int, 3> BoxLengths; // by which it is moved
  };

  const ParticleFrame* Earlier;
  const ParticleFrame* Later;
  const ParticleMatches* Matches;
  PeriodicBox Box;
  double Fraction;
  double Duration = 0.0;
  const ParticleFits* Fits;
  std::size_t Count = 0;
  std::vector<std::uint32_t> Kept; // empty if none has faded
  std::vector<Copy> Copies;        // empty without a periodic box
};

// Finds the fits of a frame's particles among their copies, once. Throws as FitParticles.
void FindFits(const ParticleFrame& frame, const FitOptions& options, const PeriodicBox& box);

struct PlacedParticles
{
  std::vector<SkeletonVertex> Particles;
  ParticleFits Fits; // of each, or empty
  std::vector<ParticleOrigin> Origins;
};

// Keeps the memory of what it writes to.
void PlaceParticles(const ParticleTrack& track, bool needsFits, PlacedParticles& placed);

}

#endif
