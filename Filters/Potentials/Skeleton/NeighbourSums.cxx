#include "Skeleton/NeighbourSums.h"

#include "Skeleton/LaneEvaluation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace activesurface
{

namespace
{

constexpr double NearPerReach = 0.55;
// Of a Morton code.
constexpr double MostOnAxis = (1 << 20) - 1;

// Two zeros between each of the lower 21 bits and the next.
std::uint64_t SpreadBits(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x1f00000000ffffu;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
  return (bits | bits << 2) & 0x1249249249249249u;
}

template <int Count, int Width>
struct LaneSums
{
  double Terms[Count][Width] = {};

  ACTIVE_ALWAYS_INLINE void CopyTo(double (&terms)[Count][Width]) const
  {
    for (int term = 0; term < Count; ++term)
    {
      std::copy_n(this->Terms[term], Width, terms[term]);
    }
  }
};

// Adds up what Derived::Add does with each list of hits.
template <class Derived, int Count>
struct SumField
{
  static constexpr int Terms = Count;

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Evaluate(
    const PlaceLanes<Width>& lanes, const HitList& hits, double (&terms)[Terms][Width]) const
  {
    LaneSums<Terms, Width> sums;
    hits.Visit(
      [this, &lanes, &sums](const SkeletonCells::Index* list, std::size_t count) ACTIVE_INLINED
      { static_cast<const Derived&>(*this).Add(lanes, list, count, sums); });
    sums.CopyTo(terms);
  }
};

}

// What is out of reach adds zeros. Loops over lanes are written for the vectoriser: plain
// statements on a copy of the sums, which stays in registers.

struct NeighbourSums::MomentField
  : SumField<NeighbourSums::MomentField, 11> // as in NeighbourMoments
{
  const NeighbourSums& Neighbours;
  NeighbourMoments* Moments;

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double* terms) const
  {
    NeighbourMoments& moments = this->Moments[i];
    moments.Weight = terms[0];
    moments.Near = terms[1];
    std::copy_n(terms + 2, 3, moments.First);
    std::copy_n(terms + 5, 6, moments.Second);
  }

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const SkeletonCells::Index* hits,
    std::size_t count, LaneSums<Terms, Width>& result) const
  {
    LaneSums<Terms, Width> sums = result;
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const Element& element = this->Neighbours.Elements[hits[hit]];
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = element.Position[0] - lanes.X[0][i];
        const double y = element.Position[1] - lanes.X[1][i];
        const double z = element.Position[2] - lanes.X[2][i];
        const double q2 = (x * x + y * y + z * z) * element.InverseReach2;
        const double u = 1.0 - std::min(q2, 1.0);
        const double near = 1.0 - std::min(q2 / (NearPerReach * NearPerReach), 1.0);
        const double weight = element.Strength * (u * u);
        sums.Terms[0][i] += weight;
        sums.Terms[1][i] += element.Strength * (near * near);
        sums.Terms[2][i] += weight * x;
        sums.Terms[3][i] += weight * y;
        sums.Terms[4][i] += weight * z;
        sums.Terms[5][i] += weight * x * x;
        sums.Terms[6][i] += weight * x * y;
        sums.Terms[7][i] += weight * x * z;
        sums.Terms[8][i] += weight * y * y;
        sums.Terms[9][i] += weight * y * z;
        sums.Terms[10][i] += weight * z * z;
      }
    }
    result = sums;
  }
};

struct NeighbourSums::ShareField : SumField<NeighbourSums::ShareField, 2>
{
  const NeighbourSums& Neighbours;
  const std::vector<Shares>& OfParticles;
  Shares* Found;

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double* terms) const
  {
    this->Found[i] = { terms[0], terms[1] };
  }

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const SkeletonCells::Index* hits,
    std::size_t count, LaneSums<Terms, Width>& result) const
  {
    LaneSums<Terms, Width> sums = result;
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const Element& element = this->Neighbours.Elements[hits[hit]];
      const Shares own = this->OfParticles[hits[hit]];
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = element.Position[0] - lanes.X[0][i];
        const double y = element.Position[1] - lanes.X[1][i];
        const double z = element.Position[2] - lanes.X[2][i];
        const double u = 1.0 - std::min((x * x + y * y + z * z) * element.InverseReach2, 1.0);
        const double share = element.Strength * (u * u) * own.Share;
        sums.Terms[0][i] += share;
        sums.Terms[1][i] += share * own.Value;
      }
    }
    result = sums;
  }
};

