// The particles that a rank looks at to find something for those at home: these, and their
// neighbours. Without ranks, all.

#ifndef LocalParticles_h
#define LocalParticles_h

#include "ParticleHomes.h"
#include "SharedResults.h"
#include "Skeleton.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace activesurface
{

class VTKACTIVEPOTENTIALS_EXPORT LocalParticles
{
public:
  // all: as on all ranks, the caller's. homes: null without ranks. Neighbours are those whose
  // balls, so many radii and a margin, hold a particle at home.
  LocalParticles(const std::vector<SkeletonVertex>& all, const ParticleHomes* homes,
    double ballPerRadius, double margin);

  // By ascending number.
  const std::vector<SkeletonVertex>& Get() const { return this->Homes ? this->Near : this->All; }
  const std::vector<SkeletonVertex>& GetAll() const { return this->All; }

  bool AreShared() const { return this->Homes != nullptr; }

  // Of the particle with this place in Get.
  std::size_t GetNumber(std::size_t place) const
  {
    return this->Homes ? this->Numbers[place] : place;
  }

  // The places in Get of those at home: by ascending number, or in an order of all.
  std::vector<std::size_t> ListAtHome() const;
  template <class Order>
  std::vector<std::size_t> ListAtHome(const Order& order) const
  {
    std::vector<std::size_t> home;
    for (const std::size_t place : order)
    {
      if (!this->Homes || this->AreAtHome[place])
      {
        home.push_back(place);
      }
    }
    return home;
  }

  // Of what is known of all in Get, that of those at home.
  template <class Values>
  Values TakeHome(Values values) const
  {
    if (!this->Homes)
    {
      return values;
    }
    Values taken;
    taken.reserve(this->Homes->GetNumbers().size());
    for (const std::size_t place : this->ListAtHome())
    {
      taken.push_back(values[place]);
    }
    return taken;
  }

  // Where some in Get are, x y z each.
  std::vector<double> ListPositions(const std::size_t* places, std::size_t count) const;

  // Whether this rank looks after what is at a place of a particle.
  bool HasAtHome(const double x[3]) const { return !this->Homes || this->Homes->IsAtHome(x); }

  // The sum of what each rank has. A round of ranks.
  std::size_t AddUp(std::size_t own) const;

  using Box = std::array<double, 6>;

  // Around a ball.
  static Box MakeBox(const double centre[3], double radius)
  {
    return { centre[0] - radius, centre[0] + radius, centre[1] - radius, centre[1] + radius,
      centre[2] - radius, centre[2] + radius };
  }
  // Of so many radii around a particle.
  Box GetBall(std::size_t place, double perRadius) const
  {
    const SkeletonVertex& particle = this->Get()[place];
    return MakeBox(particle.Position, perRadius * particle.Radius);
  }

  // Something of a particle.
  template <class Value>
  struct Told
  {
    std::size_t Number;
    Value What;

    bool operator<(const Told& other) const { return this->Number < other.Number; }
  };

  // What valueOf(n) tells of the n-th of some places, of particles at home; and besides, where
  // ranks share, what others tell of theirs whose boxOf(n) touches particles at home here. By
  // ascending number where ranks share, else in their order. A round of ranks.
  template <class Value, class BoxOf, class ValueOf>
  std::vector<Told<Value>> Gather(
    const std::vector<std::size_t>& places, BoxOf boxOf, ValueOf valueOf) const
  {
    std::vector<Told<Value>> own;
    own.reserve(places.size());
    for (std::size_t n = 0; n < places.size(); ++n)
    {
      own.push_back({ this->GetNumber(places[n]), valueOf(n) });
    }
    if (!this->Homes)
    {
      return own;
    }
    Agreement& ranks = this->Homes->GetRanks();
    std::vector<std::vector<Told<Value>>> toEach(static_cast<std::size_t>(ranks.GetSize()));
    for (std::size_t n = 0; n < own.size(); ++n)
    {
      const double* x = this->Get()[places[n]].Position;
      for (const std::size_t rank : this->Homes->ListOtherHomes(x, boxOf(n).data()))
      {
        toEach[rank].push_back(own[n]);
      }
    }
    std::vector<Told<Value>> others;
    for (const std::vector<Told<Value>>& told : SwapLists(ranks, toEach))
    {
      others.insert(others.end(), told.begin(), told.end());
    }
    return Merge(std::move(own), std::move(others));
  }

  // Those of such numbers.
  template <class Value>
  std::vector<SkeletonVertex> ListParticles(const std::vector<Told<Value>>& told) const
  {
    std::vector<SkeletonVertex> particles;
    particles.reserve(told.size());
    for (const Told<Value>& one : told)
    {
      particles.push_back(this->All[one.Number]);
    }
    return particles;
  }

private:
  template <class Value>
  static std::vector<Told<Value>> Merge(
    std::vector<Told<Value>> some, std::vector<Told<Value>> others)
  {
    for (std::vector<Told<Value>>* list : { &some, &others })
    {
      if (!std::is_sorted(list->begin(), list->end()))
      {
        std::sort(list->begin(), list->end());
      }
    }
    std::vector<Told<Value>> all;
    all.reserve(some.size() + others.size());
    std::merge(some.begin(), some.end(), others.begin(), others.end(), std::back_inserter(all));
    return all;
  }

  const std::vector<SkeletonVertex>& All;
  const ParticleHomes* Homes;
  const std::vector<std::size_t> Numbers;
  const std::vector<SkeletonVertex> Near;
  std::vector<char> AreAtHome; // those that are near
};

}

#endif
