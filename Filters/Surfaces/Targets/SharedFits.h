// The fits of a step's particles where ranks share them: each rank keeps those at home.

#ifndef SharedFits_h
#define SharedFits_h

#include "ParticleFit.h"
#include "ParticleHomes.h"
#include "SharedResults.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace activesurface
{

// How far fits reach, in the particles' radii: no particle's has more.
struct FitBounds
{
  double Offset = 0.0;
  double Reach = 1.0;
  double Outward = 0.0;

  void Add(const SkeletonVertex& particle, const ParticleFit& fit);
  void Add(const FitBounds& other);
};

class SharedFits
{
public:
  // The particles are the same on all ranks. Rounds of ranks. Throws as FitParticles.
  SharedFits(
    Agreement& ranks, const FitOptions& options, const std::vector<SkeletonVertex>& particles);

  const ParticleHomes& GetHomes() const { return this->Homes; }

  // Of the particles at home, by ascending number.
  const ParticleFits& GetAtHome() const { return this->AtHome; }

  // Of the particles of all ranks.
  const FitBounds& GetBounds() const { return this->Bounds; }

  // Of particles by their numbers, what is known of them where they are at home: from there.
  // atHome: what is known here. Rounds of ranks.
  template <class Values>
  Values Fetch(const std::vector<SkeletonVertex>& particles,
    const std::vector<std::size_t>& numbers, const Values& atHome) const;

private:
  static constexpr std::size_t InRound = 65536; // so that messages take little memory

  // The most that a rank needs.
  std::size_t CountRounds(std::size_t ofOwn) const;
  template <class Values>
  void FetchRound(const std::vector<SkeletonVertex>& particles, const std::size_t* numbers,
    std::size_t count, const Values& atHome, Values& fetched) const;

  std::size_t FindHome(const SkeletonVertex& particle) const
  {
    return static_cast<std::size_t>(this->Homes.FindHome(particle.Position));
  }

  template <class Values>
  std::vector<typename Values::value_type> FindAtHome(
    const std::vector<std::size_t>& numbers, const Values& atHome) const
  {
    std::vector<typename Values::value_type> found;
    found.reserve(numbers.size());
    const std::vector<std::size_t>& all = this->Homes.GetNumbers();
    auto place = all.begin();
    for (const std::size_t number : numbers)
    {
      if (place == all.end() || *place != number) // else it is the next one, as most are
      {
        place = std::lower_bound(all.begin(), all.end(), number);
      }
      found.push_back(atHome[static_cast<std::size_t>(place++ - all.begin())]);
    }
    return found;
  }

  const ParticleHomes Homes;
  ParticleFits AtHome;
  FitBounds Bounds;
};

template <class Values>
Values SharedFits::Fetch(const std::vector<SkeletonVertex>& particles,
  const std::vector<std::size_t>& numbers, const Values& atHome) const
{
  Values fetched;
  fetched.reserve(numbers.size());
  const std::size_t rounds = this->CountRounds(numbers.size());
  for (std::size_t round = 0; round < rounds; ++round)
  {
    const std::size_t first = std::min(round * InRound, numbers.size());
    const std::size_t count = std::min(InRound, numbers.size() - first);
    this->FetchRound(particles, numbers.data() + first, count, atHome, fetched);
  }
  return fetched;
}

template <class Values>
void SharedFits::FetchRound(const std::vector<SkeletonVertex>& particles,
  const std::size_t* numbers, std::size_t count, const Values& atHome, Values& fetched) const
{
  using Value = typename Values::value_type;
  Agreement& ranks = this->Homes.GetRanks();
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  const auto own = static_cast<std::size_t>(ranks.GetRank());
  std::vector<std::vector<std::size_t>> asked(size);
  std::vector<std::size_t> homes;
  homes.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    homes.push_back(this->FindHome(particles[numbers[n]]));
    asked[homes.back()].push_back(numbers[n]);
  }
  std::vector<std::vector<Value>> answers;
  for (const std::vector<std::size_t>& ofRank : SwapLists(ranks, asked))
  {
    answers.push_back(this->FindAtHome(ofRank, atHome));
  }
  answers = SwapLists(ranks, answers);
  answers[own] = this->FindAtHome(asked[own], atHome);
  std::vector<std::size_t> next(size, 0);
  for (const std::size_t home : homes)
  {
    fetched.push_back(answers[home].at(next[home]++));
  }
}

}

#endif