struct NeighbourSums::MotionField : SumField<NeighbourSums::MotionField, 7> // as in Motion
{
  const NeighbourSums& Neighbours;
  const std::vector<Moving>& OfParticles;
  Motion* Motions;

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double* terms) const
  {
    Motion& motion = this->Motions[i];
    motion.Weight = terms[0];
    motion.SquareOfWeights = terms[1];
    std::copy_n(terms + 2, 3, motion.Velocity);
    motion.Square = terms[5];
    motion.Bulk = terms[6];
  }

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const SkeletonCells::Index* hits,
    std::size_t count, LaneSums<Terms, Width>& result) const
  {
    LaneSums<Terms, Width> sums = result;
    for (std::size_t hit = 0; hit < count; ++hit)
    {
      const Element& element = this->Neighbours.Elements[hits[hit]];
      const Moving own = this->OfParticles[hits[hit]];
      const double* v = own.Velocity;
      const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if (!std::isfinite(square))
      {
        continue;
      }
      ACTIVE_LANES
      for (int i = 0; i < Width; ++i)
      {
        const double x = element.Position[0] - lanes.X[0][i];
        const double y = element.Position[1] - lanes.X[1][i];
        const double z = element.Position[2] - lanes.X[2][i];
        const double u = 1.0 - std::min((x * x + y * y + z * z) * element.InverseReach2, 1.0);
        const double weight = element.Strength * (u * u);
        sums.Terms[0][i] += weight;
        sums.Terms[1][i] += weight * weight;
        sums.Terms[2][i] += weight * v[0];
        sums.Terms[3][i] += weight * v[1];
        sums.Terms[4][i] += weight * v[2];
        sums.Terms[5][i] += weight * square;
        sums.Terms[6][i] += weight * own.Bulk;
      }
    }
    result = sums;
  }
};

NeighbourSums::NeighbourSums(const std::vector<SkeletonVertex>& particles, double factor)
{
  this->Elements.reserve(particles.size());
  for (const SkeletonVertex& particle : particles)
  {
    const double* p = particle.Position;
    const double reach = factor * particle.Radius;
    this->Near.AddBall(p, reach);
    this->Elements.push_back(
      { { p[0], p[1], p[2] }, std::max(particle.Strength, 0.0), 1.0 / (reach * reach) });
  }
  this->Near.Build();
}

std::vector<std::size_t> NeighbourSums::SortByPlace() const
{
  double low[3], longest = 0.0; // half of it, as all of it may overflow
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [least, most] = std::minmax_element(this->Elements.begin(), this->Elements.end(),
      [axis](const Element& a, const Element& b) { return a.Position[axis] < b.Position[axis]; });
    low[axis] = least != this->Elements.end() ? 0.5 * least->Position[axis] : 0.0;
    longest = least != this->Elements.end()
      ? std::max(longest, 0.5 * most->Position[axis] - low[axis])
      : 0.0;
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> keys(this->Elements.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    keys[i] = { 0, i };
    for (int axis = 0; axis < 3 && longest > 0.0; ++axis)
    {
      const double share = (0.5 * this->Elements[i].Position[axis] - low[axis]) / longest;
      keys[i].first |= SpreadBits(static_cast<std::uint64_t>(share * MostOnAxis)) << axis;
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order(keys.size());
  std::transform(
    keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

std::vector<double> NeighbourSums::ListPlaces(const std::size_t* members, std::size_t count) const
{
  std::vector<double> places(3 * count);
  for (std::size_t k = 0; k < count; ++k)
  {
    std::copy_n(this->Elements[members[k]].Position, 3, &places[3 * k]);
  }
  return places;
}

std::size_t NeighbourSums::CountNear(const double x[3]) const
{
  SkeletonCells::Place place;
  std::copy_n(x, 3, place.Low);
  std::copy_n(x, 3, place.High);
  std::size_t near = 0;
  VisitHits(this->Near.GetCells(), place,
    [&near](const SkeletonCells::Index*, std::size_t count) { near += count; });
  return near;
}

void NeighbourSums::FindMoments(
  std::size_t count, const double* places, NeighbourMoments* moments) const
{
  EvaluateInLanes(this->Near.GetCells(), count, places,
    [&](std::size_t first) {
      return MomentField{ {}, *this, moments + first };
    });
}

void NeighbourSums::FindShares(std::size_t count, const double* places,
  const std::vector<Shares>& ofParticles, Shares* shares) const
{
  EvaluateInLanes(this->Near.GetCells(), count, places,
    [&](std::size_t first) {
      return ShareField{ {}, *this, ofParticles, shares + first };
    });
}

void NeighbourSums::FindMotions(std::size_t count, const double* places,
  const std::vector<Moving>& ofParticles, Motion* motions) const
{
  EvaluateInLanes(this->Near.GetCells(), count, places,
    [&](std::size_t first) {
      return MotionField{ {}, *this, ofParticles, motions + first };
    });
}

}
