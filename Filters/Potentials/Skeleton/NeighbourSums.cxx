#include "Skeleton/NeighbourSums.h"

#include "ParallelTasks.h"
#include "Skeleton/LaneEvaluation.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

constexpr double NearPerReach = 0.55;
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

// Sums the results of Derived::Add over the lists of hits.
template <class Derived, int Count>
struct SumField
{
  static constexpr int Terms = Count;

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Evaluate(
    const PlaceLanes<Width>& lanes, const HitList& hits, double (&terms)[Terms][Width]) const
  {
    LaneSums<Terms, Width> sums;
    hits.Visit([this, &lanes, &sums](const BallCells::Index* list, std::size_t count) ACTIVE_INLINED
      { static_cast<const Derived&>(*this).Add(lanes, list, count, sums); });
    sums.CopyTo(terms);
  }
};

}

// Elements out of reach add zeros. Loops over lanes are written for the vectoriser: plain
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
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const BallCells::Index* hits,
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
  const UnsetVector<Shares>& OfParticles;
  Shares* Found;

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double* terms) const
  {
    this->Found[i] = { terms[0], terms[1] };
  }

  template <int Width>
  ACTIVE_ALWAYS_INLINE void Add(const PlaceLanes<Width>& lanes, const BallCells::Index* hits,
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

NeighbourSums::NeighbourSums(const std::vector<SkeletonVertex>& particles, double factor)
  : Factor(factor)
{
  this->Build(particles, factor * FindLargestRadius(particles));
}

// Cells of the same size yield hits in the same order.
NeighbourSums::NeighbourSums(const NeighbourSums& all, const std::vector<SkeletonVertex>& some)
  : Factor(all.Factor)
{
  this->Build(some, all.Near.GetCellSize());
}

void NeighbourSums::Build(const std::vector<SkeletonVertex>& particles, double cellSize)
{
  UnsetVector<BallCells::Ball> balls(particles.size());
  RunEach(particles.size(),
    [&](std::size_t i)
    {
      const double* p = particles[i].Position;
      balls[i] = { { p[0], p[1], p[2] }, this->Factor * particles[i].Radius };
    });
  this->Near.Build(balls, cellSize);
  this->Elements.resize(particles.size());
  RunEach(particles.size(),
    [&](std::size_t k)
    {
      const BallCells::Index i = this->GetOrder()[k];
      const double* p = balls[i].Centre;
      const double reach = balls[i].Radius;
      this->Elements[k] = { { p[0], p[1], p[2] }, std::max(particles[i].Strength, 0.0),
        1.0 / (reach * reach) };
    });
}

std::size_t NeighbourSums::CountNear(const double x[3]) const
{
  BallCells::Place place;
  std::copy_n(x, 3, place.Low);
  std::copy_n(x, 3, place.High);
  std::size_t near = 0;
  this->Near.VisitHits(
    place, [&near](const BallCells::Index*, std::size_t count) { near += count; });
  return near;
}

void NeighbourSums::FindMoments(
  std::size_t count, const double* places, NeighbourMoments* moments) const
{
  EvaluateInLanes(this->Near, count, places,
    [&](std::size_t first) {
      return MomentField{ {}, *this, moments + first };
    });
}

void NeighbourSums::FindShares(std::size_t count, const double* places,
  const UnsetVector<Shares>& ofParticles, Shares* shares) const
{
  EvaluateInLanes(this->Near, count, places,
    [&](std::size_t first) {
      return ShareField{ {}, *this, ofParticles, shares + first };
    });
}

}
