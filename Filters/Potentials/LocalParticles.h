// The particles that a rank looks at to find something for those at home: these, and their
// neighbours. Without ranks, all.

#ifndef LocalParticles_h
#define LocalParticles_h

#include "SharedParticles.h"
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
  // own: those at home, the caller's. shared: null without ranks. Neighbours are those whose balls,
  // so many radii and a margin, hold a particle at home. A round of ranks.
  LocalParticles(const std::vector<SkeletonVertex>& own, const SharedParticles* shared,
    double ballPerRadius, double margin);

  // In the order of all.
  const std::vector<SkeletonVertex>& Get() const { return this->Shared ? this->Near : this->Own; }

  bool AreShared() const { return this->Shared != nullptr; }

  // Of the particles of all ranks.
  std::size_t CountAll() const
  {
    return this->Shared ? this->Shared->CountOfAll : this->Own.size();
  }

  // So many of all, spread over their order. A round of ranks.
  std::vector<SkeletonVertex> PickSample(std::size_t count) const;

  // The places in Get of those at home: in their order, or in an order of all.
  std::vector<std::size_t> ListAtHome() const;
  template <class Order>
  std::vector<std::size_t> ListAtHome(const Order& order) const
  {
    std::vector<std::size_t> home;
    for (const std::size_t place : order)
    {
      if (!this->Shared || this->AreAtHome[place])
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
    if (!this->Shared)
    {
      return values;
    }
    Values taken;
    taken.reserve(this->Own.size());
    for (const std::size_t place : this->ListAtHome())
    {
      taken.push_back(values[place]);
    }
    return taken;
  }

  // Where some in Get are, x y z each.
  std::vector<double> ListPositions(const std::size_t* places, std::size_t count) const;

  // Whether this rank looks after what is at a place of a particle.
  bool HasAtHome(const double x[3]) const
  {
    return !this->Shared || this->Shared->Homes->IsAtHome(x);
  }

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

  // Something of a particle, with its place in the order of all.
  template <class Value>
  struct Told
  {
    std::size_t Number;
    Value What;

    bool operator<(const Told& other) const { return this->Number < other.Number; }
  };

  // What valueOf(n) tells of the n-th of some places, of particles at home; and besides, where
  // ranks share, what others tell of theirs whose boxOf(n) touches particles at home here. In the
  // order of all where ranks share, else in their order. A round of ranks.
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
    if (!this->Shared)
    {
      return own;
    }
    std::vector<std::vector<Told<Value>>> toEach(
      static_cast<std::size_t>(this->Shared->Ranks.GetSize()));
    for (std::size_t n = 0; n < own.size(); ++n)
    {
      const double* x = this->Near[places[n]].Position;
      for (const std::size_t rank : this->Shared->Homes->ListOtherHomes(x, boxOf(n).data()))
      {
        toEach[rank].push_back(own[n]);
      }
    }
    return Merge(std::move(own), SwapAll(this->Shared->Ranks, std::move(toEach)));
  }

private:
  void AddNeighbours(double ballPerRadius, double margin);

  std::size_t GetNumber(std::size_t place) const
  {
    return this->Shared ? this->Numbers[place] : place;
  }

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

  const std::vector<SkeletonVertex>& Own;
  const SharedParticles* Shared;

  // Where ranks share: those at home and their neighbours, which of them are at home, and their
  // places in the order of all.
  std::vector<SkeletonVertex> Near;
  std::vector<char> AreAtHome;
  std::vector<std::size_t> Numbers;
};

}

#endif
