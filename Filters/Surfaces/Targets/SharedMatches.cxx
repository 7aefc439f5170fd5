#include "Targets/SharedMatches.h"

#include "SharedResults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace activesurface
{

namespace
{

// What the rank that looks after an id is told of a particle.
struct Entry
{
  std::int64_t Id;
  std::size_t Number;
  SkeletonVertex Particle;
};

// And what it tells who has the earlier one.
struct Partner
{
  std::size_t Number; // NoPartner: none
  SkeletonVertex Particle;
};

using Entries = std::vector<std::vector<Entry>>; // by rank

// Neighbouring ids go to all ranks alike.
std::size_t FindRankOf(std::int64_t id, std::size_t ranks)
{
  const std::uint64_t mixed = static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>((mixed ^ mixed >> 32) % ranks);
}

Entries ListEntries(const ParticleFrame& frame)
{
  Entries toEach(static_cast<std::size_t>(frame.Shared->Ranks.GetSize()));
  for (std::size_t i = 0; i < frame.Particles.size(); ++i)
  {
    toEach[FindRankOf(frame.Ids[i], toEach.size())].push_back(
      { frame.Ids[i], frame.Shared->Numbers[i], frame.Particles[i] });
  }
  return toEach;
}

// Where an entry is: of which rank, which of its.
struct Place
{
  const Entry* What;
  std::size_t Rank;
  std::size_t Number;
};

// By ascending id; equal ids in the order of the particles.
std::vector<Place> Sort(const Entries& entries)
{
  std::vector<Place> places;
  for (std::size_t rank = 0; rank < entries.size(); ++rank)
  {
    for (std::size_t n = 0; n < entries[rank].size(); ++n)
    {
      places.push_back({ &entries[rank][n], rank, n });
    }
  }
  std::sort(places.begin(), places.end(),
    [](const Place& a, const Place& b)
    { return std::pair(a.What->Id, a.What->Number) < std::pair(b.What->Id, b.What->Number); });
  return places;
}

// A value for each entry.
template <class Value>
std::vector<std::vector<Value>> MakeAnswers(const Entries& entries, const Value& value)
{
  std::vector<std::vector<Value>> answers;
  for (const std::vector<Entry>& ofRank : entries)
  {
    answers.emplace_back(ofRank.size(), value);
  }
  return answers;
}

// Answers to those that have asked, in the order in which they have their particles.
template <class Value>
std::vector<Value> Answer(const ParticleFrame& frame, std::vector<std::vector<Value>> answers)
{
  const std::vector<std::vector<Value>> fromEach =
    SwapLists(frame.Shared->Ranks, std::move(answers));
  std::vector<std::size_t> next(fromEach.size(), 0);
  std::vector<Value> told;
  told.reserve(frame.Particles.size());
  for (const std::int64_t id : frame.Ids)
  {
    const std::size_t rank = FindRankOf(id, fromEach.size());
    told.push_back(fromEach[rank][next[rank]++]);
  }
  return told;
}

struct Found
{
  std::vector<Partner> Partners; // of the earlier ones at home
  std::vector<char> AreBorn;     // of the later ones
};

Found MatchIds(const ParticleFrame& earlier, const ParticleFrame& later)
{
  const Entries from = SwapLists(earlier.Shared->Ranks, ListEntries(earlier));
  const Entries to = SwapLists(later.Shared->Ranks, ListEntries(later));
  auto partners = MakeAnswers(from, Partner{ NoPartner, {} });
  auto areBorn = MakeAnswers(to, char(1));
  const std::vector<Place> candidates = Sort(to);
  auto candidate = candidates.begin();
  for (const Place& place : Sort(from))
  {
    while (candidate != candidates.end() && candidate->What->Id < place.What->Id)
    {
      ++candidate;
    }
    if (candidate != candidates.end() && candidate->What->Id == place.What->Id)
    {
      partners[place.Rank][place.Number] = { candidate->What->Number, candidate->What->Particle };
      areBorn[candidate->Rank][candidate->Number] = 0;
      ++candidate;
    }
  }
  return { Answer(earlier, std::move(partners)), Answer(later, std::move(areBorn)) };
}

double FindDiagonal(const ParticleFrame& frame)
{
  std::array<double, 6> own = { HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL };
  const auto add = [](std::array<double, 6>& box, const double* low, const double* high, int stride)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      box[2 * axis] = std::min(box[2 * axis], low[stride * axis]);
      box[2 * axis + 1] = std::max(box[2 * axis + 1], high[stride * axis]);
    }
  };
  for (const SkeletonVertex& particle : frame.Particles)
  {
    add(own, particle.Position, particle.Position, 1);
  }
  std::array<double, 6> all = own;
  for (const std::array<double, 6>& box : GatherValues(frame.Shared->Ranks, own))
  {
    add(all, box.data(), box.data() + 1, 2);
  }
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double length = all[2 * axis + 1] - all[2 * axis];
    square += length * length;
  }
  return std::sqrt(square);
}

// Evenly picked, in the order of all.
std::vector<ParticleStep> GatherWays(
  const ParticleFrame& earlier, const std::vector<Partner>& partners)
{
  struct Told
  {
    std::size_t Number;
    ParticleStep Step;
  };
  std::vector<Told> own;
  for (std::size_t i = 0; i < partners.size(); ++i)
  {
    const std::size_t number = earlier.Shared->Numbers[i];
    if (number % GetStrideOfWays(earlier.CountAll()) == 0 && partners[i].Number != NoPartner)
    {
      const auto& from = earlier.Particles[i].Position;
      const auto& to = partners[i].Particle.Position;
      own.push_back({ number, { to[0] - from[0], to[1] - from[1], to[2] - from[2] } });
    }
  }
  std::vector<Told> all = GatherLists(earlier.Shared->Ranks, own);
  std::sort(
    all.begin(), all.end(), [](const Told& a, const Told& b) { return a.Number < b.Number; });
  std::vector<ParticleStep> ways;
  ways.reserve(all.size());
  for (const Told& told : all)
  {
    ways.push_back(told.Step);
  }
  return ways;
}

Found FindNone(const ParticleFrame& earlier, const ParticleFrame& later)
{
  return { std::vector<Partner>(earlier.Particles.size(), Partner{ NoPartner, {} }),
    std::vector<char>(later.Particles.size(), 1) };
}

}

ParticleMatches MatchSharedParticles(const ParticleFrame& earlier, const ParticleFrame& later)
{
  const bool sameCount = earlier.CountAll() + earlier.Ignored == later.CountAll() + later.Ignored;
  const bool canMatch = earlier.HasIds == later.HasIds && (earlier.HasIds || sameCount);
  Found found = canMatch ? MatchIds(earlier, later) : FindNone(earlier, later);
  ParticleMatches matches;
  if (!earlier.HasIds &&
    GoAcross(GatherWays(earlier, found.Partners), earlier.CountAll(), FindDiagonal(earlier)))
  {
    matches.AreShuffled = true;
    found = FindNone(earlier, later);
  }
  for (const Partner& partner : found.Partners)
  {
    matches.Partners.push_back(partner.Number);
    matches.Ends.push_back(partner.Particle);
  }
  for (std::size_t i = 0; i < found.AreBorn.size(); ++i)
  {
    if (found.AreBorn[i])
    {
      matches.Births.push_back(i);
    }
  }
  return matches;
}

}
